#pragma once

#include <memory>
#include <string>

#include "hersey/bearing/surface_flexibility.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// How the surfaces of a bearing give way to its film while everything rests, null where both are rigid.
///
/// The body of a surface that deforms has the shapes it has in a run (a nodal body its static ones), and is held at
/// those of its frames that joints attach to; where none has one at the other frames that bushings, springs, loads
/// or bearings attach to; and by the bearing's own frame where there are none. Frames that hold keep their
/// places against each other, all others are free (theory manual, bearing.23 to bearing.25).
/// @throws InputError where a body cannot be reduced, as `build` does
/// @cost of a mesh two factorisations and one solution per shape
[[nodiscard]] std::shared_ptr<const bearing::SteadyElasticity> steady_elasticity(const Model& model,
                                                                                 const Bearing& bearing);

/// All that `steady_elasticity` depends on, in a row: equal for models with the same answer.
[[nodiscard]] std::string fingerprint_of_elasticity(const Model& model, const Bearing& bearing);

}  // namespace hersey::model
