#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hersey/run/quantity_info.h"

namespace hersey::run {

/// Every quantity of results files: the file, the summary and the documentation follow from these tables.
/// @verified_by tests/results_file, quantities_test.cpp
[[nodiscard]] const std::vector<QuantityGroup>& result_quantities();

/// Returns the quantities of one path.
/// @pre there is a group of that path.
[[nodiscard]] std::vector<QuantityInfo> quantities_of(std::string_view path);

/// The layout of results files as JSON: {"format", "format_version", "groups": [{"path", "heading", "quantities"}]}.
[[nodiscard]] std::string results_schema_json();

/// The reference page docs/results-file.md, from the same tables.
[[nodiscard]] std::string results_schema_markdown();

}  // namespace hersey::run
