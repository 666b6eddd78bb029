#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/study/bearing_study.h"

namespace hersey::study {

/// How shear enters a solution, where that moves its figures: over how much of the gap the cavitated film is sheared,
/// with what the other choice gives, and which share of the load the net force of shear carries, where that is
/// noticeable. Charts and other programs choose either, so that friction may differ by a third and the attitude of a
/// narrow or lightly loaded bearing by tens of degrees.
/// @returns names and sentences, "cavitated shear" and "shear force"; the first always where the film is cavitated
/// @verified_by bearing_study_test.cpp
[[nodiscard]] std::vector<std::pair<std::string, std::string>> shear_remarks(const BearingSolution& solution);

/// The first of shear_remarks() for a table of several solutions: the range of what the other choice gives; empty where
/// no film is cavitated, or where the solutions differ in that choice, which their labels then tell.
[[nodiscard]] std::string shear_remark(const std::vector<BearingSolution>& solutions);

/// Share of the load that the net force of shear carries, in the direction of the load [-].
[[nodiscard]] double load_on_shear(const BearingSolution& solution);

}  // namespace hersey::study
