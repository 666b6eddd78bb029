#include "runs/runs.h"

#include <system_error>
#include <utility>

namespace hersey::workbench {

Runs::Runs(Folder& folder, EventLog& events, std::filesystem::path program)
    : folder_(folder), events_(events), program_(std::move(program)) {
  look_for_runs();
  calls_ = 1;
}

Runs::~Runs() {
  std::error_code ignored;
  if (!reports_.empty()) std::filesystem::remove_all(reports_, ignored);
}

}  // namespace hersey::workbench
