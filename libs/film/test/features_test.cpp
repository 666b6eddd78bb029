#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "film_cases.h"
#include "gap/feature_cover.h"
#include "relative.h"

// Holes and grooves: where their edges lie, how smoothly they travel, and published bearings with grooves.
namespace hersey::film {
namespace features_test {

constexpr double kSolved = 1e-9;  // the solver leaves 1e-10 of the largest throughput

// A film without wedge between an axial groove and the edges' pressure is a chain of flat channels: between two grooves
// the pressure is linear and the flow exactly that of the true distance, wherever the grooves' edges lie in their
// cells.
TEST_CASE("GrooveEdges_AreIndependentOfTheGrid") {
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {60, 3}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  const SurfaceFeature high{.name = "high", .phi = 0, .arc = 0.5, .length = m.L, .pressure = 3e6};
  for (const double arc : {0.30, 0.33, 0.37, 0.41}) {
    CAPTURE(arc);
    m.features = {high, {.name = "low", .phi = pi, .arc = arc, .length = m.L, .pressure = 1e6}};
    const SolvedFilm film = solve_cold(m, turning(m, 0, 0));
    REQUIRE(film.summary.solved());
    const double distance = m.R * (pi - 0.5 * (0.5 + arc));
    const double flow = 2 * m.c * m.c * m.c / (12 * m.lubricant.mu0) * m.L * 2e6 / distance;
    CHECK(film.observed.flow_features[0] == relative(flow).epsilon(kSolved));
    CHECK(film.observed.flow_features[1] == relative(-flow).epsilon(kSolved));
    CHECK(film.observed.mass_balance_error < kSolved);
  }
}

// Without a driving pressure there is no flow, and a residual of round-off needs another scale.
TEST_CASE("FilmAtRestBetweenClosedEdges_HasItsGroovesPressure") {
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {60, 5}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  m.features = {{.name = "groove", .phi = 1, .arc = 0.37, .length = 0.004, .pressure = 3e5}};
  for (const auto solver : {FilmSolver::newton, FilmSolver::multigrid, FilmSolver::sor}) {
    const SolvedFilm film = solve_cold(m, turning(m, 0.6, 0), {.solver = solver});
    CAPTURE(film.summary.message);
    REQUIRE(film.summary.solved());
    CHECK(film.fields.p.minCoeff() == relative(3e5).epsilon(1e-6));  // what sweeps leave
    CHECK(film.fields.p.maxCoeff() == relative(3e5).epsilon(1e-6));  // likewise
  }
}

// A cavitated film reaches a groove at p_s > p_cav, which fills it back to where the pressure has fallen: l = h^2
// p_s/[6 mu U (1 - theta)], a sixth of a cell here. The nodes lie beyond, so that theta h is unchanged there and P0 has
// no influence.
TEST_CASE("FilmBeforeAGroove_IsFilledAsFarAsItsPressureCan") {
  FilmModel m{.R = 0.05, .L = 0.04, .c = 100e-6, .grid = {60, 3}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  m.features = {{.name = "groove", .phi = 0, .arc = 0.1 * pi, .length = m.L, .pressure = 2e4}};
  const double phi_e = 230 * pi / 180;
  const Journal journal{.e = 0.6 * m.c * Eigen::Vector2d(std::cos(phi_e), std::sin(phi_e)), .omega_journal = 200};
  for (const double fill_speed : {200.0, 20000.0}) {
    CAPTURE(fill_speed);
    m.fill_speed = fill_speed;
    const SolvedFilm film = solve_cold(m, journal);
    REQUIRE(film.summary.solved());
    const auto at = [&](const Eigen::VectorXd& field, int i) { return field[m.grid.index(i, 1)]; };
    const double before = at(film.fields.theta, 55) * at(film.fields.h, 55), h = at(film.fields.h, 58);
    // The flow back over the rim, half a cell from the node, is what the node has beyond that: its strip, spread out.
    const double back = h * h * h * 2e4 / (12 * m.lubricant.mu0 * m.R * pi / 60), U = 0.5 * 200 * m.R;
    CHECK(at(film.fields.theta, 58) * h == relative(before + back / U).epsilon(0.01));  // the gap of rim and node
    CHECK(at(film.fields.theta, 58) < 0.8);
  }
}

// The same holds along the axis: from a groove all around to an edge the flow is that of the land between them, however
// small a part of the last cell it is. The edge's pressure is prescribed, so that no row contains the distance to the
// groove.
TEST_CASE("LandBeforeAnEdge_HasItsTrueLength") {
  for (const double p_edge : {0.0, 1e5}) {
    for (const double land : {0.4e-3, 1.1e-3, 2.4e-3, 2.5e-3, 3.9e-3}) {  // cells of 2.5 mm
      CAPTURE(p_edge);
      CAPTURE(land);
      FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {24, 9}};
      m.edge_left.pressure = m.edge_right.pressure = p_edge;
      m.features = {{.name = "groove", .arc = 2 * pi, .length = m.L - 2 * land, .pressure = 3e5}};
      const SolvedFilm film = solve_cold(m, Journal{});
      REQUIRE(film.summary.solved());
      const FilmObservables& observed = film.observed;
      const double drop = 3e5 - p_edge, side = m.c * m.c * m.c / (12 * m.lubricant.mu0) * 2 * pi * m.R * drop / land;
      CHECK(observed.flow_left == relative(side).epsilon(kSolved));
      CHECK(observed.flow_right == relative(side).epsilon(kSolved));
      CHECK(observed.flow_features[0] == relative(2 * side).epsilon(kSolved));
      CHECK(observed.mass_balance_error < kSolved);
      CHECK(observed.power_oil == relative(-2 * side * drop).epsilon(kSolved));
    }
  }
}

// The oil of overlapping grooves takes the shorter land, in either order in the file.
TEST_CASE("LandOfOverlappingGrooves_IsThatOfTheNearer") {
  const SurfaceFeature whole{.name = "whole", .arc = 2 * pi, .length = 0.02 - 2 * 2.1e-3, .pressure = 3e5};
  const SurfaceFeature near{.name = "near", .phi = 1, .arc = 2.3, .length = 0.02 - 2 * 0.7e-3, .pressure = 3e5};
  const SurfaceFeature between{.name = "between", .phi = 1.9, .arc = 2, .length = 0.02 - 2 * 1.2e-3, .pressure = 3e5};
  std::vector<SurfaceFeature> order{whole, near, between};
  const double alone = 0.9 + 1 - 0.5 * 2.3;  // of the third beyond the second [rad]
  const double by_land = 2.3 / 0.7e-3 + alone / 1.2e-3 + (2 * pi - 2.3 - alone) / 2.1e-3;
  for (int turned = 0; turned < 3; ++turned) {
    std::rotate(order.begin(), order.begin() + 1, order.end());
    FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {24, 9}};
    m.features = order;
    const SolvedFilm film = solve_cold(m, Journal{});
    REQUIRE(film.summary.solved());
    const double side = m.c * m.c * m.c / (12 * m.lubricant.mu0) * m.R * 3e5 * by_land;
    CHECK(film.observed.flow_left == relative(side).epsilon(kSolved));
    CHECK(film.observed.flow_right == relative(side).epsilon(kSolved));
    CHECK(film.observed.power_oil == relative(-2 * side * 3e5).epsilon(kSolved));
  }
}

// A short groove of a turning journal's shell, whose end lies between lines of the grid or on one: without its land the
// coarse grids would have 5 % too little.
TEST_CASE("SideFlowOfAGroove_DoesNotDependOnWhereLinesLie") {
  const auto side_flow = [](int n_phi, int n_z, FilmSolver solver = FilmSolver::newton) {
    FilmModel m{.R = 0.05, .L = 0.08, .c = 145e-6, .grid = {n_phi, n_z}};
    m.features = {{.name = "groove", .phi = 130 * pi / 180, .arc = 0.1 * pi, .length = 0.07, .pressure = 70e3}};
    m.lubricant.mu0 = 0.0277;
    const SolvedFilm film = solve_cold(m, {.e = {0.7 * m.c, 0}, .omega_journal = 209.4}, {.solver = solver});
    REQUIRE(film.summary.solved());
    CHECK(film.observed.mass_balance_error < kSolved);
    return film.observed.flow_left + film.observed.flow_right;
  };
  const double fine = side_flow(120, 65);
  // Half as many nodes around are off by 1 %, and the corners of the groove by as much.
  for (const int n_z : {9, 11, 13, 15, 17, 21}) CHECK(side_flow(60, n_z) == relative(fine).epsilon(0.02));
  CHECK(side_flow(60, 13, FilmSolver::sor) == relative(side_flow(60, 13)).epsilon(kSolved));
}

// All pressures have one scale, that of the cavity included, and a full film does not depend on the cavity's.
TEST_CASE("FedGroove_KeepsItsPressureAtAnyCavitationPressure") {
  for (const double p_cav : {-5e4, 0.0, 2e4}) {
    CAPTURE(p_cav);
    FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {24, 9}, .p_cav = p_cav};
    m.edge_left.pressure = m.edge_right.pressure = 1e5;
    m.features = {{.name = "groove", .phi = pi, .arc = 1, .length = 8e-3, .pressure = 3e5}};
    const SolvedFilm film = solve_cold(m, Journal{});
    REQUIRE(film.summary.solved());
    CHECK(film.fields.p[m.grid.index(12, 4)] == relative(3e5).epsilon(kSolved));
    CHECK(film.fields.p[m.grid.index(12, 0)] == relative(1e5).epsilon(kSolved));
    m.p_cav = 0;
    CHECK(film.observed.flow_supply == relative(solve_cold(m, Journal{}).observed.flow_supply).epsilon(kSolved));
  }
}

