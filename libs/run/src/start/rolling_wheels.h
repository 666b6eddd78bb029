#pragma once

#include <limits>
#include <vector>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// By how much a given speed may miss the ratio of the teeth to be taken for a rounded one, as a share of the speed at
/// the base circles.
constexpr double kRoundedSpeed = 1e-3;

/// Gives gear wheels that no drive rotates, with what rotates with them, the speeds at which they roll on the wheels
/// that they mesh with: no constraint says so, as gear meshes are forces. A wheel rotates by the first joint from
/// ground that lets it, is not held by a spring and deforms nothing; one about one axis goes before one in space.
/// Wheels that no such joint lets rotate keep their speeds.
/// @param largest  misses beyond this share of the speed at the base circles stay
/// @returns the velocity components that were changed
std::vector<solver::Equations::Index> roll_wheels(const model::Machine& machine, solver::State& state,
                                                  double largest = std::numeric_limits<double>::infinity());

/// @throws InputError if teeth would come towards each other, or part, beyond round-off: the mesh would be a shock, or
///         an ever greater force between two drives
void require_rolling_wheels(const model::Model& model, const model::Machine& machine, const solver::State& state);

}  // namespace hersey::run
