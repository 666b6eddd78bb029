#pragma once

#include <vector>

#include "hersey/mbd/mechanism_builder.h"
#include "tree.h"
#include "tree_motion.h"

namespace hersey::mbd {

/// Shares the reactions of redundantly joined bodies among their joints: of all reactions that keep every body in the
/// balance that `wrenches` describe, the one with the smallest sum of squares, torques counted per `tree.length`
/// (theory manual eq. (mechanisms.21)).
///
/// @param wrenches  per joint, of the inboard on the outboard body, at ground's origin and in ground's axes; one
///                  possible set on entry, the one of smallest norm on return
/// @verified_by redundancy_test.cpp: TwoHinges_ShareTheDoorsWeight
void share_reactions(const MechanismSpec& spec, const Tree& tree, const TreeMotion& motion,
                     std::vector<Vector6>& wrenches);

}  // namespace hersey::mbd
