#pragma once

#include <vector>

#include "hersey/report/report.h"
#include "hersey/results/reader.h"

namespace hersey::report {

/// The summary of one run; rows whose dataset the file lacks are left out.
[[nodiscard]] std::vector<SummaryRow> summarise(const results::Reader& reader);

}  // namespace hersey::report
