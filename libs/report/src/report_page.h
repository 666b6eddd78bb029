#pragma once

#include <string_view>

namespace hersey::report {

/// The report's page without data: one HTML file built by web/. Data replaces its empty data element.
[[nodiscard]] std::string_view report_page();

}  // namespace hersey::report
