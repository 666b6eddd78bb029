#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "gap/grid_geometry.h"
#include "heat/heat_walls.h"
#include "hot_film.h"
#include "relative.h"

// Films with heat on planes and annuli: closed forms, the annulus as a slider, pads that conduct.
namespace hersey::film {
namespace flat_heat_test {

constexpr double T_in = 40 + zero_celsius;                 // K
constexpr double speed = 20, h_in = 60e-6, h_out = 30e-6;  // m/s, m

/// One pad, 40 mm along and 20 mm wide at its mean radius, whose film narrows from `h_in` to `h_out`.
struct Pad {
  FilmModel model;
  SurfaceMotion motion;
};

/// @param surface  a plane has the radius 1 m
/// @param sense  1, or -1: the mirror image
Pad pad(const FilmSurface& surface, double R, int lines, int rows, double sense = 1) {
  Pad p{.model = {.R = R, .L = 0.02, .c = h_out, .lubricant = thinning_oil()}, .motion = {}};
  FilmModel& m = p.model;
  m.surface = surface;
  const double half = 0.5 * 0.04 / R;
  m.grid = patch_grid({{.from = -half, .to = half, .lines = lines}}, rows);
  const Edge flooded{.ambient_fill = 1};
  m.edge_left = m.edge_right = flooded;
  m.ends = {{.first = flooded, .last = flooded}};
  p.motion = surfaces(m, {});
  for (int i = 0; i < lines; ++i) {
    const double along = 0.5 * (1 + sense * m.grid.phi(i) / half);
    p.motion.g.segment(m.grid.index(i, 0), rows).setConstant(h_in + (h_out - h_in) * along);
  }
  p.motion.u_journal = sense * speed;
  return p;
}

HotFilm solved(const Pad& p, const ThermalModel& thermal, double tolerance = 1e-7) {
  return solve_hot(p.model, thermal, p.motion, {0, 0}, tolerance);
}

/// Largest difference of two films' mean temperatures, node by node [K].
double apart(const HotFilm& a, const HotFilm& b) {
  return (a.temperatures.middle - b.temperatures.middle).cwiseAbs().maxCoeff();
}

TEST_CASE("AnnulusOfALargeRadius_IsASlider_Hot") {
  for (const int layers : {1, 5}) {
    CAPTURE(layers);
    const ThermalModel thermal = supplied_at_40(layers);
    const HotFilm slider = solved(pad(Plane{}, 1, 21, 9), thermal);
    CHECK(slider.heat.T_max > T_in + 10);
    const double near = apart(solved(pad(Annulus{}, 2, 21, 9), thermal), slider),
                 far = apart(solved(pad(Annulus{}, 8, 21, 9), thermal), slider);
    CHECK(far < 0.02 * (slider.heat.T_max - T_in));   // speeds at the edges differ by 0.01/8
    CHECK(near / far == relative(4.0).epsilon(0.1));  // of first order in the width over the radius
  }
}

// With one viscosity, no pressure and no heat through walls each radius warms its own oil (thermal.73): 2 mu omega r^2
// arc/(rho c h^2) at the end, whatever the distribution over the layers.
TEST_CASE("EvenFilmOnASector_WarmsWithTheSquareOfTheRadius") {
  Pad p = pad(Annulus{}, 0.05, 21, 21);
  FilmModel& m = p.model;
  m.lubricant.temperature_law = FixedViscosity{m.lubricant.mu0};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  p.motion.g.setConstant(h_out);
  ThermalModel thermal = supplied_at_40(1);
  thermal.journal = InsulatedWall{};
  const HotFilm hot = solved(p, thermal);
  const Lubricant& oil = m.lubricant;
  for (int j = 1; j + 1 < m.grid.n_z; ++j) {
    const double r = m.R + m.L * m.grid.z_over_L(j), arc = 0.04 / m.R;
    const double rise = 2 * oil.mu0 * (speed / m.R) * r * r * arc / (oil.density * oil.specific_heat * h_out * h_out);
    const double dz = m.L / (m.grid.n_z - 1);
    CHECK(hot.temperatures.middle[m.grid.index(20, j)] - T_in ==
          relative(rise).epsilon(std::pow(dz / m.R, 2)));  // heat of the half volumes along the edges
  }
}

TEST_CASE("HeatOfASector_IsInBalance") {
  for (const int layers : {1, 5}) {
    ThermalModel thermal = supplied_at_40(layers);
    thermal.shell = RingWall{.outer_radius = 0.05 + 0.01, .closes = false};
    const HotFilm hot = solved(pad(Annulus{}, 0.05, 21, 9), thermal, 1e-9);
    CHECK(std::abs(hot.heat.balance.error()) < 1e-9);                              // what iterations to 1e-9 K leave
    CHECK(hot.heat.balance.power == relative(hot.film.power_film).epsilon(1e-8));  // likewise
    CHECK(std::abs(hot.heat.balance.to_journal) < 1e-8 * hot.heat.balance.power);  // likewise: the runner is free
    CHECK(hot.heat.balance.to_shell > 1e-3 * hot.heat.balance.power);
  }
}

TEST_CASE("SectorInTheOtherSense_IsTheMirrorImage") {
  ThermalModel thermal = supplied_at_40(5);
  thermal.shell = RingWall{.outer_radius = 0.05 + 0.01, .closes = false};
  const Pad one = pad(Annulus{}, 0.05, 21, 9), other = pad(Annulus{}, 0.05, 21, 9, -1);
  const HotFilm hot = solved(one, thermal), mirrored = solved(other, thermal);
  const Grid& grid = one.model.grid;
  for (int i = 0; i < grid.n_phi; ++i)
    for (int j = 0; j < grid.n_z; ++j)
      CHECK(mirrored.temperatures.middle[grid.index(grid.n_phi - 1 - i, j)] ==
            relative(hot.temperatures.middle[grid.index(i, j)]).epsilon(1e-8));  // both to 1e-7 K
}

// A pad of a bore that becomes a plane as its radius grows: the walls of (thermal.12) are those of (thermal.72).
TEST_CASE("PadOfALargeBore_IsThePadOfASlider") {
  const auto with_pad = [](double R) {
    ThermalModel thermal = supplied_at_40(5);
    thermal.shell = RingWall{.outer_radius = R + 0.02, .conductivity = 20, .transfer = 300, .closes = false};
    return thermal;
  };
  const HotFilm slider = solved(pad(Plane{}, 1, 21, 9), with_pad(1));
  const auto bore = [&](double R) { return solved(pad(Cylinder{}, R, 21, 9), with_pad(R)); };
  const auto shells_apart = [&](const HotFilm& one) {
    return (one.state.shell - slider.state.shell).cwiseAbs().maxCoeff();
  };
  const double near = shells_apart(bore(1)), far = shells_apart(bore(4));
  CHECK(far < 0.02 * (slider.state.shell.maxCoeff() - T_in));  // thickness over radius: 0.005
  CHECK(near / far == relative(4.0).epsilon(0.1));             // of first order in it
}

// A pad that gives off no heat takes none in all, but leads it from where its film is hot to where oil comes in cold.
TEST_CASE("PadThatGivesOffNoHeat_PassesItOn") {
  ThermalModel thermal = supplied_at_40(5);
  thermal.shell = RingWall{.outer_radius = 0.05 + 0.01, .transfer = 0, .closes = false};
  const HotFilm passing = solved(pad(Annulus{}, 0.05, 21, 9), thermal, 1e-9);
  thermal.shell = InsulatedWall{};
  const HotFilm insulated = solved(pad(Annulus{}, 0.05, 21, 9), thermal, 1e-9);
  CHECK(std::abs(passing.heat.balance.to_shell) < 1e-8 * passing.heat.balance.power);  // of iterations to 1e-9 K
  CHECK(passing.heat.T_shell_max < insulated.heat.T_shell_max - 1);
}

// Of a sector of an annulus, whose inner side is shorter than its outer one (thermal.72).
TEST_CASE("WallOfASector_HasTheSizeOfItsPad") {
  const Pad p = pad(Annulus{}, 0.05, 21, 41);
  constexpr double t = 0.01, k = 50, alpha = 80, C = 3.6e6, arc = 0.04 / 0.05, inner = 0.04, outer = 0.06;
  const RingConductances wall = conductances(
      p.model, GridGeometry(p.model),
      {.outer_radius = 0.05 + t, .conductivity = k, .transfer = alpha, .heat_capacity = C, .closes = false});
  const auto sum = [](const std::vector<double>& lines) { return std::accumulate(lines.begin(), lines.end(), 0.0); };
  const double area = 0.5 * arc * (outer * outer - inner * inner);
  constexpr double round_off_of_sums = 1e-12;  // of 21 lines, and of a thickness that is a difference of radii
  CHECK(sum(wall.capacity) == relative(C * t * area).epsilon(round_off_of_sums));
  const double edges = arc * (inner + outer) + 2 * (outer - inner);
  CHECK(sum(wall.outside) == relative(area / (0.5 * t / k + 1 / alpha) + alpha * t * edges).epsilon(round_off_of_sums));
  CHECK(wall.around[3] * arc / 20 == relative(k * t * std::log(outer / inner)).epsilon(std::pow(0.0005 / inner, 2)));
  CHECK(wall.around[20] == 0);
}

// A washer is a pad that closes: around it heat is conducted across the first line as across any other.
TEST_CASE("WallOfAWasher_HasNoEnds") {
  FilmModel m{.R = 0.05, .L = 0.02, .c = h_out, .grid = {.n_phi = 24, .n_z = 7}, .lubricant = thinning_oil()};
  m.surface = Annulus{};
  m.edge_left = m.edge_right = {.pressure = 30e5};  // without cavities, in which oil would circle for ever
  SurfaceMotion motion = surfaces(m, {});
  for (int i = 0; i < m.grid.n_phi; ++i)  // leans towards line 5
    motion.g.segment(m.grid.index(i, 0), 7)
        .setConstant(h_in - (h_in - h_out) * std::cos(m.grid.phi(i) - m.grid.phi(5)));
  motion.u_journal = speed;
  ThermalModel thermal = supplied_at_40(3);
  thermal.shell = RingWall{.outer_radius = 0.06, .closes = false};
  const HotFilm hot = solve_hot(m, thermal, motion, {0, 0}, 1e-9);
  CHECK(std::abs(hot.heat.balance.error()) < 1e-9);  // what iterations to 1e-9 K leave
  for (int i = 0; i < m.grid.n_phi; ++i)
    motion.g.segment(m.grid.index(i, 0), 7)
        .setConstant(h_in - (h_in - h_out) * std::cos(m.grid.phi(i) - m.grid.phi(13)));
  const HotFilm turned = solve_hot(m, thermal, motion, {0, 0}, 1e-9);
  for (int i = 0; i < m.grid.n_phi; ++i)
    CHECK(turned.state.shell[(i + 8) % 24] == relative(hot.state.shell[i]).epsilon(1e-9));  // both to 1e-9 K
}

TEST_CASE("HottestOilOfASlider_ConvergesWithTheGrid") {
  const ThermalModel thermal = supplied_at_40(5);
  std::vector<double> hottest;
  for (const int cells : {16, 32, 64})
    hottest.push_back(solved(pad(Plane{}, 1, cells + 1, cells / 2 + 1), thermal).heat.T_max);
  const double order = std::log2((hottest[1] - hottest[0]) / (hottest[2] - hottest[1]));
  CAPTURE(order);
  CHECK(std::abs(order - 1) < 0.2);  // first order: oil of another temperature than the runner's comes in at the edge
}

}  // namespace flat_heat_test
}  // namespace hersey::film
