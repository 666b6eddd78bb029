// Faces of a mesh on which a film lies, and the resolution of their displacements.
#include <fmt/format.h>

#include "hersey/core/contract.h"
#include "hersey/fem/film_surface.h"
#include "hersey/fem/load_distributions.h"
#include "surface/film_coordinates.h"

namespace hersey::fem {
namespace {

constexpr int most_around = 32, least_around = 8, least_on_arc = 4, most_along = 5;
constexpr double nodes_per_function = 1.5;

}  // namespace

std::vector<ElementFace> faces_on_cylinder(const Mesh& mesh, const FilmCylinder& cylinder, double tolerance) {
  const Pose to_cylinder = cylinder.X.inverse();
  std::vector<int> near;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (std::abs(cylinder_point(to_cylinder * mesh.nodes[n]).radius - cylinder.R) <= tolerance)
      near.push_back(static_cast<int>(n));
  std::vector<ElementFace> faces = outer_faces(mesh, near);
  std::erase_if(faces,
                [&](ElementFace face) { return !reaches_into(cylinder_box(mesh, face, to_cylinder), cylinder); });
  return faces;
}

SurfaceFunctions functions_for(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder) {
  HERSEY_REQUIRE(!faces.empty(), "a film's surface has faces");
  const Pose to_cylinder = cylinder.X.inverse();
  double angle = 0, length = 0;
  for (const ElementFace face : faces) {
    const CylinderBox box = cylinder_box(mesh, face, to_cylinder);
    const std::size_t nodes = nodes_of(mesh, face).size();
    const double per_edge = nodes > 4 ? 2 : 1;  // a quadratic edge has a node in its middle
    angle += (box.phi_high - box.phi_low) / per_edge;
    length += (box.z_high - box.z_low) / per_edge;
  }
  const auto count = static_cast<double>(faces.size());
  // On an arc as along the axis: one per distance and one more.
  const double whole = cylinder.arc ? cylinder.arc->over : 2 * std::numbers::pi, beyond = cylinder.arc ? 1 : 0;
  const int least = cylinder.arc ? least_on_arc : least_around;
  const double around = beyond + whole * count / (nodes_per_function * angle);
  const double along = 1 + cylinder.L * count / (nodes_per_function * length);
  // Written so that sums of zero, faces without extent, end at a limit.
  return {around > least ? static_cast<int>(std::lround(std::min<double>(around, most_around))) : least,
          along > 1 ? static_cast<int>(std::lround(std::min<double>(along, most_along))) : 1, cylinder.L, cylinder.arc};
}

}  // namespace hersey::fem
