#include "runs/run_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <utility>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {
namespace {

using Path = std::filesystem::path;

/// Size and time of change of a regular file, of no link: what a run has written is no link, and others may lead
/// anywhere.
struct stat status_of_own(const Path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return status;
}

}  // namespace

bool is_own_folder(const Path& folder) {
  struct stat status {};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

std::uintmax_t size_of(const Path& file) { return static_cast<std::uintmax_t>(status_of_own(file).st_size); }

double time_of(const Path& file) {
  const struct stat status = status_of_own(file);
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

std::string record_mark(const Path& file) {
  const struct stat status = status_of_own(file);
  return fmt::format("{}.{:09} {} {}", status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino, status.st_size);
}

std::string part_of(const Path& file, std::uintmax_t begin, std::uintmax_t most) {
  const std::uintmax_t size = size_of(file);
  if (size <= begin) return {};
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(begin));
  std::string text(std::min(most, size - begin), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return text;
}

std::string tail_of(const Path& file, std::uintmax_t most) {
  const std::uintmax_t size = size_of(file);
  return part_of(file, size > most ? size - most : 0, most);
}

std::vector<Path> entries_of(const Path& folder) {
  std::vector<Path> entries;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    entries.push_back(entry->path());
  return entries;
}

std::string plain_name(const std::string& name) {
  std::string text;
  for (const char c : name.substr(0, 60)) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    text += is_plain ? c : '_';
  }
  return text.empty() ? "run" : text;
}

std::vector<std::string> own_runs(const Path& folder) {
  std::vector<std::string> ids;
  if (!is_own_folder(folder / "runs")) return ids;
  for (const Path& run : entries_of(folder / "runs")) {
    std::string id = run.filename().string();
    if (id == plain_name(id) && is_own_folder(run) && time_of(run / "run.json") > 0) ids.push_back(std::move(id));
  }
  return ids;
}

std::string link_among(const Path& folder) {
  std::error_code error;
  std::filesystem::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::recursive_directory_iterator(); entry.increment(error))
    if (std::error_code unknown; entry->is_symlink(unknown)) return entry->path().lexically_relative(folder).string();
  if (error) cannot_make(folder, error);
  return {};
}

void cannot_make(const Path& folder, const std::error_code& error) {
  const bool is_full = error == std::errc::no_space_on_device;
  throw Refused(is_full ? 507 : 403, fmt::format("{} cannot be made: {}", folder.string(), error.message()),
                is_full ? "make room on the disk" : "open a folder in which you may write");
}

}  // namespace hersey::workbench
