#pragma once

#include "hersey/report/bearing_page.h"
#include "hersey/study/bearing_solution.h"

namespace hersey::workbench {

/// A solution as a page of a bearing by itself shows it: figures, films with their fields and features. Its remark is
/// left empty.
[[nodiscard]] report::PageSolution page_of(const study::BearingSolution& solution);

}  // namespace hersey::workbench
