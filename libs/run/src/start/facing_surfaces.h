#pragma once

#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Difference between the mesh of a bearing's surface and the radius that its film uses.
struct SurfaceOffset {
  double nominal = 0;  ///< radius of the bearing's bore, or of its journal [m]
  double mean = 0;     ///< that of the mesh, mean over the area, less the nominal one [m]
  double share = 0;    ///< its size over the clearance

  static constexpr double warned_from = 0.1;  ///< share of the clearance from which on the user is warned
  [[nodiscard]] bool is_large() const { return share > warned_from; }
  [[nodiscard]] std::string text() const;  ///< "nodes at 22.4998 mm in the mean, 0.2 um below the bearing's 22.5 mm"
};

[[nodiscard]] SurfaceOffset offset_of(const model::Model& model, const model::Bearing& bearing, bool shell);

/// Checks at the start that deforming surfaces face each other along the width, and that there is a clearance all over
/// once the meshes are put together.
/// @throws InputError at the bearing: where the clearance is negative, and by how much.
void require_clearance(const model::Model& model, model::Machine& machine, const solver::State& start);

/// Meshes whose mean radius is not the one that the film reckons with.
[[nodiscard]] std::vector<Fault> offset_warnings(const model::Model& model);

}  // namespace hersey::run
