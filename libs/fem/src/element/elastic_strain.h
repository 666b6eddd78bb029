#pragma once

#include <vector>

#include "hersey/fem/element_point.h"
#include "hersey/fem/solid_material.h"

namespace hersey::fem {

/// Returns the stress of a unit strain in all directions [Pa], D m with m = (1, 1, 1, 0, 0, 0).
[[nodiscard]] inline Vector6 stress_of_stretch(const SolidMaterial& material) {
  return material.D.leftCols<3>().rowwise().sum();
}

/// Returns element_strain less a strain that causes no stress in every direction, such as thermal strain, (elastic.29):
/// `stretch`, by its values at the nodes; empty: none.
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> elastic_strain(ElementType type, const NodeColumns& x,
                                                                      const SolidMaterial& material,
                                                                      const NodeColumns& u, const NodeValues& stretch,
                                                                      const std::vector<Vector3>& points);

}  // namespace hersey::fem
