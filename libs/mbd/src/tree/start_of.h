#pragma once

#include "hersey/mbd/mechanism_spec.h"
#include "hersey/solver/equations.h"
#include "tree/tree.h"

namespace hersey::mbd {

/// The tree's positions and velocities at the start, those given in `spec`; accelerations zero. Elastic bodies' own
/// coordinates are not in it.
[[nodiscard]] solver::State start_of(const MechanismSpec& spec, const Tree& tree);

}  // namespace hersey::mbd
