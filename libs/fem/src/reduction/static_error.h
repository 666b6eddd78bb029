#pragma once

#include <vector>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/reduction_options.h"
#include "hersey/fem/vibration.h"

namespace hersey::fem {

/// Static shapes of surfaces that a reduced body needs beside its modes.
struct StaticShapes {
  Eigen::MatrixXd added;  ///< displacements (3 n, added), K-orthonormal and K-orthogonal to the modes
  std::vector<StaticError> errors;
};

/// Adds the static displacement with the largest error until none is larger than options.static_error, (elastic.16).
/// @param stiffness  factorised, frames fixed
[[nodiscard]] StaticShapes static_shapes(const ConstrainedStiffness& stiffness, const Vibration& modes,
                                         const ReductionOptions& options);

}  // namespace hersey::fem
