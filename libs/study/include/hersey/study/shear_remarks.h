#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/study/bearing_study.h"

namespace hersey::study {

/// Returns remarks on the effect of shear on a solution, if it changes the figures: over how much of the gap the
/// cavitated film is sheared, with the result of the other choice, and the share of the load that the net force of
/// shear carries, if it is noticeable. Charts and other programs choose either, so that friction may differ by a third
/// and the attitude of a narrow or lightly loaded bearing by tens of degrees.
/// @returns names and sentences, "cavitated shear" and "shear force"; the first always if the film is cavitated
/// @verified_by bearing_study_test.cpp
[[nodiscard]] std::vector<std::pair<std::string, std::string>> shear_remarks(const BearingSolution& solution);

/// Returns the first of shear_remarks() for a table of several solutions: the range of the results of the other choice;
/// empty if no film is cavitated, or if the solutions differ in that choice, which their labels then state.
[[nodiscard]] std::string shear_remark(const std::vector<BearingSolution>& solutions);

/// Share of the load that the net force of shear carries, in the direction of the load [-].
[[nodiscard]] double load_on_shear(const BearingSolution& solution);

}  // namespace hersey::study
