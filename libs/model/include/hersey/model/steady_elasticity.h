#pragma once

#include <memory>
#include <string>

#include "hersey/bearing/surface_flexibility.h"
#include "hersey/model/model.h"

namespace hersey::model {

/// Returns the compliance of a bearing's surfaces under its film while everything rests, null if both are rigid.
///
/// The body of a surface that deforms has the shapes that it has in a run (a nodal body its static ones). It is
/// supported at those of its frames to which joints attach; if there are none, at the other frames to which bushings,
/// springs, loads or bearings attach; and by the bearing's own frame if there are none of these either. Supported
/// frames keep their relative poses, all others are free (theory manual, bearing.23 to bearing.25).
/// @throws InputError if a body cannot be reduced, as `build` does @cost of a mesh two factorisations and one solution
///         per shape
[[nodiscard]] std::shared_ptr<const bearing::SteadyElasticity> steady_elasticity(const Model& model,
                                                                                 const Bearing& bearing);

/// Returns all data on which `steady_elasticity` depends: equal for models with the same result.
[[nodiscard]] std::string fingerprint_of_elasticity(const Model& model, const Bearing& bearing);

}  // namespace hersey::model
