#include "element/element_families.h"
#include "element/interpolation.h"
#include "element/quadrature_rules.h"

namespace hersey::fem {
namespace {

constexpr std::array<Edge, 12> hexahedron_edges = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
constexpr std::array<Signs, 8> hexahedron_signs = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

ShapeFunctions linear_hexahedron(const Vector3& xi) { return multilinear(3, hexahedron_signs, xi); }
ShapeFunctions quadratic_hexahedron(const Vector3& xi) {
  return serendipity(3, hexahedron_signs, hexahedron_edges, xi);
}

Eigen::VectorXd hexahedron_stress_terms(const Vector3& xi) {
  const double x = xi[0], y = xi[1], z = xi[2];
  return (Eigen::Matrix<double, 8, 1>() << 1, x, y, z, x * y, y * z, x * z, x * y * z).finished();
}

Eigen::Matrix3Xd hexahedron_corners() {
  Eigen::Matrix3Xd xi(3, 8);
  Eigen::Index a = 0;
  for (const auto& [x, y, z] : hexahedron_signs) xi.col(a++) = Vector3(x, y, z);
  return xi;
}

}  // namespace

std::vector<ElementKind> hexahedra() {
  const std::vector<std::array<int, 4>> checked = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                                   {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
  const std::vector<QuadraturePoint> eight = cube_rule(gauss_2()), twenty_seven = cube_rule(gauss_3());
  return {{.type = ElementType::hex8,
           .name = "hex8",
           .nodes = 8,
           .corners = 8,
           .faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}},
           .files = {.abaqus = "C3D8", .nastran = "CHEXA", .gmsh = 5, .vtk = 12},
           .shape = linear_hexahedron,
           .natural_nodes = hexahedron_corners(),
           .stiffness_points = eight,
           .reduced_points = eight,
           .mass_points = twenty_seven,
           .stress_terms = hexahedron_stress_terms,
           .checked_corners = checked},
          {.type = ElementType::hex20,
           .name = "hex20",
           .nodes = 20,
           .corners = 8,
           .faces = {{0, 3, 2, 1, 11, 10, 9, 8},
                     {4, 5, 6, 7, 12, 13, 14, 15},
                     {0, 1, 5, 4, 8, 17, 12, 16},
                     {1, 2, 6, 5, 9, 18, 13, 17},
                     {2, 3, 7, 6, 10, 19, 14, 18},
                     {3, 0, 4, 7, 11, 16, 15, 19}},
           .files = {.abaqus = "C3D20",
                     .nastran = "CHEXA",
                     .nastran_order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15},
                     .gmsh = 17,
                     .gmsh_order = {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15},
                     .vtk = 25},
           .shape = quadratic_hexahedron,
           .natural_nodes = with_middles(hexahedron_corners(), hexahedron_edges),
           .stiffness_points = twenty_seven,
           .reduced_points = eight,
           .mass_points = twenty_seven,
           .stress_terms = hexahedron_stress_terms,
           .checked_corners = checked}};
}

}  // namespace hersey::fem
