#include "runs/temporary_folder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "hersey-answer-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw Refused(507, fmt::format("no temporary folder can be made: {}", std::strerror(errno)),
                  "make room on the disk");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace hersey::workbench
