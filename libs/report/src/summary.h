#pragma once

#include <vector>

#include "hersey/report/report.h"
#include "hersey/results/reader.h"

namespace hersey::report {

/// The summary of the run called `name`; rows whose dataset the file lacks are left out.
[[nodiscard]] std::vector<SummaryRow> summarise(const results::Reader& reader, const std::string& name);

}  // namespace hersey::report
