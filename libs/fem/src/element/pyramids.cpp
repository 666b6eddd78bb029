// Pyramids on a square: Bedrosian (1992), Int. J. Numer. Methods Eng. 35, 95.
#include <cmath>

#include "element/element_families.h"
#include "element/interpolation.h"
#include "element/quadrature_rules.h"

namespace hersey::fem {
namespace {

constexpr std::array<Edge, 8> pyramid_edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<Signs, 4> pyramid_signs = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};

/// (elastic.30). Where a point lies in the square that the pyramid has at its height, r = xi/u and s = eta/u, u = 1 -
/// zeta of the way to the apex left. At the apex itself r and s are any: the middle is as good.
struct SquarePoint {
  double r = 0, s = 0, u = 1;

  explicit SquarePoint(const Vector3& xi) : u(1 - xi[2]) {
    if (u == 0) return;
    r = xi[0] / u;
    s = xi[1] / u;
  }
};

/// g(r, s, u) of a shape function N = u g, and its derivatives.
struct Factor {
  double g = 0, by_r = 0, by_s = 0, by_u = 0;
};

/// N = u g and its gradient by xi, eta and zeta, without a division by u: dr/dxi = 1/u, dr/dzeta = r/u.
void put(const Factor& f, const SquarePoint& at, Eigen::Index a, ShapeFunctions& shape) {
  shape.N[a] = at.u * f.g;
  shape.dN.row(a) << f.by_r, f.by_s, at.r * f.by_r + at.s * f.by_s - f.g - at.u * f.by_u;
}

/// h (1 + i r)(1 + j s) for a factor h of r, s and u.
Factor times_corner(const Factor& h, double i, double j, const SquarePoint& at) {
  const double along = 1 + i * at.r, across = 1 + j * at.s;
  return {h.g * along * across, (h.by_r * along + h.g * i) * across, (h.by_s * across + h.g * j) * along,
          h.by_u * along * across};
}

ShapeFunctions linear_pyramid(const Vector3& xi) {
  const SquarePoint at(xi);
  ShapeFunctions shape = sized(5);
  for (std::size_t a = 0; a < 4; ++a)
    put(times_corner({.g = 0.25}, pyramid_signs[a][0], pyramid_signs[a][1], at), at, static_cast<Eigen::Index>(a),
        shape);
  shape.N[4] = 1 - at.u;
  shape.dN.row(4) << 0, 0, 1;
  return shape;
}

ShapeFunctions quadratic_pyramid(const Vector3& xi) {
  const SquarePoint at(xi);
  const double zeta = 1 - at.u;
  ShapeFunctions shape = sized(13);
  for (std::size_t a = 0; a < 4; ++a) {
    const double i = pyramid_signs[a][0], j = pyramid_signs[a][1];
    const Factor corner{(at.u * (i * at.r + j * at.s) - 1) / 4, at.u * i / 4, at.u * j / 4, (i * at.r + j * at.s) / 4};
    put(times_corner(corner, i, j, at), at, static_cast<Eigen::Index>(a), shape);
    put(times_corner({.g = zeta, .by_u = -1}, i, j, at), at, static_cast<Eigen::Index>(a) + 9, shape);
  }
  shape.N[4] = zeta * (2 * zeta - 1);
  shape.dN.row(4) << 0, 0, 4 * zeta - 1;
  const double around_r = 1 - at.r * at.r, around_s = 1 - at.s * at.s;
  for (const int side : {-1, 1}) {
    const Factor along_r{at.u * around_r / 2, -at.u * at.r, 0, around_r / 2};
    const Factor along_s{at.u * around_s / 2, 0, -at.u * at.s, around_s / 2};
    put(times_corner(along_r, 0, side, at), at, side < 0 ? 5 : 7, shape);
    put(times_corner(along_s, side, 0, at), at, side < 0 ? 8 : 6, shape);
  }
  return shape;
}

/// Gradients of pyramid5 are bilinear in r and s and the same along every line to the apex.
Eigen::VectorXd linear_pyramid_stress(const Vector3& xi) {
  const SquarePoint at(xi);
  return Eigen::Vector4d(1, at.r, at.s, at.r * at.s);
}

Eigen::VectorXd quadratic_pyramid_stress(const Vector3& xi) {
  const SquarePoint at(xi);
  return (Eigen::Matrix<double, 5, 1>() << 1, xi[0], xi[1], xi[2], at.u * at.r * at.s).finished();
}

/// Products of a line's rule in r and s with another one towards the apex; dV = u^2 dr ds du.
QuadratureRule pyramid_rule(const LineRule& across, const LineRule& upright) {
  QuadratureRule points;
  points.reserve(across.size() * across.size() * upright.size());
  for (const LinePoint& c : upright)
    for (const LinePoint& b : across)
      for (const LinePoint& a : across) {
        const double u = (1 - c.x) / 2;
        points.push_back({{u * a.x, u * b.x, 1 - u}, a.w * b.w * c.w / 2 * u * u});
      }
  return points;
}

Eigen::Matrix3Xd pyramid_corners() {
  Eigen::Matrix3Xd xi(3, 5);
  Eigen::Index a = 0;
  for (const auto& [x, y, z] : pyramid_signs) xi.col(a++) = Vector3(x, y, z);
  xi.col(4) = Vector3::UnitZ();
  return xi;
}

/// All edges of equal length.
Matrix3 ideal_pyramid() {
  Matrix3 edge = Matrix3::Identity();
  edge.col(2) = Vector3(0.5, 0.5, std::sqrt(0.5));
  return edge;
}

}  // namespace

std::vector<ElementKind> pyramids() {
  const std::vector<std::array<int, 4>> checked = {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}};
  // Exact for K of straight pyramids on a parallelogram: u^2 towards the apex for pyramid5, u^4 for pyramid13; m has
  // two powers of u more.
  const QuadratureRule eight = pyramid_rule(gauss_2(), gauss_2()), twenty_seven = pyramid_rule(gauss_3(), gauss_3()),
                       thirty_six = pyramid_rule(gauss_3(), gauss_4());
  return {
      {.type = ElementType::pyramid5,
       .name = "pyramid5",
       .nodes = 5,
       .corners = 5,
       .faces = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
       .files = {.abaqus = "C3D5", .nastran = "CPYRAM", .gmsh = 7, .vtk = 14},
       .shape = linear_pyramid,
       .natural_nodes = pyramid_corners(),
       .stiffness_points = eight,
       .reduced_points = eight,
       .mass_points = twenty_seven,
       .stress_terms = linear_pyramid_stress,
       .checked_corners = checked,
       .ideal_edges = ideal_pyramid()},
      {.type = ElementType::pyramid13,
       .name = "pyramid13",
       .nodes = 13,
       .corners = 5,
       .faces = {{0, 3, 2, 1, 8, 7, 6, 5},
                 {0, 1, 4, 5, 10, 9},
                 {1, 2, 4, 6, 11, 10},
                 {2, 3, 4, 7, 12, 11},
                 {3, 0, 4, 8, 9, 12}},
       .files = {.nastran = "CPYRAM", .gmsh = 19, .gmsh_order = {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}, .vtk = 27},
       .shape = quadratic_pyramid,
       .natural_nodes = with_middles(pyramid_corners(), pyramid_edges),
       .stiffness_points = twenty_seven,
       .reduced_points = twenty_seven,
       .mass_points = thirty_six,
       .stress_terms = quadratic_pyramid_stress,
       .checked_corners = checked,
       .ideal_edges = ideal_pyramid()}};
}

}  // namespace hersey::fem
