#include <cmath>

#include "element/element_families.h"
#include "element/interpolation.h"
#include "element/quadrature_rules.h"

namespace hersey::fem {
namespace {

constexpr std::array<Edge, 9> wedge_edges = {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

// A triangle's functions times a line's.
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

Eigen::VectorXd wedge_stress_terms(const Vector3& xi) {
  const double x = xi[0], y = xi[1], z = xi[2];
  return (Vector6() << 1, x, y, z, x * z, y * z).finished();
}

Eigen::Matrix3Xd wedge_corners() {
  Eigen::Matrix3Xd xi(3, 6);
  for (int a = 0; a < 6; ++a) xi.col(a) = Vector3(a % 3 == 1, a % 3 == 2, a < 3 ? -1 : 1);
  return xi;
}

/// Edges of the ideal corner: an equilateral triangle and a perpendicular edge.
Matrix3 ideal_wedge() {
  Matrix3 edge = Matrix3::Identity();
  edge.col(1) = Vector3(0.5, std::sqrt(0.75), 0);
  return edge;
}

}  // namespace

std::vector<ElementKind> wedges() {
  const std::vector<std::array<int, 4>> checked = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                                   {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};
  const std::vector<QuadraturePoint> six = wedge_rule(triangle_degree_2(), gauss_2()),
                                     nine = wedge_rule(triangle_degree_2(), gauss_3()),
                                     twenty_one = wedge_rule(triangle_degree_5(), gauss_3());
  return {{.type = ElementType::wedge6,
           .name = "wedge6",
           .nodes = 6,
           .corners = 6,
           .faces = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
           .files = {.abaqus = "C3D6", .nastran = "CPENTA", .gmsh = 6, .vtk = 13},
           .shape = linear_wedge,
           .natural_nodes = wedge_corners(),
           .stiffness_points = six,
           .reduced_points = six,
           .mass_points = twenty_one,
           .stress_terms = wedge_stress_terms,
           .checked_corners = checked,
           .ideal_edges = ideal_wedge()},
          {.type = ElementType::wedge15,
           .name = "wedge15",
           .nodes = 15,
           .corners = 6,
           .faces = {{0, 2, 1, 8, 7, 6},
                     {3, 4, 5, 9, 10, 11},
                     {0, 1, 4, 3, 6, 13, 9, 12},
                     {1, 2, 5, 4, 7, 14, 10, 13},
                     {2, 0, 3, 5, 8, 12, 11, 14}},
           .files = {.abaqus = "C3D15",
                     .nastran = "CPENTA",
                     .nastran_order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11},
                     .gmsh = 18,
                     .gmsh_order = {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11},
                     .vtk = 26},
           .shape = quadratic_wedge,
           .natural_nodes = with_middles(wedge_corners(), wedge_edges),
           .stiffness_points = nine,
           .reduced_points = nine,
           .mass_points = twenty_one,
           .stress_terms = wedge_stress_terms,
           .checked_corners = checked,
           .ideal_edges = ideal_wedge()}};
}

}  // namespace hersey::fem