TEST_CASE("RowWeights_HaveTheirDerivative") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6};
  m.grid = graded_grid(40, 9, {{.position = 0.2, .reach = 0.5, .factor = 3}},
                       {{.position = 0.1, .reach = 0.2, .factor = 2}});
  const GridGeometry geometry(m);
  for (const FeatureShape& shape : std::vector<FeatureShape>{Rectangle{}, Ellipse{}}) {
    const SurfaceFeature feature{
        .name = "a", .shape = shape, .surface = Surface::journal, .phi = 6.2, .z = 1e-3, .arc = 0.5, .length = 8e-3};
    const double d = 1e-7;
    std::vector<CoveredNode> here, before, after;
    cover(m, geometry, feature, 0.123, here);
    cover(m, geometry, feature, 0.123 - d, before);
    cover(m, geometry, feature, 0.123 + d, after);
    REQUIRE(here.size() > 8);
    REQUIRE(here.size() == before.size());
    REQUIRE(here.size() == after.size());
    double largest = 0, largest_drawn = 0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      // Differences of step 1e-7: round-off over it.
      CHECK(std::abs(here[k].fraction_journal - (after[k].fraction - before[k].fraction) / (2 * d)) < 1e-6);
      CHECK(std::abs(here[k].draws_journal - (after[k].draws - before[k].draws) / (2 * d)) < 1e-6);  // likewise
      largest = std::max(largest, std::abs(here[k].fraction_journal));
      largest_drawn = std::max(largest_drawn, std::abs(here[k].draws_journal));
    }
    CHECK(largest > 0.5);
    CHECK(largest_drawn > 0.5);
  }
}

