#pragma once

#include <vector>

#include "hersey/fem/quadrature.h"

namespace hersey::fem {

struct LinePoint {
  double x = 0, w = 0;
};
using LineRule = std::vector<LinePoint>;
using QuadratureRule = std::vector<QuadraturePoint>;

/// Gauss' rules on -1 <= x <= 1.
[[nodiscard]] const LineRule& gauss_2();
[[nodiscard]] const LineRule& gauss_3();
[[nodiscard]] const LineRule& gauss_4();

/// On triangles 0 <= xi, eta, sum <= 1, exact up to a degree.
[[nodiscard]] QuadratureRule triangle_degree_2();
[[nodiscard]] QuadratureRule triangle_degree_5();

/// Products of a line's rule with itself, and of a triangle's with a line's.
[[nodiscard]] QuadratureRule square_rule(const LineRule& line);
[[nodiscard]] QuadratureRule cube_rule(const LineRule& line);
[[nodiscard]] QuadratureRule wedge_rule(const QuadratureRule& triangle, const LineRule& line);

/// On tetrahedra 0 <= xi_k, sum <= 1.
[[nodiscard]] QuadratureRule tetrahedron_centre();
[[nodiscard]] QuadratureRule tetrahedron_degree_2();
[[nodiscard]] QuadratureRule tetrahedron_degree_5();

}  // namespace hersey::fem
