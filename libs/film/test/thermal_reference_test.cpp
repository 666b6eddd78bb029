#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "hot_film.h"
#include "relative.h"

// Films with temperatures against an independent program's numbers (finite volumes in three directions, extrapolated
// over its grids) and closed forms, each within the tolerance that comes with them.
namespace hersey::film {
namespace thermal_reference_test {

constexpr double T_supply = 40 + zero_celsius;

/// The oil of all cases: mu = 0.0277 exp(-0.034 (T - 40 degC)) Pa s.
Lubricant thinning_oil() {
  Lubricant oil{.mu0 = 0.0277, .density = 860};
  oil.temperature_law = ExponentialViscosity{.mu_ref = 0.0277, .T_ref = T_supply, .beta = 0.034};
  oil.specific_heat = 2000, oil.conductivity = 0.13;
  return oil;
}

double degrees(double radians) { return radians * 180 / pi; }

/// What the program says of a bearing [N, deg, Pa, degC, W, m^3/s]; unset: it says nothing, or its own grids differ.
struct Reference {
  double load = 0, attitude = 0, p_max = 0;
  double T_groove = 0, T_side = 0, power = 0, side_flow = 0;
};

/// By which both may differ: shares, K and degrees.
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

void compare(const Case& c) {
  CAPTURE(c.name);
  const HotFilm hot = solve_hot(c.model, c.thermal, surfaces(c.model, c.journal), c.journal.e);
  const Reference& ref = c.expected;
  const Eigen::Vector2d W = hot.film.force_pressure.head<2>(), e = c.journal.e;
  CHECK(W.norm() == relative(ref.load).epsilon(c.bars.load));
  const double attitude = degrees(std::atan2(W.x() * e.y() - W.y() * e.x(), W.dot(e)));
  CHECK(std::abs(std::abs(attitude) - ref.attitude) < c.bars.attitude);
  CHECK(hot.film.p_max == relative(ref.p_max).epsilon(c.bars.p_max));
  CHECK(std::abs(hot.heat.T_supplies[0] - zero_celsius - ref.T_groove) < c.bars.T_groove);
  CHECK(std::abs(hot.heat.T_side - zero_celsius - ref.T_side) < c.bars.T);
  CHECK(hot.heat.balance.power == relative(ref.power).epsilon(c.bars.power));
  CHECK(hot.film.flow_left + hot.film.flow_right == relative(ref.side_flow).epsilon(c.bars.side_flow));
  CHECK(hot.heat.balance.error() < 1e-8);  // the film's residual
  CHECK(hot.iterations <= 20);
}

/// One temperature per node between walls without heat, oil supplied in the widest gap.
Case cope(std::string name, double L, double epsilon, const Reference& expected) {
  Case c{.name = std::move(name), .expected = expected};
  c.model = {.R = 0.05, .L = L, .c = 50e-6, .grid = {.n_phi = 120, .n_z = 25}, .lubricant = thinning_oil()};
  c.model.shear_force = ShearForce::torque_only;
  c.model.supply = {SupplyKind::fixed_angle, 0, 0};
  c.thermal = {.layers = 1, .T_supply = T_supply, .T_edges = T_supply, .journal = InsulatedWall{}};
  c.journal = turning(c.model, epsilon, 314.1592653589793);
  return c;
}

TEST_CASE("CopesBearings_AreThoseOfAnIndependentProgram") {
  compare(cope("C1", 0.1, 0.6, {42828.3, 56.328, 9.73175e6, 57.4152, 64.1551, 1536.6, 3.69835e-5}));
  compare(cope("C2", 0.05, 0.3, {1890.35, 71.9236, 775725, 66.205, 71.0157, 590.432, 1.10677e-5}));
  compare(cope("C3", 0.05, 0.8, {24915.1, 41.5878, 1.57226e7, 49.3055, 57.8424, 905.815, 2.95144e-5}));
}

// A groove of 20 degrees over the whole width, 210 degrees after the narrowest gap, that gives fresh oil.
TEST_CASE("CopesBearingWithARenewedGroove_IsThatOfAnIndependentProgram") {
  Case c = cope("C4", 0.1, 0.8, {118882, 44.158, 3.10085e7, 40, 53.9242, 2007.78, 3.29034e-5});
  c.model.supply = {};
  c.model.grid = {.n_phi = 180, .n_z = 25};  // power is of first order at the rim
  c.model.features.push_back(
      {.name = "groove", .phi = pi / 6, .z = 0, .arc = pi / 9, .length = 0.1, .pressure = 0, .depth = 5e-3});
  c.thermal.carry_over = 0;
  compare(c);
}

/// A groove of 18 degrees and 70 mm under 70 kPa, epsilon 0.7 in the direction of 230 degrees.
Case grooved(std::string name, int layers, const Reference& expected) {
  Case c{.name = std::move(name), .expected = expected};
  c.model = {.R = 0.05, .L = 0.08, .c = 145e-6, .grid = {.n_phi = 60, .n_z = 13}, .lubricant = thinning_oil()};
  c.model.shear_force = ShearForce::torque_only;
  c.model.features.push_back(
      {.name = "groove", .phi = 0, .z = 0, .arc = 0.1 * pi, .length = 0.07, .pressure = 70e3, .depth = 5e-3});
  c.thermal = {.layers = layers, .T_supply = T_supply, .T_edges = T_supply};
  const double phi = 230 * pi / 180;
  c.journal = {.e = 0.7 * c.model.c * Eigen::Vector2d(std::cos(phi), std::sin(phi)),
               .omega_journal = 209.43951023931953};
  return c;
}

TEST_CASE("CopesBearingWithAShortGroove_IsThatOfAnIndependentProgram") {
  Case c = grooved("G1", 1, {7324.21, 44.9598, 2.6029e6, 41.9176, 43.3932, 563.984, 9.6634e-5});
  c.thermal.journal = InsulatedWall{};
  c.model.grid = {.n_phi = 180, .n_z = 33};  // of first order at the groove's rim, as the power shows
  c.bars.T_groove = 0.4;
  compare(c);
}

/// The same, infinitely wide: between closed edges, the line gives fresh oil.
TEST_CASE("LongBearings_AreThoseOfTheQuadrature") {
  struct Point {
    double epsilon, load, attitude, p_max, torque;
  };
  for (const Point& point :
       {Point{0.3, 1058946.34, 69.87687, 13004839, 71.35315}, Point{0.8, 1474339.95, 58.34853, 23010316, 50.79870}}) {
    CAPTURE(point.epsilon);
    Case c = cope("long", 0.1, point.epsilon, {});
    c.model.grid = {.n_phi = 240, .n_z = 3};
    c.model.edge_left.kind = c.model.edge_right.kind = EdgeKind::closed;
    c.thermal.carry_over = 0;
    const HotFilm hot = solve_hot(c.model, c.thermal, surfaces(c.model, c.journal), c.journal.e);
    const Eigen::Vector2d W = hot.film.force_pressure.head<2>(), e = c.journal.e;
    CHECK(W.norm() / c.model.L == relative(point.load).epsilon(0.01));
    CHECK(std::abs(degrees(std::atan2(std::abs(W.x() * e.y() - W.y() * e.x()), W.dot(e))) - point.attitude) < 0.3);
    CHECK(hot.film.p_max == relative(point.p_max).epsilon(0.01));
    CHECK(std::abs(hot.film.torque_journal) / c.model.L == relative(point.torque).epsilon(0.007));
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
    // From the node at the slider's start backwards, and from that at its end on.
    model.features = {
        {.name = "inlet", .phi = -0.5 * (arc - 0.5 * cell), .arc = arc - 0.5 * cell, .length = 0.01, .depth = 5e-3},
        {.name = "outlet", .phi = n * cell + 0.5 * arc, .arc = arc, .length = 0.01, .depth = 5e-3}};
    SurfaceMotion motion = surfaces(model, {});
    motion.u_journal = point.U;
    for (int k = 0; k < all; ++k) {
      const int at = k <= n + 2 ? k : k == all - 1 ? -1 : n;
      motion.g.segment(model.grid.index(k, 0), 3).setConstant(point.inlet + (point.outlet - point.inlet) * at / n);
    }
    ThermalModel thermal{.layers = 1, .T_supply = T_supply, .T_edges = T_supply, .journal = InsulatedWall{}};
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
  ThermalModel thermal{.layers = 1, .T_supply = T_supply, .T_edges = T_supply, .journal = InsulatedWall{}};
  thermal.carry_over = 0;
  const SurfaceMotion motion = surfaces(model, {.omega_journal = 314.1592653589793});
  for (const int steps : {40, 80}) {
    FilmHeat heat(model, thermal);
    Reynolds reynolds(model);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
    FilmHistory history;
    history.theta = Eigen::VectorXd::Ones(model.grid.size());
    history.dt = 0.02 / steps;
    for (int k = 0; k < steps; ++k) {
      history.viscosity = heat.viscosity();
      REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
      heat.advance(motion, history, u);
      history.theta = film_fields(model, motion, u).theta;
    }
    const auto rise_at = [&](int deg) { return heat.fields().middle[model.grid.index(deg / 3, 1)] - T_supply; };
    CHECK(rise_at(270) == relative(7.03475121755828).epsilon(5e-3));  // of first order in the step
    CHECK(rise_at(90) == relative(3.72719900463871).epsilon(0.03));   // the grid's first order, as in a steady film
  }
}

// The 360 degrees bearing with oil of one viscosity, L/D = 1 and 0.5: Sommerfeld number, attitude, friction, side flow.
TEST_CASE("BearingsOfOneViscosity_HaveTheTabledNumbers") {
  struct Point {
    double slenderness, epsilon, So, attitude, friction, side_flow;
  };
  for (const Point& point : {Point{1, 0.2, 0.2519158, 1.289056, 11.88824, 0.04000925},
                             Point{1, 0.8, 3.571973, 0.6322681, 1.41444, 0.1550622}}) {
    CAPTURE(point.epsilon);
    FilmModel model{.R = 0.05, .L = 0.1 * point.slenderness, .c = 50e-6, .grid = {.n_phi = 120, .n_z = 25}};
    model.lubricant.mu0 = 0.02;
    model.shear_force = ShearForce::torque_only;
    model.supply = {SupplyKind::fixed_angle, 0, 0};
    const double omega = 100, psi = 1e-3;
    const Journal journal = turning(model, point.epsilon, omega);
    const SolvedFilm film = solve_cold(model, surfaces(model, journal), journal.e);
    const Eigen::Vector2d W = film.observed.force_pressure.head<2>(), e = journal.e;
    CHECK(W.norm() * psi * psi / (2 * model.R * model.L * 0.02 * omega) == relative(point.So).epsilon(0.01));
    const double attitude = std::atan2(std::abs(W.x() * e.y() - W.y() * e.x()), W.dot(e));
    CHECK(degrees(std::abs(attitude - point.attitude)) < 0.3);
    const double friction = std::abs(film.observed.torque_journal) / (model.R * W.norm());
    CHECK(friction / psi == relative(point.friction).epsilon(0.007));
    const double side_flow = film.observed.flow_left + film.observed.flow_right;
    CHECK(side_flow / (1e-3 * psi * omega) == relative(point.side_flow).epsilon(0.02));
  }
}

// The bearing in a ring with an oil that thins by shear to half: few layers and nodes against many. Bounds as for the
// oil that does not.
TEST_CASE("ThinningFilmsInLayers_AreNearFinerOnes") {
  const auto solved = [](int layers, int n_phi, int n_z, double limit) {
    Case c = grooved("F3", layers, {});
    c.model.grid = {.n_phi = n_phi, .n_z = n_z};
    c.model.lubricant.shear_thinning = {Cross{.limit = limit, .exponent = 0.8}, 1e5, 0};
    c.thermal.shell = RingWall{.outer_radius = 0.1, .conductivity = 50, .transfer = 80, .T_ambient = T_supply};
    return solve_hot(c.model, c.thermal, surfaces(c.model, c.journal), c.journal.e, 1e-5);
  };
  const HotFilm few = solved(5, 60, 13, 0.5), many = solved(12, 96, 19, 0.5), plain = solved(5, 60, 13, 0.999999);
  CHECK(few.film.force_pressure.norm() == relative(many.film.force_pressure.norm()).epsilon(0.015));
  CHECK(std::abs(few.heat.T_shell_max - many.heat.T_shell_max) < 0.3);
  CHECK(few.heat.balance.power == relative(many.heat.balance.power).epsilon(0.01));
  CHECK(few.film.force_pressure.norm() < 0.85 * plain.film.force_pressure.norm());
  CHECK(few.heat.T_shell_max < plain.heat.T_shell_max - 1);
  // An oil that hardly thins is that of case F3.
  CHECK(plain.film.force_pressure.norm() == relative(6775.11).epsilon(0.01));
}

// Between cold walls a constant distance apart, far from where oil comes in, all that the film dissipates leaves
// through them. Na = beta mu0 U^2/k.
TEST_CASE("CouetteFlowThatWarms_IsThatOfItsClosedForm") {
  struct Point {
    double Na, mean;  // mean: beta (T - T_wall)
  };
  for (const Point& point :
       {Point{0.1, 0.008278252719397309}, Point{1, 0.0782154908508543}, Point{10, 0.5266186142129314}}) {
    CAPTURE(point.Na);
    std::vector<double> errors;
    for (const int layers : {5, 10, 20}) {
      FilmModel model{.R = 0.05, .L = 0.05, .c = 100e-6, .grid = {.n_phi = 12, .n_z = 3}, .lubricant = thinning_oil()};
      model.edge_left.kind = model.edge_right.kind = EdgeKind::closed;
      model.supply = {SupplyKind::fixed_angle, 0, 1e5};
      model.lubricant.specific_heat = 2;  // it has its profile at once
      ThermalModel thermal{.layers = layers, .T_supply = T_supply, .T_edges = T_supply};
      thermal.shell = WallAtTemperature{.T = T_supply};
      thermal.journal = WallAtTemperature{.T = T_supply};
      const Journal journal{.omega_journal = std::sqrt(point.Na * 0.13 / (0.034 * 0.0277)) / model.R};
      const HotFilm hot = solve_hot(model, thermal, surfaces(model, journal), journal.e, 1e-6);
      errors.push_back(0.034 * (hot.temperatures.middle[model.grid.index(6, 1)] - T_supply) / point.mean - 1);
    }
    CHECK(std::abs(errors[0]) < 0.022);  // what the program itself leaves in ten layers: 2.1 %
    CHECK(std::abs(errors[2]) < 2e-3);   // and a little more than in forty: 0.13 %
    CHECK(std::log2(std::abs(errors[1] / errors[2])) == doctest::Approx(2).epsilon(0.1));  // of second order
  }
}

}  // namespace thermal_reference_test
}  // namespace hersey::film