// Effect of the feature on the film as it travels: force and flow in 1000 steps over four cells.
struct Sweep {
  double largest = 0, jump = 0, bend = 0;  // of the force: size, largest first and second difference
};

Sweep sweep(FeatureShape shape, double pressure, double omega) {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 13}};
  m.features = {
      {.name = "hole", .shape = shape, .surface = Surface::journal, .arc = 0.35, .length = 7e-3, .pressure = pressure}};
  SurfaceMotion motion = surfaces(m, {.omega_journal = omega});
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  std::vector<Eigen::Vector2d> force;
  for (int step = 0; step < 500; ++step) {
    motion.phi_journal = 2 * 2 * pi / 60 * step / 500;
    REQUIRE(solve_film(reynolds, motion, {}, {}, u).solved());
    const Eigen::Rotation2Dd back(-motion.phi_journal);  // in the frame of the hole the force hardly changes
    force.emplace_back(back * reynolds.forces().wrench_on_shell.segment<2>(3));
  }
  Sweep s;
  for (std::size_t k = 0; k < force.size(); ++k) {
    s.largest = std::max(s.largest, force[k].norm());
    if (k > 0) s.jump = std::max(s.jump, (force[k] - force[k - 1]).norm());
    if (k > 1) s.bend = std::max(s.bend, (force[k] - 2 * force[k - 1] + force[k - 2]).norm());
  }
  return s;
}

