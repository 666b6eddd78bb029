#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "hersey/results/error.h"
#include "hersey/results/output_lock.h"
#include "hersey/results/reader.h"
#include "hersey/workbench/refused.h"
#include "runs/runs.h"

// Folders are opened one within the other, links never followed: whatever is put in their place meanwhile, nothing is
// removed elsewhere.
namespace hersey::workbench {
namespace {

using Path = std::filesystem::path;

constexpr std::string_view kRecord = "run.json";

/// What a folder of a run is for.
enum class Place { run, runs_of_study, fields_of_report, records_of_tasks, tasks, task };

/// Name without the ending of files that are being replaced.
std::string_view complete_name(std::string_view name) {
  constexpr std::string_view unfinished = ".new";
  if (name.ends_with(unfinished)) name.remove_suffix(unfinished.size());
  return name;
}

bool is_file_of_results(std::string_view name) {
  return name.ends_with(".h5") || name.ends_with(".h5.lock") || name.ends_with(".checkpoint");
}

/// True of a file that a run makes there.
bool makes_file(Place place, std::string_view name) {
  name = complete_name(name);
  constexpr std::array<std::string_view, 14> known{
      kRecord,        "model.txt",     "events.ndjson", "log.txt",   "exit.txt", "plan.json",  "results.json",
      "figures.json", "records.jsonl", "runs.csv",      "bands.csv", "lock",     "study.html", "report.html"};
  switch (place) {
    case Place::run:
      return is_file_of_results(name) || std::find(known.begin(), known.end(), name) != known.end();
    case Place::runs_of_study:
      return is_file_of_results(name) || name.ends_with(".html") || name.ends_with(".events");
    case Place::fields_of_report:
      return name.ends_with(".js");
    case Place::records_of_tasks:
      return name.ends_with(".jsonl");
    case Place::tasks:
      return false;
    case Place::task:
      return name == "task.sh" || name.ends_with(".jsonl") || name.ends_with(".log");
  }
  return false;
}

/// What a folder is for that a run makes there; nothing of another one.
std::optional<Place> made_folder(Place place, std::string_view name) {
  if (place == Place::tasks) return Place::task;
  if (place != Place::run && place != Place::runs_of_study) return std::nullopt;
  if (name.ends_with("_fields")) return Place::fields_of_report;
  if (place == Place::runs_of_study) return std::nullopt;
  if (name == "runs") return Place::runs_of_study;
  if (name == "shards") return Place::records_of_tasks;
  if (name == "tasks") return Place::tasks;
  return std::nullopt;
}

/// A folder that is open.
class OpenFolder {
 public:
  explicit OpenFolder(const Path& path) : OpenFolder(AT_FDCWD, path.string(), path.string()) {}
  [[nodiscard]] OpenFolder within(const std::string& name) const { return {fd(), name, name_ + "/" + name}; }

  [[nodiscard]] int fd() const { return ::dirfd(stream_.get()); }
  [[nodiscard]] const std::string& name() const { return name_; }

