#pragma once

#include "hersey/model/model.h"
#include "hersey/study/bearing_solution.h"

namespace hersey::study {

/// Solves a bearing of tilting pads at its operating point: journal and pads in one steady motion. The solution's film
/// is that of all pads together, as of a bore of arcs; its coefficients are those with pads that follow at the whirl
/// ratio of the operating point.
/// @param solution  its `run` is set already
/// @throws InputError where the bearing can only be in its machine
void solve_pads(const model::Composite& composite, BearingSolution& solution);

/// The same of pads below a collar, whose film is that of a thrust bearing. Its coefficients are those over film
/// thickness on the axis and slopes of the collar's axis.
void solve_thrust_pads(const model::Composite& composite, BearingSolution& solution);

/// The same of a floating ring, whose speed is found. The solution's film is the inner one.
void solve_floating_ring(const model::Composite& composite, BearingSolution& solution);

}  // namespace hersey::study
