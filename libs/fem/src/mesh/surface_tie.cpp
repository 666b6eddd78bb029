#include "mesh/surface_tie.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "hersey/fem/shape_functions.h"
#include "hersey/fem/skin.h"
#include "hersey/fem/solid_element.h"

namespace hersey::fem {
namespace {

constexpr double kTolerance = 0.05;  // of the faces' mean size, as is usual for *TIE without POSITION TOLERANCE
constexpr int kIterations = 30;
constexpr double kNoShare = 1e-12;  // of shape functions

struct Face {
  std::vector<int> nodes;
  Eigen::Matrix3Xd x;
  Vector3 lower, upper;
};

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  const Face* face = nullptr;
  Vector3 point = Vector3::Zero();
  NodeValues N;
};

/// Nearest point within the face's natural square or triangle.
Eigen::Vector2d inside(Eigen::Vector2d xi, bool is_triangle) {
  if (!is_triangle) return xi.cwiseMax(-1).cwiseMin(1);
  const double beyond = xi.sum() - 1;
  if (beyond > 0) xi -= Eigen::Vector2d::Constant(beyond / 2);
  xi = xi.cwiseMax(0);
  return xi.sum() > 1 ? Eigen::Vector2d(xi / xi.sum()) : xi;
}

/// Gauss and Newton's iteration for the foot of the perpendicular.
void look_at(const Face& face, const Vector3& r, Nearest& nearest) {
  const auto count = static_cast<int>(face.nodes.size());
  const bool is_triangle = count == 3 || count == 6;
  Eigen::Vector2d xi = Eigen::Vector2d::Constant(is_triangle ? 1.0 / 3 : 0);
  for (int k = 0; k < kIterations; ++k) {
    const FaceShape shape = face_shape(count, xi.x(), xi.y());
    const Eigen::Matrix<double, 3, 2> tangents = face.x * shape.dN;
    const Eigen::Matrix2d metric = tangents.transpose() * tangents;
    if (!(metric.determinant() > 0)) break;
    const Eigen::Vector2d next =
        inside(xi + metric.inverse() * (tangents.transpose() * (r - face.x * shape.N)), is_triangle);
    const double step = (next - xi).norm();
    xi = next;
    if (step < 1e-14) break;  // round-off of coordinates of the order of one
  }
  const FaceShape shape = face_shape(count, xi.x(), xi.y());
  const Vector3 point = face.x * shape.N;
  const double distance = (r - point).norm();
  if (distance < nearest.distance) nearest = {distance, &face, point, shape.N};
}

double distance_to_box(const Face& face, const Vector3& r) {
  return (r - r.cwiseMax(face.lower).cwiseMin(face.upper)).norm();
}

std::vector<Face> faces_of(const Mesh& mesh, const std::vector<ElementFace>& surface, double& mean_size) {
  std::vector<Face> faces;
  faces.reserve(surface.size());
  double sum = 0;
  for (const ElementFace& at : surface) {
    Face face{nodes_of(mesh, at), {}, {}, {}};
    face.x.resize(3, static_cast<Eigen::Index>(face.nodes.size()));
    for (std::size_t a = 0; a < face.nodes.size(); ++a)
      face.x.col(static_cast<Eigen::Index>(a)) = mesh.nodes[static_cast<std::size_t>(face.nodes[a])];
    face.lower = face.x.rowwise().minCoeff();
    face.upper = face.x.rowwise().maxCoeff();
    const double size = (face.upper - face.lower).norm();
    // A face bulges beyond the box of its nodes by less than its size.
    face.lower.array() -= size / 2;
    face.upper.array() += size / 2;
    sum += size;
    faces.push_back(std::move(face));
  }
  mean_size = faces.empty() ? 0 : sum / static_cast<double>(faces.size());
  return faces;
}

void add_tie(int node, const Nearest& nearest, std::vector<MeshTie>& ties) {
  for (int axis = 0; axis < 3; ++axis) {
    MeshTie tie{{node, axis, 1}};
    for (std::size_t a = 0; a < nearest.face->nodes.size(); ++a)
      if (const double N = nearest.N[static_cast<Eigen::Index>(a)]; std::abs(N) > kNoShare)
        tie.push_back({nearest.face->nodes[a], axis, -N});
    ties.push_back(std::move(tie));
  }
}

}  // namespace

SurfaceTie tie_to_faces(Mesh& mesh, const std::vector<int>& nodes, const std::vector<ElementFace>& surface,
                        const SurfaceTieOptions& options) {
  SurfaceTie result;
  double size = 0;
  const std::vector<Face> faces = faces_of(mesh, surface, size);
  result.tolerance = options.tolerance.value_or(kTolerance * size);
  std::set<int> own;
  for (const Face& face : faces) own.insert(face.nodes.begin(), face.nodes.end());
  for (const int node : nodes) {
    if (own.contains(node)) continue;
    Vector3& r = mesh.nodes[static_cast<std::size_t>(node)];
    Nearest nearest;
    for (const Face& face : faces)
      if (const double least = distance_to_box(face, r); least < nearest.distance && least <= result.tolerance)
        look_at(face, r, nearest);
    if (!(nearest.distance <= result.tolerance)) {
      result.loose.push_back(node);
      continue;
    }
    add_tie(node, nearest, result.ties);
    if (!options.adjusts) continue;
    result.moved = std::max(result.moved, nearest.distance);
    r = nearest.point;
  }
  return result;
}

}  // namespace hersey::fem
