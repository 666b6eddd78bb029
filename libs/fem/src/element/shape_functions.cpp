#include "hersey/fem/shape_functions.h"

#include <array>
#include <span>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

using Edge = std::array<int, 2>;
using Signs = std::array<int, 3>;

constexpr std::array<Edge, 6> tet_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 9> wedge_edges = {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Edge, 12> hex_edges = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
constexpr std::array<Signs, 8> hex_corners = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
constexpr std::array<Signs, 4> quad_corners = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

ShapeFunctions sized(int nodes) { return {NodeValues(nodes), NodeGradients(nodes, 3)}; }

// ---- simplices: L_0 = 1 - sum xi, L_i = xi_i
// -------------------------------------------------------------------------

/// Barycentric coordinates and their constant gradients.
struct Barycentric {
  Eigen::Vector4d L = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 3> dL = Eigen::Matrix<double, 4, 3>::Zero();

  Barycentric(const Vector3& xi, int dimension) {
    L[0] = 1;
    for (int k = 0; k < dimension; ++k) {
      L[0] -= xi[k];
      L[k + 1] = xi[k];
      dL(0, k) = -1;
      dL(k + 1, k) = 1;
    }
  }
};

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

// ---- wedges: triangle times line
// --------------------------------------------------------------------------------------

ShapeFunctions linear_wedge(const Vector3& xi) {
  const Barycentric b(xi, 2);
  ShapeFunctions s = sized(6);
  for (int a = 0; a < 6; ++a) {
    const int i = a % 3, side = a < 3 ? -1 : 1;
    s.N[a] = b.L[i] * (1 + side * xi[2]) / 2;
    s.dN.row(a) = b.dL.row(i) * (1 + side * xi[2]) / 2;
    s.dN(a, 2) = b.L[i] * side / 2;
  }
  return s;
}

ShapeFunctions quadratic_wedge(const Vector3& xi) {
  const Barycentric b(xi, 2);
  const double z = xi[2];
  ShapeFunctions s = sized(15);
  for (int a = 0; a < 6; ++a) {
    const int i = a % 3, side = a < 3 ? -1 : 1;
    const double L = b.L[i], up = 1 + side * z, rest = 2 * L - 2 + side * z;
    s.N[a] = L * up * rest / 2;
    s.dN.row(a) = b.dL.row(i) * (up * (rest + 2 * L) / 2);
    s.dN(a, 2) = L * side * (rest + up) / 2;
  }
  for (int e = 0; e < 6; ++e) {
    const int i = wedge_edges[e][0] % 3, j = wedge_edges[e][1] % 3, side = e < 3 ? -1 : 1;
    s.N[6 + e] = 2 * b.L[i] * b.L[j] * (1 + side * z);
    s.dN.row(6 + e) = 2 * (1 + side * z) * (b.L[i] * b.dL.row(j) + b.L[j] * b.dL.row(i));
    s.dN(6 + e, 2) = 2 * b.L[i] * b.L[j] * side;
  }
  for (int i = 0; i < 3; ++i) {
    s.N[12 + i] = b.L[i] * (1 - z * z);
    s.dN.row(12 + i) = b.dL.row(i) * (1 - z * z);
    s.dN(12 + i, 2) = -2 * z * b.L[i];
  }
  return s;
}

// ---- squares and cubes: serendipity; `d` of the three factors 1 + s_k xi_k or 1 - xi_k^2 take part
// -----------------------

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

template <std::size_t C>
ShapeFunctions multilinear(int d, const std::array<Signs, C>& corners, const Vector3& xi) {
  ShapeFunctions s = sized(static_cast<int>(C));
  for (std::size_t a = 0; a < C; ++a) {
    Vector3 gradient;
    multilinear_corner(d, corners[a], xi, s.N[a], gradient);
    s.dN.row(a) = gradient.transpose();
  }
  return s;
}

template <std::size_t C>
ShapeFunctions serendipity(int d, const std::array<Signs, C>& corners, std::span<const Edge> edges, const Vector3& xi) {
  ShapeFunctions s = sized(static_cast<int>(C + edges.size()));
  double value = 0;
  Vector3 gradient;
  for (std::size_t a = 0; a < C; ++a) {
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
  int a = static_cast<int>(C);
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

}  // namespace

ShapeFunctions shape_functions(ElementType type, const Vector3& xi) {
  switch (type) {
    case ElementType::tet4:
      return linear_simplex(Barycentric(xi, 3), 4);
    case ElementType::tet10:
      return quadratic_simplex(Barycentric(xi, 3), 4, tet_edges);
    case ElementType::wedge6:
      return linear_wedge(xi);
    case ElementType::wedge15:
      return quadratic_wedge(xi);
    case ElementType::hex8:
      return multilinear(3, hex_corners, xi);
    case ElementType::hex20:
      return serendipity(3, hex_corners, hex_edges, xi);
    case ElementType::beam2:
      break;
  }
  HERSEY_REQUIRE(type != ElementType::beam2, "a beam is no solid");
  return {};
}

Eigen::Matrix3Xd natural_nodes(ElementType type) {
  HERSEY_REQUIRE(type != ElementType::beam2, "a beam is no solid");
  const int n = node_count(type);
  Eigen::Matrix3Xd xi = Eigen::Matrix3Xd::Zero(3, n);
  std::span<const Edge> edges;
  int corners = 0;
  if (type == ElementType::tet4 || type == ElementType::tet10) {
    corners = 4;
    xi.block<3, 3>(0, 1).setIdentity();
    edges = tet_edges;
  } else if (type == ElementType::wedge6 || type == ElementType::wedge15) {
    corners = 6;
    for (int a = 0; a < 6; ++a) xi.col(a) = Vector3(a % 3 == 1, a % 3 == 2, a < 3 ? -1 : 1);
    edges = wedge_edges;
  } else {
    corners = 8;
    for (int a = 0; a < 8; ++a) xi.col(a) = Vector3(hex_corners[a][0], hex_corners[a][1], hex_corners[a][2]);
    edges = hex_edges;
  }
  for (int a = corners; a < n; ++a) {
    const Edge& edge = edges[static_cast<std::size_t>(a - corners)];
    xi.col(a) = (xi.col(edge[0]) + xi.col(edge[1])) / 2;
  }
  return xi;
}

FaceShape face_shape(int nodes, double xi, double eta) {
  HERSEY_REQUIRE(nodes == 3 || nodes == 4 || nodes == 6 || nodes == 8, "faces are triangles or squares");
  constexpr std::array<Edge, 3> triangle_edges = {{{0, 1}, {1, 2}, {2, 0}}};
  constexpr std::array<Edge, 4> quad_edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  const Vector3 at(xi, eta, 0);
  const ShapeFunctions s = nodes == 3   ? linear_simplex(Barycentric(at, 2), 3)
                           : nodes == 6 ? quadratic_simplex(Barycentric(at, 2), 3, triangle_edges)
                           : nodes == 4 ? multilinear(2, quad_corners, at)
                                        : serendipity(2, quad_corners, quad_edges, at);
  return {s.N, s.dN.leftCols<2>()};
}

}  // namespace hersey::fem
