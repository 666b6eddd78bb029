#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/core/contract.h"
#include "hersey/fem/load_shapes.h"
#include "hersey/fem/load_vectors.h"

namespace hersey::fem {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Range axial_range(const Mesh& mesh, const std::vector<ElementFace>& faces, const Pose& X_bore) {
  Range range;
  for (const ElementFace& face : faces) {
    const Element& element = mesh.elements[static_cast<std::size_t>(face.element)];
    for (const int a : face_nodes(element.type, face.face)) {
      const double z = (X_bore * mesh.nodes[static_cast<std::size_t>(mesh.nodes_of(element)[a])]).z();
      range.low = std::min(range.low, z);
      range.high = std::max(range.high, z);
    }
  }
  return range;
}

double legendre(int l, double s) { return l == 0 ? 1 : l == 1 ? s : (3 * s * s - 1) / 2; }

}  // namespace

Eigen::MatrixXd bore_pressures(const Mesh& mesh, const std::vector<ElementFace>& faces, const Pose& X, int harmonics,
                               int axial) {
  HERSEY_REQUIRE(harmonics >= 0 && 0 <= axial && axial <= 2, "polynomials up to the second degree");
  HERSEY_REQUIRE(!faces.empty(), "a bore has faces");
  const Pose to_bore = X.inverse();
  const Range range = axial_range(mesh, faces, to_bore);
  Eigen::MatrixXd f(3 * static_cast<Eigen::Index>(mesh.nodes.size()), (2 * harmonics + 1) * (axial + 1));
  Eigen::Index column = 0;
  for (int l = 0; l <= axial; ++l)
    for (int k = -harmonics; k <= harmonics; ++k)  // negative: sin(|k| phi)
      f.col(column++) = traction_load(mesh, faces, [&](const Vector3& x, const Vector3& normal) -> Vector3 {
        const Vector3 at = to_bore * x;
        const double phi = std::atan2(at.y(), at.x());
        const double s = 2 * (at.z() - range.low) / (range.high - range.low) - 1;
        return -legendre(l, s) * (k < 0 ? std::sin(-k * phi) : std::cos(k * phi)) * normal;
      });
  return f;
}

}  // namespace hersey::fem
