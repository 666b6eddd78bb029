#include "contact/mesh_surface.h"

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

std::vector<BoxTree::Box> triangle_boxes(const TriangleMesh& mesh) {
  std::vector<BoxTree::Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    BoxTree::Box box;
    for (const int corner : triangle) box.extend(mesh.corners[corner]);
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<BoxTree::Box> corner_boxes(const TriangleMesh& mesh) { return {mesh.corners.begin(), mesh.corners.end()}; }

}  // namespace

MeshSurface::MeshSurface(std::shared_ptr<const TriangleMesh> mesh)
    : mesh_(std::move(mesh)),
      corner_areas_(mesh_->corners.size(), 0.0),
      around_start_(mesh_->corners.size() + 1, 0),
      around_(3 * mesh_->triangles.size()),
      triangles_(triangle_boxes(*mesh_)),
      corners_(corner_boxes(*mesh_)) {
  normals_.reserve(mesh_->triangles.size());
  for (const std::array<int, 3>& t : mesh_->triangles) {
    const Vector3& a = mesh_->corners[t[0]];
    const Vector3 twice = (mesh_->corners[t[1]] - a).cross(mesh_->corners[t[2]] - a);
    normals_.emplace_back(twice.normalized());
    for (const int corner : t) {
      corner_areas_[corner] += twice.norm() / 6;
      ++around_start_[corner + 1];
    }
  }
  for (std::size_t c = 1; c < around_start_.size(); ++c) around_start_[c] += around_start_[c - 1];
  std::vector<int> next(around_start_.begin(), around_start_.end() - 1);
  for (std::size_t t = 0; t < mesh_->triangles.size(); ++t)
    for (const int corner : mesh_->triangles[t]) around_[next[corner]++] = static_cast<int>(t);
}

NearestOnTriangle MeshSurface::nearest_on(int triangle, const Vector3& p) const {
  const Vector3 &a = corner(triangle, 0), &b = corner(triangle, 1), &c = corner(triangle, 2);
  const Vector3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const auto found = [&](Feature feature, int part, const Vector3& point) {
    return NearestOnTriangle{feature, part, point, (p - point).norm()};
  };
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return found(Feature::corner, 0, a);
  if (d3 >= 0 && d4 <= d3) return found(Feature::corner, 1, b);
  if (d6 >= 0 && d5 <= d6) return found(Feature::corner, 2, c);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return found(Feature::edge, 0, a + d1 / (d1 - d3) * ab);
  if (va <= 0 && d4 >= d3 && d5 >= d6) return found(Feature::edge, 1, b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return found(Feature::edge, 2, a + d2 / (d2 - d6) * ac);
  return found(Feature::face, 0, a + (vb * ab + vc * ac) / (va + vb + vc));
}

bool MeshSurface::is_local_minimum(int triangle, const NearestOnTriangle& found, const Vector3& p) const {
  if (found.feature == Feature::face) return true;
  const std::array<int, 3>& own = mesh_->triangles[triangle];
  const int first = own[found.part], second = own[(found.part + 1) % 3];
  for (int i = around_start_[first]; i < around_start_[first + 1]; ++i) {
    const int neighbour = around_[i];
    if (neighbour == triangle) continue;
    const std::array<int, 3>& t = mesh_->triangles[neighbour];
    const bool shares_edge = t[0] == second || t[1] == second || t[2] == second;
    if (found.feature == Feature::edge && !shares_edge) continue;
    if (nearest_on(neighbour, p).distance < found.distance * (1 - round_off)) return false;
  }
  return true;
}

}  // namespace hersey::mbd