  [[nodiscard]] std::vector<std::string> entries() const {
    std::vector<std::string> names;
    ::rewinddir(stream_.get());
    while (const dirent* entry = ::readdir(stream_.get()))
      if (std::string name = entry->d_name; name != "." && name != "..") names.push_back(std::move(name));
    return names;
  }
  /// Kind of an entry as of stat, that of a link its own; 0 if it is not there.
  [[nodiscard]] mode_t kind(const std::string& name) const {
    struct stat status {};
    return ::fstatat(fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 ? status.st_mode & S_IFMT : 0;
  }
  void remove(const std::string& name, bool is_folder) const {
    if (::unlinkat(fd(), name.c_str(), is_folder ? AT_REMOVEDIR : 0) != 0 && errno != ENOENT) refuse(name);
  }
  [[noreturn]] void refuse(const std::string& name) const {
    throw Refused(403, fmt::format("{}/{} cannot be removed: {}", name_, name, std::generic_category().message(errno)),
                  "change the rights of its folder, then remove the run again");
  }

 private:
  OpenFolder(int in, const std::string& name, std::string shown) : name_(std::move(shown)) {
    const int fd = ::openat(in, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd >= 0) stream_.reset(::fdopendir(fd));
    if (!stream_)
      throw Refused(403,
                    fmt::format("{} cannot be opened as a folder: {}", name_, std::generic_category().message(errno)),
                    "a link is never followed: remove it by hand");
  }
  struct Close {
    void operator()(DIR* stream) const { ::closedir(stream); }
  };
  std::string name_;
  std::unique_ptr<DIR, Close> stream_;
};

/// @throws Refused 409 if there is anything in it that no run makes
void require_made_by_run(const OpenFolder& folder, Place place) {
  for (const std::string& name : folder.entries()) {
    const mode_t kind = folder.kind(name);
    const std::optional<Place> inner = kind == S_IFDIR ? made_folder(place, name) : std::nullopt;
    if (inner)
      require_made_by_run(folder.within(name), *inner);
    else if (kind != S_IFREG || !makes_file(place, name))
      throw Refused(409, fmt::format("{}/{} is not of the run: nothing is removed", folder.name(), name),
                    "move it elsewhere, then remove the run");
  }
}

/// The record last: a run that is removed in part is still one of the list.
void remove_content(const OpenFolder& folder, Place place) {
  std::vector<std::string> names = folder.entries();
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) { return name != kRecord; });
  for (const std::string& name : names) {
    const std::optional<Place> inner = folder.kind(name) == S_IFDIR ? made_folder(place, name) : std::nullopt;
    if (inner) remove_content(folder.within(name), *inner);
    folder.remove(name, inner.has_value());
  }
}

void require_results_of_hersey(const Path& file, const std::string& name) {
  try {
    results::require_idle(file);
    const results::Reader reader(file);
  } catch (const results::FileBusy&) {
    throw Refused(409, name + " is being written by a run", "stop it first");
  } catch (const results::FileError& error) {
    throw Refused(409, fmt::format("{} is not removed: {}", name, error.what()), "remove it by hand");
  }
}

/// A results file of the command line with its lock and checkpoint; with the last one its report, and the folder if
/// nothing else is in it.
void remove_results(const OpenFolder& top, const std::string& file) {
  std::vector<OpenFolder> way;
  const auto last = [&]() -> const OpenFolder& { return way.empty() ? top : way.back(); };
  const Path path(file);
  for (const Path& part : path.parent_path()) way.push_back(last().within(part.string()));
  const OpenFolder& folder = last();
  const std::string name = path.filename().string();
  if (folder.kind(name) != S_IFREG)
    throw Refused(403, file + " is a link, which may lead anywhere", "remove it by hand");
  for (const std::string& own : {name, name + ".lock", path.stem().string() + ".checkpoint"})
    if (folder.kind(own) == S_IFREG) folder.remove(own, false);
  const std::vector<std::string> left = folder.entries();
  if (std::any_of(left.begin(), left.end(), [](const std::string& other) { return other.ends_with(".h5"); })) return;
  if (name == "results.h5") {
    const std::string page = "report.html", fields = "report_fields";
    if (folder.kind(page) == S_IFREG) folder.remove(page, false);
    if (folder.kind(fields) == S_IFDIR) {
      const OpenFolder inner = folder.within(fields);
      require_made_by_run(inner, Place::fields_of_report);
      remove_content(inner, Place::fields_of_report);
      folder.remove(fields, true);
    }
  }
  if (way.empty() || !folder.entries().empty()) return;
  (way.size() > 1 ? way[way.size() - 2] : top).remove(path.parent_path().filename().string(), true);
}

}  // namespace

void Runs::remove(const std::string& id) {
  const std::lock_guard lock(starting_);
  const RunEntry run = find(id);
  if (run.state == "running") throw Refused(409, "this run goes on", "stop it first");
  const OpenFolder top(folder_.path());
  if (run.folder != "runs/" + id) {
    require_results_of_hersey(folder_.path() / run.results.front(), run.results.front());
    remove_results(top, run.results.front());
  } else {
    const OpenFolder runs = top.within("runs"), folder = runs.within(id);
    require_made_by_run(folder, Place::run);
    for (const std::string& file : run.results) {
      try {
        results::require_idle(folder_.path() / file);
      } catch (const results::FileBusy&) {
        throw Refused(409, file + " is being written by a run", "stop it first");
      }
    }
    remove_content(folder, Place::run);
    runs.remove(id, true);
  }
  events_.add("runs", "{}");
}

}  // namespace hersey::workbench
