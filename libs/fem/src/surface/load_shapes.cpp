#include "hersey/fem/load_shapes.h"

#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/load_vectors.h"

namespace hersey::fem {
namespace {

constexpr double flat =
    1e-2;  // share of the normals' squares along the axis, below which no normal has a component along it
constexpr double curved = 5e-2;  // share across the axis, above which faces are part of a bore

/// Mean of n n^T over the area of faces.
Matrix3 spread_of_normals(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  Matrix3 sum = Matrix3::Zero();
  double area = 0;
  for (int k = 0; k < 3; ++k) {
    // The traction n_k n sums up to a column.
    const Eigen::VectorXd f =
        traction_load(mesh, faces, [&](const Vector3&, const Vector3& n) -> Vector3 { return n[k] * n; });
    sum.col(k) = Eigen::Map<const Eigen::Matrix3Xd>(f.data(), 3, f.size() / 3).rowwise().sum();
    area += sum(k, k);
  }
  return sum / area;
}

/// The point nearest to the lines along all normals: the centre of a bore, also of a part of one.
Vector3 centre_of(const Mesh& mesh, const std::vector<ElementFace>& faces, const Vector3& axis) {
  Matrix3 A = Matrix3::Zero();
  Vector3 b = Vector3::Zero(), middle = Vector3::Zero();
  double area = 0;
  (void)traction_load(mesh, faces, [&](const Vector3& x, const Vector3& n) -> Vector3 {
    const Matrix3 P = Matrix3::Identity() - n * n.transpose() - axis * axis.transpose();
    A += P;
    b += P * x;
    middle += x;
    ++area;
    return Vector3::Zero();
  });
  middle /= area;
  A += area * axis * axis.transpose();
  return A.ldlt().solve(b + area * axis * axis.dot(middle));
}

/// Returns a uniform pressure and one that varies linearly in each direction in which the face extends.
Eigen::MatrixXd face_pressures(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  std::vector<int> nodes = nodes_on(mesh, faces);
  Vector3 middle = Vector3::Zero();
  for (const int n : nodes) middle += mesh.nodes[static_cast<std::size_t>(n)] / static_cast<double>(nodes.size());
  Matrix3 S = Matrix3::Zero();
  for (const int n : nodes) {
    const Vector3 r = mesh.nodes[static_cast<std::size_t>(n)] - middle;
    S += r * r.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> extent(S);
  const Vector3 sizes = (extent.eigenvalues().cwiseMax(0) / static_cast<double>(nodes.size())).cwiseSqrt();
  Eigen::MatrixXd f = pressure_load(mesh, faces, 1);
  for (int k = 2; k >= 0; --k) {
    if (sizes[k] < flat * sizes[2]) continue;
    const Vector3 along = extent.eigenvectors().col(k) / sizes[k];
    f.conservativeResize(Eigen::NoChange, f.cols() + 1);
    f.rightCols<1>() = traction_load(
        mesh, faces, [&](const Vector3& x, const Vector3& n) -> Vector3 { return -along.dot(x - middle) * n; });
  }
  return f;
}

}  // namespace

std::optional<Pose> bore_of(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> normals(spread_of_normals(mesh, faces));
  if (normals.eigenvalues()[0] > flat || normals.eigenvalues()[1] < curved) return std::nullopt;
  Matrix3 R;
  R.col(2) = normals.eigenvectors().col(0);
  R.col(0) = normals.eigenvectors().col(2);
  R.col(1) = R.col(2).cross(R.col(0));
  return Pose{R, centre_of(mesh, faces, R.col(2))};
}

LoadedSurface loaded_surface(const Mesh& mesh, const std::string& name, int harmonics) {
  const std::vector<ElementFace> faces = faces_called(mesh, name);
  HERSEY_REQUIRE(!faces.empty(), "the caller knows that there are faces of this name");
  LoadedSurface surface{.name = name, .loads = {}, .nodes = nodes_on(mesh, faces), .areas = {}};
  std::vector<int> index(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    index[static_cast<std::size_t>(surface.nodes[i])] = static_cast<int>(i);
  surface.areas = nodal_areas(mesh, faces, index, surface.nodes.size());
  const std::optional<Pose> bore = bore_of(mesh, faces);
  surface.loads = bore ? bore_pressures(mesh, faces, *bore, harmonics) : face_pressures(mesh, faces);
  return surface;
}

}  // namespace hersey::fem
