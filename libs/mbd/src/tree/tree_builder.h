#pragma once

#include "hersey/mbd/mechanism_spec.h"
#include "tree/tree.h"

namespace hersey::mbd {

/// Chooses the spanning tree (breadth first from ground, in order of declaration; joints whose coordinates are driven,
/// sprung, read by loads or given initially come first, then those with a guess) and lays out coordinates and
/// constraints. Paths longer than MechanismSpec::longest_path are cut (theory manual, section "Long chains"). Where
/// MechanismSpec::chooses_roots, bodies too light for it carry nothing.
[[nodiscard]] Tree build_tree(const MechanismSpec& spec);

}  // namespace hersey::mbd
