#include <doctest/doctest.h>

#include "film_over_time.h"
#include "thermal_reference.h"

// Films in which nothing varies along the axis and no heat passes walls: quadratures and closed forms.
namespace hersey::film {
namespace warm_strips_test {

using namespace thermal_reference;

// A bearing of infinite width: between closed edges, the line gives fresh oil.
TEST_CASE("LongBearings_AreThoseOfTheQuadrature") {
  struct Point {
    double epsilon, load, attitude, p_max, torque, T_out;
  };
  for (const Point& point : {Point{0.3, 1058946.34, 69.87687, 13004839, 71.35315, 78.361004},
                             Point{0.8, 1474339.95, 58.34853, 23010316, 50.79870, 123.318678}}) {
    CAPTURE(point.epsilon);
    Case c = cope("long", 0.1, point.epsilon, {});
    c.model.grid = {.n_phi = 240, .n_z = 3};
    c.model.edge_left.kind = c.model.edge_right.kind = EdgeKind::closed;
    c.thermal.carry_over = 0;
    const HotFilm hot = solve_hot(c.model, c.thermal, surfaces(c.model, c.journal), c.journal.e);
    CHECK(hot.film.force_pressure.norm() / c.model.L == relative(point.load).epsilon(c.bars.load));
    CHECK(std::abs(attitude_of(hot, c.journal.e) - point.attitude) < c.bars.attitude);
    CHECK(hot.film.p_max == relative(point.p_max).epsilon(c.bars.p_max));
    CHECK(std::abs(hot.film.torque_journal) / c.model.L == relative(point.torque).epsilon(c.bars.power));
    const auto T = [&](int back) { return hot.temperatures.middle[c.model.grid.index(240 - back, 1)] - zero_celsius; };
    CHECK(std::abs(2 * T(1) - T(2) - point.T_out) < c.bars.T);
  }
}

// A plane slider between two grooves that give fresh oil, h falling in a straight line from `inlet` to `outlet`.
TEST_CASE("AdiabaticSliders_AreThoseOfTheQuadrature") {
  struct Point {
    double inlet, outlet, U, load, p_max, T_out;
  };
  for (const Point& point : {Point{100e-6, 50e-6, 10, 159100.1, 2473615, 46.585286},
                             Point{60e-6, 50e-6, 20, 126184.54, 1885789, 56.159187}}) {
    CAPTURE(point.inlet);
    constexpr int n = 200, groove = 4, all = n + 2 * groove;
    const double dx = 0.1 / n;
    FilmModel model{.R = all * dx / (2 * pi), .L = 0.01, .c = 50e-6, .grid = {all, 3}, .lubricant = thinning_oil()};
    model.edge_left.kind = model.edge_right.kind = EdgeKind::closed;
    const double cell = 2 * pi / all, arc = groove * cell;
    // Temperatures are taken backwards from the node at the slider's start, and onwards from that at its end.
    model.features = {
        {.name = "inlet", .phi = -0.5 * (arc - 0.5 * cell), .arc = arc - 0.5 * cell, .length = 0.01, .depth = 5e-3},
        {.name = "outlet", .phi = n * cell + 0.5 * arc, .arc = arc, .length = 0.01, .depth = 5e-3}};
    SurfaceMotion motion = surfaces(model, {});
    motion.u_journal = point.U;
    for (int k = 0; k < all; ++k) {
      const int at = k <= n + 2 ? k : k == all - 1 ? -1 : n;
      motion.g.segment(model.grid.index(k, 0), 3).setConstant(point.inlet + (point.outlet - point.inlet) * at / n);
    }
    ThermalModel thermal = supplied_at_40(1);
    thermal.journal = InsulatedWall{};
    thermal.carry_over = 0;
    const HotFilm hot = solve_hot(model, thermal, motion, {0, 0});
    double load = 0;
    for (int k = 0; k <= n; ++k) load += hot.fields.p[model.grid.index(k, 1)] * dx;
    CHECK(load == relative(point.load).epsilon(0.01));
    CHECK(hot.film.p_max == relative(point.p_max).epsilon(0.01));
    const auto T = [&](int k) { return hot.temperatures.middle[model.grid.index(k, 1)] - zero_celsius; };
    CHECK(std::abs(2 * T(n - 1) - T(n - 2) - point.T_out) < 0.3);
  }
}

// A film of constant gap that starts cold: exp(beta (T - T0)) = 1 + beta mu0 U^2 t/(rho cp c^2) where the oil has been
// there from the start, and what a steady film has where it has come in since.
TEST_CASE("ConcentricFilmThatStartsUp_IsThatOfItsClosedForm") {
  FilmModel model{.R = 0.05, .L = 0.05, .c = 100e-6, .grid = {.n_phi = 120, .n_z = 3}, .lubricant = thinning_oil()};
  model.shear_force = ShearForce::torque_only;
  model.edge_left.kind = model.edge_right.kind = EdgeKind::closed;
  model.supply = {SupplyKind::fixed_angle, 0, 1e5};
  ThermalModel thermal = supplied_at_40(1);
  thermal.journal = InsulatedWall{};
  thermal.carry_over = 0;
  for (const int steps : {40, 80}) {
    FilmOverTime film(model, thermal, {.omega_journal = 314.1592653589793});
    for (int k = 0; k < steps; ++k) film.advance(0.02 / steps);
    const auto rise_at = [&](int deg) { return film.heat.fields().middle[model.grid.index(deg / 3, 1)] - T_supply; };
    CHECK(rise_at(270) == relative(7.03475121755828).epsilon(5e-3));  // of first order in the step
    CHECK(rise_at(90) == relative(3.72719900463871).epsilon(0.03));   // the grid's first order, as in a steady film
  }
}

}  // namespace warm_strips_test
}  // namespace hersey::film
