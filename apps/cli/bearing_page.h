#pragma once

#include <vector>

#include "commands.h"
#include "hersey/report/bearing_page.h"
#include "hersey/study/bearing_study.h"

namespace hersey::cli {

/// Contents of the report of `solutions`.
/// @throws InputError as the model does.
[[nodiscard]] report::BearingPage bearing_page(const BearingArguments& arguments,
                                               const std::vector<study::BearingSolution>& solutions);

}  // namespace hersey::cli
