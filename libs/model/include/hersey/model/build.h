#pragma once

#include "hersey/model/machine.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// @throws InputError where the parts make no mechanism: impossible inertia, a joint between a body and itself, two
/// drives on one
///         coordinate.
[[nodiscard]] Machine build(const Model& model);

}  // namespace hersey::model
