#include <cmath>

#include "element/element_families.h"
#include "element/interpolation.h"
#include "element/quadrature_rules.h"

namespace hersey::fem {
namespace {

constexpr std::array<Edge, 6> tetrahedron_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

ShapeFunctions linear_tetrahedron(const Vector3& xi) { return linear_simplex(Barycentric(xi, 3), 4); }
ShapeFunctions quadratic_tetrahedron(const Vector3& xi) {
  return quadratic_simplex(Barycentric(xi, 3), 4, tetrahedron_edges);
}

Eigen::VectorXd constant_stress(const Vector3& /*xi*/) { return Eigen::VectorXd::Ones(1); }
Eigen::VectorXd linear_stress(const Vector3& xi) { return Eigen::Vector4d(1, xi[0], xi[1], xi[2]); }

Eigen::Matrix3Xd tetrahedron_corners() {
  Eigen::Matrix3Xd xi = Eigen::Matrix3Xd::Zero(3, 4);
  xi.rightCols<3>().setIdentity();
  return xi;
}

/// Edges of the ideal corner: equal lengths.
Matrix3 ideal_tetrahedron() {
  const double half = 0.5, root = std::sqrt(0.75);
  Matrix3 edge = Matrix3::Identity();
  edge.col(1) = Vector3(half, root, 0);
  edge.col(2) = Vector3(half, root / 3, std::sqrt(2.0 / 3));
  return edge;
}

}  // namespace

std::vector<ElementKind> tetrahedra() {
  const std::vector<std::array<int, 4>> checked = {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 0, 2, 1}};
  return {{.type = ElementType::tet4,
           .name = "tet4",
           .nodes = 4,
           .corners = 4,
           .faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
           .files = {.abaqus = "C3D4", .nastran = "CTETRA", .gmsh = 4, .vtk = 10},
           .shape = linear_tetrahedron,
           .natural_nodes = tetrahedron_corners(),
           .stiffness_points = tetrahedron_centre(),
           .reduced_points = tetrahedron_centre(),
           .mass_points = tetrahedron_degree_2(),
           .stress_terms = constant_stress,
           .checked_corners = checked,
           .ideal_edges = ideal_tetrahedron()},
          {.type = ElementType::tet10,
           .name = "tet10",
           .nodes = 10,
           .corners = 4,
           .faces = {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}},
           .files = {.abaqus = "C3D10",
                     .nastran = "CTETRA",
                     .gmsh = 11,
                     .gmsh_order = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8},
                     .vtk = 24},
           .shape = quadratic_tetrahedron,
           .natural_nodes = with_middles(tetrahedron_corners(), tetrahedron_edges),
           .stiffness_points = tetrahedron_degree_2(),
           .reduced_points = tetrahedron_degree_2(),
           .mass_points = tetrahedron_degree_5(),
           .stress_terms = linear_stress,
           .checked_corners = checked,
           .ideal_edges = ideal_tetrahedron()}};
}

}  // namespace hersey::fem
