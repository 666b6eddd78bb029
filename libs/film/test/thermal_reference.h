#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>

#include "hot_film.h"
#include "relative.h"
#include "source_dir.h"

// Films with temperatures of an independent program (finite volumes, extrapolated over its grids), each with the
// tolerances that come with it.
namespace hersey::film::thermal_reference {

inline constexpr double T_supply = 40 + zero_celsius;

inline double degrees(double radians) { return radians * 180 / pi; }

/// Results of the program for a bearing [N, deg, Pa, degC, W, m^3/s].
struct Reference {
  double load = 0, attitude = 0, p_max = 0;
  double T_groove = 0, T_side = 0, power = 0, side_flow = 0;
};

/// Allowed differences of both: fractions, K and degrees.
struct Bars {
  double load = 0.01, attitude = 0.3, p_max = 0.01, T = 0.3, T_groove = 0.3, power = 0.007, side_flow = 0.02;
};

struct Case {
  std::string name;
  FilmModel model;
  ThermalModel thermal;
  Journal journal;
  Reference expected;
  Bars bars = {};
};

/// Angle from the load to the eccentricity, for either sense of rotation [deg].
inline double attitude_of(const HotFilm& hot, const Eigen::Vector2d& e) {
  const Eigen::Vector2d W = hot.film.force_pressure.head<2>();
  return degrees(std::atan2(std::abs(W.x() * e.y() - W.y() * e.x()), W.dot(e)));
}

inline HotFilm compare(const Case& c) {
  CAPTURE(c.name);
  HotFilm hot = solve_hot(c.model, c.thermal, surfaces(c.model, c.journal), c.journal.e);
  const Reference& ref = c.expected;
  // A row of docs/validation.md.
  MESSAGE(c.name, ", ", c.model.grid.n_phi, " x ", c.model.grid.n_z, ": load ",
          100 * (hot.film.force_pressure.norm() / ref.load - 1), " %, T_groove ",
          hot.heat.T_supplies[0] - zero_celsius - ref.T_groove, " K, T_side ",
          hot.heat.T_side - zero_celsius - ref.T_side, " K, power ", 100 * (hot.heat.balance.power / ref.power - 1),
          " %, side flow ", 100 * ((hot.film.flow_left + hot.film.flow_right) / ref.side_flow - 1), " %");
  CHECK(hot.film.force_pressure.norm() == relative(ref.load).epsilon(c.bars.load));
  CHECK(std::abs(attitude_of(hot, c.journal.e) - ref.attitude) < c.bars.attitude);
  CHECK(hot.film.p_max == relative(ref.p_max).epsilon(c.bars.p_max));
  CHECK(std::abs(hot.heat.T_supplies[0] - zero_celsius - ref.T_groove) < c.bars.T_groove);
  CHECK(std::abs(hot.heat.T_side - zero_celsius - ref.T_side) < c.bars.T);
  CHECK(hot.heat.balance.power == relative(ref.power).epsilon(c.bars.power));
  CHECK(hot.film.flow_left + hot.film.flow_right == relative(ref.side_flow).epsilon(c.bars.side_flow));
  CHECK(hot.heat.balance.error() < 1e-8);  // the film's residual
  CHECK(hot.iterations <= 20);
  return hot;
}

/// A table of verification/data.
inline std::vector<CsvRow> table(const std::string& name) {
  return read_csv(std::string(hersey::source_dir()) + "/verification/data/" + name);
}

/// Interpolates between two nodes at mid-width, `phi` [rad] of the grid.
inline double at_mid_width(const Grid& grid, const Eigen::VectorXd& field, double phi) {
  const double position = grid.n_phi * (phi / (2 * pi) - std::floor(phi / (2 * pi)));
  const int i = static_cast<int>(position) % grid.n_phi, j = grid.n_z / 2;
  const double fraction = position - std::floor(position);
  return (1 - fraction) * field[grid.index(i, j)] + fraction * field[grid.index((i + 1) % grid.n_phi, j)];
}

/// One temperature per node between walls without heat, oil supplied in the widest gap.
inline Case cope(std::string name, double L, double epsilon, const Reference& expected) {
  Case c{.name = std::move(name), .expected = expected};
  c.model = {.R = 0.05, .L = L, .c = 50e-6, .grid = {.n_phi = 120, .n_z = 25}, .lubricant = thinning_oil()};
  c.model.shear_force = ShearForce::torque_only;
  c.model.supply = {SupplyKind::fixed_angle, 0, 0};
  c.thermal = supplied_at_40(1);
  c.thermal.journal = InsulatedWall{};
  c.journal = turning(c.model, epsilon, 314.1592653589793);
  return c;
}

/// A groove of 18 degrees and 70 mm under 70 kPa, epsilon 0.7 in the direction of 230 degrees. With a depth, over which
/// next to nothing rubs: the program counts no friction there.
inline Case grooved(std::string name, int layers, const Reference& expected) {
  Case c{.name = std::move(name), .expected = expected};
  c.model = {.R = 0.05, .L = 0.08, .c = 145e-6, .grid = {.n_phi = 60, .n_z = 13}, .lubricant = thinning_oil()};
  c.model.shear_force = ShearForce::torque_only;
  c.model.features.push_back(
      {.name = "groove", .phi = 0, .z = 0, .arc = 0.1 * pi, .length = 0.07, .pressure = 70e3, .depth = 5e-3});
  c.thermal = supplied_at_40(layers);
  const double phi = 230 * pi / 180;
  c.journal = {.e = 0.7 * c.model.c * Eigen::Vector2d(std::cos(phi), std::sin(phi)),
               .omega_journal = 209.43951023931953};
  return c;
}

}  // namespace hersey::film::thermal_reference
