#include "hersey/fem/contact_modes.h"

#include "hersey/fem/load_vectors.h"

namespace hersey::fem {

FilmModes contact_modes(const ConstrainedStiffness& stiffness, const Mesh& mesh, const std::vector<ElementFace>& faces,
                        int most, double tolerance) {
  const Eigen::Matrix3Xd normals = nodal_normals(mesh, faces);
  std::vector<Eigen::Triplet<double>> forces;
  std::vector<double> areas;
  for (Eigen::Index node = 0; node < normals.cols(); ++node) {
    const double area = normals.col(node).norm();
    if (area == 0) continue;
    const auto column = static_cast<int>(areas.size());
    for (int axis = 0; axis < 3; ++axis)
      forces.emplace_back(static_cast<int>(3 * node) + axis, column, normals(axis, node));
    areas.push_back(area);
  }
  SurfaceMap map;
  map.T.resize(normals.size(), static_cast<Eigen::Index>(areas.size()));
  map.T.setFromTriplets(forces.begin(), forces.end());
  map.G = Eigen::Map<const Eigen::VectorXd>(areas.data(), map.T.cols()).asDiagonal();
  return film_modes(stiffness, map, most, tolerance);
}

}  // namespace hersey::fem
