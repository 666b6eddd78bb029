#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "folder/folder.h"

namespace hersey::workbench {

/// Finds out by looking again and again what has changed in a folder: it works on every file system, network drives
/// included. Files of runs grow all the time: only their coming and going counts.
class Watch {
 public:
  explicit Watch(const Folder& folder);
  /// Paths of files that are new, changed or gone since the last call.
  [[nodiscard]] std::vector<std::string> changes();

 private:
  using Known = std::map<std::string, std::pair<std::uintmax_t, double>>;
  [[nodiscard]] Known look() const;

  const Folder& folder_;
  Known known_;
};

}  // namespace hersey::workbench