TEST_CASE("HoleSweptOverAUniformFilm_GivesASmoothForce") {
  for (const FeatureShape& shape : std::vector<FeatureShape>{Rectangle{}, Ellipse{}}) {
    CAPTURE(shape.index());
    const Sweep s = sweep(shape, 5e5, 0);
    CAPTURE(s.jump / s.largest);
    CAPTURE(s.bend / s.largest);
    CHECK(s.largest > 50);
    // A hole that snapped to nodes would make the force jump by a third of itself; 250 steps cross a cell. A straight
    // edge passes a whole row of nodes at once, where the slope of the force may change, an ellipse one after the
    // other.
    CHECK(s.jump < 2e-3 * s.largest);
    CHECK(s.bend < (std::holds_alternative<Ellipse>(shape) ? 2e-4 : 1e-3) * s.largest);  // 250 steps to a cell
  }
}

// Where a line or a groove has the largest pressure of a film, no reported pressure exceeds it: a parabola through the
// nodes beside it would do so by an eighth, as the pressure falls off on both sides of a kink. Mirrored films have the
// same peak.
TEST_CASE("PeakBesideAPrescribedPressure_IsThatPressure") {
  const auto peak = [](int n_phi, double phi, bool is_line, double omega) {
    FilmModel m{.R = 0.025, .L = 0.025, .c = 50e-6, .grid = {n_phi, 13}};
    m.lubricant.mu0 = 0.01;
    if (is_line) {
      m.supply = {SupplyKind::fixed_angle, phi, 1.5e5};
    } else {
      m.features = {{.name = "groove", .phi = phi, .arc = 0.4, .length = 0.012, .pressure = 1.5e5}};
    }
    const Journal journal = turning(m, 0.5, omega);
    const SolvedFilm film = solve_cold(m, surfaces(m, journal, phi), journal.e);
    REQUIRE(film.summary.solved());
    return film.observed;
  };
  for (const bool is_line : {true, false}) {
    CAPTURE(is_line);
    for (const int n_phi : {60, 61, 240}) {
      CAPTURE(n_phi);
      for (const double degrees : {120.0, 121.5, 124.0, 151.0}) {
        CAPTURE(degrees);
        const double phi = degrees * pi / 180;
        const FilmObservables one = peak(n_phi, phi, is_line, 30), mirrored = peak(n_phi, -phi, is_line, -30);
        // The pressure is prescribed exactly: round-off.
        CHECK(one.p_max == doctest::Approx(1.5e5).epsilon(1e-12));
        CHECK(mirrored.p_max == doctest::Approx(one.p_max).epsilon(1e-12));
        if (is_line) CHECK(one.p_max_phi == doctest::Approx(phi).epsilon(1e-12));
      }
    }
  }
}

// At the step of a pocket the pressure has a kink as well: the node's own value is reported, not that of a parabola
// beyond.
TEST_CASE("PeakAtThePocketsStep_IsNotExtrapolated") {
  FilmModel m{.R = 0.025, .L = 0.025, .c = 50e-6, .grid = {60, 13}};
  m.lubricant.mu0 = 0.01;
  m.edge_left.pressure = m.edge_right.pressure = 1e6;
  m.features = {{.name = "pocket", .phi = 2, .arc = 0.63, .length = 0.015, .is_fed = false, .depth = 60e-6}};
  const FilmObservables o = solve_cold(m, turning(m, 0, 100)).observed;
  CHECK(o.p_max > 1.001e6);
  CHECK(o.p_max == o.p_max_node);
}

double sommerfeld(const FilmModel& m, double omega, double W) {
  return m.lubricant.mu0 * omega / (2 * pi) * std::pow(m.R / m.c, 2) * m.L * 2 * m.R / W;
}

