#pragma once

#include <vector>

#include "commands.h"
#include "hersey/report/bearing_page.h"
#include "hersey/study/bearing_study.h"

namespace hersey::cli {

/// Contents of the report of `solutions`.
/// @param model  of the first of them
[[nodiscard]] report::BearingPage bearing_page(const BearingArguments& arguments, const model::Model& model,
                                               const std::vector<study::BearingSolution>& solutions);

}  // namespace hersey::cli
