#pragma once

#include <vector>

#include "hersey/mbd/mechanism_spec.h"

namespace hersey::mbd {

/// The free joints between the nodes of loose beams, see MechanismBuilder::loosen_beams.
/// @return for each joint whether it is one; none unless the mechanism loosens its beams
[[nodiscard]] std::vector<bool> loose_joints(const MechanismSpec& spec);

}  // namespace hersey::mbd
