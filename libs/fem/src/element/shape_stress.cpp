#include "hersey/fem/shape_stress.h"

#include "hersey/fem/stress.h"

namespace hersey::fem {

ShapeStress::ShapeStress(const Mesh& mesh, const std::vector<SolidMaterial>& materials, const Eigen::MatrixXd& shapes)
    : by_amplitude_(6 * static_cast<Eigen::Index>(mesh.nodes.size()), shapes.cols()) {
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const Stress stress = recover_stress(mesh, materials, shapes.col(k));
    by_amplitude_.col(k) = Eigen::Map<const Eigen::VectorXd>(stress.nodal.data(), by_amplitude_.rows());
  }
}

Eigen::Matrix<double, 6, Eigen::Dynamic> ShapeStress::nodal(const Eigen::VectorXd& amplitudes) const {
  Eigen::Matrix<double, 6, Eigen::Dynamic> stress(6, by_amplitude_.rows() / 6);
  Eigen::Map<Eigen::VectorXd>(stress.data(), stress.size()).noalias() = by_amplitude_ * amplitudes;
  return stress;
}

}  // namespace hersey::fem
