#include "element/interpolation.h"

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

/// prod_k f_k and its gradient, for factors f_k(xi_k) with derivatives g_k.
void product(int d, const Vector3& f, const Vector3& g, double& value, Vector3& gradient) {
  value = 1;
  gradient.setZero();
  for (int k = 0; k < d; ++k) value *= f[k];
  for (int k = 0; k < d; ++k) {
    gradient[k] = g[k];
    for (int l = 0; l < d; ++l)
      if (l != k) gradient[k] *= f[l];
  }
}

void multilinear_corner(int d, const Signs& corner, const Vector3& xi, double& value, Vector3& gradient) {
  Vector3 f, g;
  for (int k = 0; k < 3; ++k) {
    f[k] = (1 + corner[k] * xi[k]) / 2;
    g[k] = corner[k] / 2.0;
  }
  product(d, f, g, value, gradient);
}

}  // namespace

ShapeFunctions sized(int nodes) { return {NodeValues(nodes), NodeGradients(nodes, 3)}; }

Barycentric::Barycentric(const Vector3& xi, int dimension) {
  L[0] = 1;
  for (int k = 0; k < dimension; ++k) {
    L[0] -= xi[k];
    L[k + 1] = xi[k];
    dL(0, k) = -1;
    dL(k + 1, k) = 1;
  }
}

ShapeFunctions linear_simplex(const Barycentric& b, int corners) {
  ShapeFunctions s = sized(corners);
  for (int a = 0; a < corners; ++a) {
    s.N[a] = b.L[a];
    s.dN.row(a) = b.dL.row(a);
  }
  return s;
}

ShapeFunctions quadratic_simplex(const Barycentric& b, int corners, std::span<const Edge> edges) {
  ShapeFunctions s = sized(corners + static_cast<int>(edges.size()));
  for (int a = 0; a < corners; ++a) {
    s.N[a] = b.L[a] * (2 * b.L[a] - 1);
    s.dN.row(a) = (4 * b.L[a] - 1) * b.dL.row(a);
  }
  int a = corners;
  for (const auto& [i, j] : edges) {
    s.N[a] = 4 * b.L[i] * b.L[j];
    s.dN.row(a++) = 4 * (b.L[i] * b.dL.row(j) + b.L[j] * b.dL.row(i));
  }
  return s;
}

ShapeFunctions multilinear(int d, std::span<const Signs> corners, const Vector3& xi) {
  ShapeFunctions s = sized(static_cast<int>(corners.size()));
  for (std::size_t a = 0; a < corners.size(); ++a) {
    Vector3 gradient;
    multilinear_corner(d, corners[a], xi, s.N[a], gradient);
    s.dN.row(a) = gradient.transpose();
  }
  return s;
}

ShapeFunctions serendipity(int d, std::span<const Signs> corners, std::span<const Edge> edges, const Vector3& xi) {
  ShapeFunctions s = sized(static_cast<int>(corners.size() + edges.size()));
  double value = 0;
  Vector3 gradient;
  for (std::size_t a = 0; a < corners.size(); ++a) {
    multilinear_corner(d, corners[a], xi, value, gradient);
    double rest = 1 - d;
    Vector3 rest_gradient = Vector3::Zero();
    for (int k = 0; k < d; ++k) {
      rest += corners[a][k] * xi[k];
      rest_gradient[k] = corners[a][k];
    }
    s.N[a] = value * rest;
    s.dN.row(a) = (gradient * rest + value * rest_gradient).transpose();
  }
  int a = static_cast<int>(corners.size());
  for (const auto& [i, j] : edges) {
    Vector3 f, g;
    for (int k = 0; k < 3; ++k) {
      const int along = corners[i][k] != corners[j][k], side = corners[i][k];
      f[k] = along ? 1 - xi[k] * xi[k] : (1 + side * xi[k]) / 2;
      g[k] = along ? -2 * xi[k] : side / 2.0;
    }
    product(d, f, g, s.N[a], gradient);
    s.dN.row(a++) = gradient.transpose();
  }
  return s;
}

Eigen::Matrix3Xd with_middles(const Eigen::Matrix3Xd& corners, std::span<const Edge> edges) {
  Eigen::Matrix3Xd xi(3, corners.cols() + static_cast<Eigen::Index>(edges.size()));
  xi.leftCols(corners.cols()) = corners;
  Eigen::Index a = corners.cols();
  for (const auto& [i, j] : edges) xi.col(a++) = (corners.col(i) + corners.col(j)) / 2;
  return xi;
}

FaceShape face_shape(int nodes, double xi, double eta) {
  HERSEY_REQUIRE(nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8, "faces are triangles or squares");
  constexpr std::array<Edge, 3> triangle_edges = {{{0, 1}, {1, 2}, {2, 0}}};
  constexpr std::array<Edge, 4> square_edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  constexpr std::array<Signs, 4> square_corners = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
  const Vector3 at(xi, eta, 0);
  const ShapeFunctions s = nodes == 3   ? linear_simplex(Barycentric(at, 2), 3)
                           : nodes == 6 ? quadratic_simplex(Barycentric(at, 2), 3, triangle_edges)
                           : nodes == 4 ? multilinear(2, square_corners, at)
                                        : serendipity(2, square_corners, square_edges, at);
  return {s.N, s.dN.leftCols<2>()};
}

}  // namespace hersey::fem
