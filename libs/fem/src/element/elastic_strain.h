#pragma once

#include <vector>

#include "hersey/fem/element_point.h"
#include "hersey/fem/solid_material.h"

namespace hersey::fem {

/// The stress of a unit of strain in all directions [Pa], D m with m = (1, 1, 1, 0, 0, 0).
[[nodiscard]] inline Vector6 stress_of_stretch(const SolidMaterial& material) {
  return material.D.leftCols<3>().rowwise().sum();
}

/// As element_strain, less a strain in every direction that makes no stress, such as that of temperature, (elastic.29):
/// `stretch`, by its values at the nodes; empty: none.
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> elastic_strain(ElementType type, const NodeColumns& x,
                                                                      const SolidMaterial& material,
                                                                      const NodeColumns& u, const NodeValues& stretch,
                                                                      const std::vector<Vector3>& points);

}  // namespace hersey::fem
