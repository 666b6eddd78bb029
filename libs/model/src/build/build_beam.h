#pragma once

#include "hersey/mbd/mechanism_builder.h"
#include "hersey/model/machine.h"

namespace hersey::model {

/// Adds the nodes and elements of a beam to a mechanism. Nodes on which frames sit are bodies `beam.frame`.
[[nodiscard]] BuiltBeam build_beam(const Body& body, mbd::MechanismBuilder& mechanism);

}  // namespace hersey::model