// Two axial grooves of 20 degrees at +-90 degrees to the load, L/D = 0.5 (Lund and Thomsen 1978, table as read there).
TEST_CASE("LundThomsen_TwoAxialGrooves") {
  struct Row {
    double S, epsilon, attitude;
  };
  for (const Row& row : {Row{1.656, 0.244, 65.85}, Row{0.378, 0.570, 45.43}}) {
    CAPTURE(row.S);
    FilmModel m{.R = 0.025, .L = 0.025, .c = 25e-6, .grid = {144, 25}, .cavitation = Cavitation::reynolds};
    m.shear_force = ShearForce::torque_only;
    const double arc = pi / 9;
    m.features = {{.name = "left", .phi = 0.5 * pi, .arc = arc, .length = m.L},
                  {.name = "right", .phi = -0.5 * pi, .arc = arc, .length = m.L}};
    const double omega = 100;
    const auto force = [&](double attitude) {
      const Journal journal{.e = row.epsilon * m.c * Eigen::Vector2d(std::cos(attitude), std::sin(attitude)),
                            .omega_journal = omega};
      const SolvedFilm film = solve_cold(m, journal);
      REQUIRE(film.summary.solved());
      return Eigen::Vector2d(film.wrench.segment<2>(3));
    };
    // The load acts along x: the attitude at which the film answers along x, by bisection.
    double low = row.attitude * pi / 180 - 0.3, high = low + 0.6;
    REQUIRE(force(low).y() * force(high).y() < 0);
    const bool rises = force(high).y() > 0;
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (low + high);
      ((force(middle).y() > 0) == rises ? high : low) = middle;
    }
    CHECK(low * 180 / pi == doctest::Approx(row.attitude).epsilon(0.03));
    CHECK(sommerfeld(m, omega, force(low).x()) == doctest::Approx(row.S).epsilon(0.03));
  }
}

// u is 0 in such a groove, to round-off of either sign.
TEST_CASE("GroovesAtTheCavitationPressure_HaveOneSideFlow") {
  FilmModel m{.R = 0.0135795, .L = 0.03677, .c = 1.9027e-5, .grid = {60, 9}, .cavitation = Cavitation::reynolds};
  m.lubricant.mu0 = 0.010286;
  for (const double angle : {-177.9, 2.109})
    m.features.push_back({.phi = angle * pi / 180, .arc = 15 * pi / 180, .length = m.L});
  const Journal journal{.e = 0.50674 * m.c * Eigen::Vector2d(std::cos(-2.0787), std::sin(-2.0787)),
                        .omega_journal = 11.5073};
  std::vector<double> flows;
  for (const FilmSolver solver : {FilmSolver::newton, FilmSolver::multigrid, FilmSolver::sor}) {
    Reynolds reynolds(m, linear_solver_of(solver));
    Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
    REQUIRE(solve_film(reynolds, surfaces(m, journal), {}, {.solver = solver}, u).solved());
    const FilmObservables film = observe_film(m, surfaces(m, journal), {}, journal.e, u);
    flows.push_back(film.flow_left + film.flow_right);
  }
  // Each solver to its tolerance, 1e-10, which weak spots of the film amplify.
  CHECK(flows[1] == relative(flows[0]).epsilon(1e-6));
  CHECK(flows[2] == relative(flows[0]).epsilon(1e-6));
}

TEST_CASE("FeatureFlows_AddUp") {
  for (const auto solver : {FilmSolver::newton, FilmSolver::sor}) {
    FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 13}};
    m.features = {{.name = "hole", .shape = Ellipse{}, .phi = 4.5, .arc = 0.3, .length = 6e-3, .pressure = 3e5},
                  {.name = "groove", .phi = 0.4, .arc = 0.3, .length = 12e-3, .pressure = 1e5}};
    const SolvedFilm film = solve_cold(m, turning(m, 0.6, 300), {.solver = solver, .rtol = 1e-9});
    CAPTURE(film.summary.message);
    REQUIRE(film.summary.solved());
    // A sum: round-off.
    CHECK(film.observed.flow_features.sum() == relative(film.observed.flow_supply).epsilon(1e-12));
    CHECK(film.observed.mass_balance_error < 1e-7);  // SOR ends at 1e-9 per node
    CHECK(film.observed.flow_features[0] > 0);
    CHECK(film.observed.flow_features[1] > 0);
  }
}

}  // namespace features_test
}  // namespace hersey::film
