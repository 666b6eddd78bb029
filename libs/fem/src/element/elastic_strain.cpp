#include "element/elastic_strain.h"

#include <optional>

#include "element/incompatible_modes.h"
#include "hersey/fem/solid_element.h"

namespace hersey::fem {

Eigen::Matrix<double, 6, Eigen::Dynamic> element_strain(ElementType type, const NodeColumns& x,
                                                        const SolidMaterial& material, const NodeColumns& u,
                                                        const std::vector<Vector3>& points) {
  return elastic_strain(type, x, material, u, {}, points);
}

Eigen::Matrix<double, 6, Eigen::Dynamic> elastic_strain(ElementType type, const NodeColumns& x,
                                                        const SolidMaterial& material, const NodeColumns& u,
                                                        const NodeValues& stretch, const std::vector<Vector3>& points) {
  const Eigen::Map<const Eigen::VectorXd> displacement(u.data(), u.size());
  Eigen::Matrix<double, 6, Eigen::Dynamic> strain(6, points.size());
  const std::optional<IncompatibleModes> modes =
      type == ElementType::hex8 ? std::optional<IncompatibleModes>(x) : std::nullopt;
  Eigen::Matrix<double, 9, 1> amplitude = Eigen::Matrix<double, 9, 1>::Zero();
  if (modes) {
    if (stretch.size() > 0) amplitude = modes->forces(x, stress_of_stretch(material)) * stretch;
    amplitude = modes->amplitudes(x, material.D, u, amplitude);
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    const ShapeFunctions shape = shape_functions(type, points[p]);
    const ElementPoint at = element_point(shape, x);
    Vector6 e = strain_matrix(at.gradients) * displacement;
    if (modes) e += modes->strain(points[p], at.jacobian) * amplitude;
    if (stretch.size() > 0) e.head<3>().array() -= shape.N.dot(stretch);
    strain.col(static_cast<Eigen::Index>(p)) = e;
  }
  return strain;
}

}  // namespace hersey::fem
