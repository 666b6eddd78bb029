#include "folder/watch.h"

#include <filesystem>

namespace hersey::workbench {
namespace {

bool grows_in_runs(const FileEntry& file) {
  return file.path.starts_with("runs/") || file.kind == "results" || file.path.ends_with(".lock") ||
         file.path.ends_with(".checkpoint");
}

}  // namespace

Watch::Watch(const Folder& folder) : folder_(folder), known_(look()) {}

Watch::Known Watch::look() const {
  Known found;
  for (const FileEntry& file : folder_.list()) {
    const bool grows = grows_in_runs(file);
    found[file.path] = {grows ? 0 : file.size, grows ? 0 : file.changed};
  }
  return found;
}

std::vector<std::string> Watch::changes() {
  Known now = look();
  std::vector<std::string> paths;
  for (const auto& [path, state] : now) {
    const auto before = known_.find(path);
    if (before == known_.end() || before->second != state) paths.push_back(path);
  }
  for (const auto& [path, state] : known_)
    if (now.count(path) == 0) paths.push_back(path);
  known_ = std::move(now);
  return paths;
}

}  // namespace hersey::workbench
