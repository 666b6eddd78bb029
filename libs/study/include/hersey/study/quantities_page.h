#pragma once

#include <string>

namespace hersey::study {

/// Returns the reference page docs/quantities.md: every quantity of a bearing with its unit, its definition and where
/// it is reported. `hersey schema --quantities` prints it.
/// @verified_by quantities_page_test.cpp
[[nodiscard]] std::string quantities_markdown();

}  // namespace hersey::study
