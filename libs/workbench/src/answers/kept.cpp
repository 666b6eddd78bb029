#include "answers/kept.h"

#include <algorithm>
#include <chrono>
#include <system_error>

#include "folder/folder.h"

namespace hersey::workbench {

std::string Kept::file(const std::string& path) const {
  if (path.empty()) throw Refused(403, "The path '' is not one of the folder.", "Name a file relative to the folder.");
  (void)Folder(root_).resolve(path);  // refuses hidden names and links that lead out of it
  return (root_ / path).lexically_normal().string();
}

// Of the tables and meshes: the text itself comes with the request.
std::vector<Kept::Stamp> Kept::stamps_of(const session::Session& session) {
  std::vector<Stamp> stamps;
  for (const std::filesystem::path& file : session.files()) {
    if (file == session.file()) continue;
    std::error_code ignored;
    Stamp& stamp = stamps.emplace_back();
    stamp.time = std::filesystem::last_write_time(file, ignored);
    stamp.size = std::filesystem::file_size(file, ignored);
  }
  return stamps;
}

std::shared_ptr<const session::Session> Kept::session(const std::string& text, const std::string& file) {
  std::shared_ptr<const session::Session> known = known_session(text, file);
  return known ? known : read_session(model::ModelFile(text, file));
}

std::shared_ptr<const session::Session> Kept::known_session(const std::string& text, const std::string& file) {
  std::shared_ptr<const KeptSession> known;
  {
    const std::lock_guard lock(mutex_);
    known = sessions_.find(file + '\n' + text);
  }
  return known && stamps_of(*known->session) == known->stamps ? known->session : nullptr;
}

std::shared_ptr<const session::Session> Kept::read_session(const model::ModelFile& source) {
  using FileTime = std::filesystem::file_time_type;
  // A file written while it is read, or so shortly before that a later change could have the same time, is read again
  // the next time.
  const FileTime latest = FileTime::clock::now() - std::chrono::seconds(1);
  auto read = std::make_shared<const session::Session>(source, std::vector<std::string>{});
  std::vector<Stamp> stamps = stamps_of(*read);
  if (std::any_of(stamps.begin(), stamps.end(), [&](const Stamp& stamp) { return stamp.time > latest; })) return read;
  const std::lock_guard lock(mutex_);
  sessions_.keep(source.file() + '\n' + source.text(),
                 std::make_shared<const KeptSession>(KeptSession{read, std::move(stamps)}));
  return read;
}

std::string Kept::keep(study::BearingSolution solution) {
  const std::lock_guard lock(mutex_);
  std::string id = "solution_" + std::to_string(next_++);
  solutions_.keep(id, std::make_shared<const study::BearingSolution>(std::move(solution)));
  return id;
}

std::shared_ptr<const study::BearingSolution> Kept::solution(const std::string& id) {
  const std::lock_guard lock(mutex_);
  return solutions_.find(id);
}

}  // namespace hersey::workbench
