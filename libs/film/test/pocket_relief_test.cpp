#include "gap/pocket_relief.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "balance/flow_balance.h"
#include "film_cases.h"
#include "gap/gap_interpolation.h"
#include "gap/thinnest_film.h"
#include "relative.h"

// Depth of features: volume, flow over their steps, and what the film beside them feels.
namespace hersey::film {
namespace pocket_relief_test {

constexpr double kSolved = 1e-9;  // the solver leaves 1e-10 of the largest throughput

FilmModel graded() {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6};
  m.grid = graded_grid(40, 9, {{.position = 0.2, .reach = 0.5, .factor = 3}},
                       {{.position = 0.5, .reach = 0.2, .factor = 2}});
  return m;
}

SurfaceFeature pocket(FeatureShape shape, Surface surface) {
  return {.name = "pocket",
          .shape = shape,
          .surface = surface,
          .phi = 1,
          .z = 1e-3,
          .arc = 0.7,
          .length = 6e-3,
          .is_fed = false,
          .depth = 50e-6};
}

const std::array<FeatureShape, 2> shapes{Rectangle{}, Ellipse{}};

// A pocket that travels over the grid keeps its volume, whichever cells its borders cut.
TEST_CASE("RotatingPocket_KeepsItsVolume") {
  FilmModel m = graded();
  const GridGeometry geometry(m);
  for (const FeatureShape& shape : shapes) {
    m.features = {pocket(shape, Surface::journal)};
    const double fraction = std::holds_alternative<Ellipse>(shape) ? pi / 4 : 1;
    for (const double turned : {0.0, 0.013, 1.0, 2.5, 5.0, -3.0}) {
      const Eigen::VectorXd depth = mean_depth(m, turned);
      double volume = 0;
      for (int k = 0; k < depth.size(); ++k) volume += depth[k] * geometry.area(k / 9, k % 9);
      // Gauss' rule across the ellipse's ends leaves some thousandths.
      CHECK(volume == relative(fraction * 0.7 * m.R * 6e-3 * 50e-6).epsilon(fraction == 1 ? 1e-12 : 1e-2));
      CHECK(depth.maxCoeff() == relative(50e-6));
    }
  }
}

// A pocket that reaches the bearing's edge has its depth there.
TEST_CASE("PocketToTheEdge_IsDeepThere") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {40, 9}};
  m.features = {{.name = "slot", .phi = pi, .arc = 1, .length = 0.02, .is_fed = false, .depth = 1e-4}};
  for (int j = 0; j < 9; ++j) CHECK(mean_depth(m, 0)[m.grid.index(20, j)] == relative(1e-4));
  m.features[0].arc = 2 * pi, m.features[0].length = 5e-3, m.features[0].z = 7.5e-3;
  const Eigen::VectorXd all_around = mean_depth(m, 0);
  for (int i = 0; i < 40; ++i) CHECK(all_around[m.grid.index(i, 8)] == relative(1e-4));
}

// A full film at rest, concentric, and a journal with a pocket: the pocket's own volume rotates with it and takes no
// oil. The only flow is that around, at every step.
TEST_CASE("RotatingPocket_CarriesItsOilAlong") {
  FilmModel m = graded();
  m.edge_left.pressure = m.edge_right.pressure = 1e5;
  for (const FeatureShape& shape : shapes) {
    CAPTURE(shape.index());
    m.features = {pocket(shape, Surface::journal)};
    SurfaceMotion motion = surfaces(m, {.omega_shell = 200, .omega_journal = 200});
    motion.phi_journal = 2.9;
    FlowBalance balance(m);
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(m.grid.size(), 1e5),
                          ones = Eigen::VectorXd::Ones(m.grid.size());
    for (const double turned : {1e-3, 0.05, 0.4, 1.5}) {  // from within a cell to twice the pocket
      CAPTURE(turned);
      FilmHistory history{turned / 200, ones, 0 * ones};
      history.phi_journal = motion.phi_journal - turned;
      balance.evaluate(motion, history, u);
      const double scale = 50e-6 * 6 * 6e-3;                           // depth times speed times length
      CHECK(balance.balance().cwiseAbs().maxCoeff() < 1e-12 * scale);  // round-off
    }
  }
}

// A groove along all of the journal overtakes its oil: the oil that reaches its end fills the growing groove and the
// film ahead of it. In the middle of the groove the shell keeps it full and bounds the pressure. At every position of
// the end within a cell the film ahead is filled to U (h + d)/(U h + u_J d).
TEST_CASE("FilmAheadOfARotatingGroove_DoesNotDependOnGridLines") {
  FilmModel m{.R = 0.05, .L = 0.05, .c = 40e-6, .grid = {72, 5}};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  SurfaceFeature groove = pocket(Rectangle{}, Surface::journal), feed = pocket(Rectangle{}, Surface::shell);
  groove.z = feed.z = 0, groove.length = feed.length = m.L;
  groove.arc = 1.5, groove.depth = 300e-6;
  feed.phi = 1.3, feed.arc = 0.3, feed.depth = 0, feed.is_fed = true;
  for (int k = 0; k < 10; ++k) {
    groove.phi = 2 * pi / 72 * (24.01 + k / 10.0) - 0.75;
    m.features = {groove, feed};
    const SolvedFilm film = solve_cold(m, turning(m, 0, 100));
    REQUIRE(film.summary.solved());
    // In a flow tube that contains the end I_2/I_3 is up to 1 % more than h (film.26), and so is the flow.
    CHECK(film.fields.theta[m.grid.index(30, 2)] == doctest::Approx(340.0 / 640).epsilon(0.01));
  }
}

// Side flow of a bearing with an axial groove at given pressure: its depth is no business of the land beside it.
TEST_CASE("FedGrooveWithDepth_DoesNotLeakOntoTheLand") {
  for (const auto surface : {Surface::shell, Surface::journal}) {
    CAPTURE(static_cast<int>(surface));
    std::array<double, 3> flow{};
    for (int k = 0; k < 3; ++k) {
      FilmModel m{.R = 0.05, .L = 0.06, .c = 75e-6, .grid = {k == 2 ? 120 : 60, k == 2 ? 25 : 13}};
      m.lubricant.mu0 = 0.03;
      m.features = {{.name = "groove",
                     .surface = surface,
                     .phi = 1.3,
                     .arc = 0.35,
                     .length = 0.04,
                     .pressure = 2e5,
                     .depth = k == 1 ? 2e-3 : 0.0}};
      const SolvedFilm film = solve_cold(m, turning(m, 0.6, 300));
      REQUIRE(film.summary.solved());
      flow[static_cast<std::size_t>(k)] = film.observed.flow_left + film.observed.flow_right;
    }
    // The film is the same but for quantities that no equation contains: round-off.
    CHECK(flow[1] == doctest::Approx(flow[0]).epsilon(1e-12));
    CHECK(flow[2] == relative(flow[0]).epsilon(0.05));
  }
}

// A hydrostatic channel: pressure drives oil through lands and a pocket between, of any shape; nothing moves. Its flow
// converges with the grid wherever the borders lie.
TEST_CASE("FlowThroughPockets_ConvergesWithTheGrid") {
  for (const FeatureShape& shape : shapes) {
    CAPTURE(shape.index());
    for (const double depth : {20e-6, 1e-3}) {
      CAPTURE(depth);
      std::array<double, 3> flow{};
      for (int k = 0; k < 3; ++k) {
        const int n = 1 << k;
        FilmModel m{.R = 0.03, .L = 0.03, .c = 30e-6, .grid = {61 * n, 12 * n + 1}};
        m.edge_left.pressure = 2e6, m.edge_right.pressure = 1e6;
        m.features = {pocket(shape, Surface::shell)};
        m.features[0].length = 0.017, m.features[0].arc = 1.1, m.features[0].depth = depth;
        const SolvedFilm film = solve_cold(m, turning(m, 0.3, 0));
        REQUIRE(film.summary.solved());
        flow[static_cast<std::size_t>(k)] = film.observed.flow_right;
        CHECK(film.observed.mass_balance_error < kSolved);
      }
      CAPTURE(flow[0]);
      CAPTURE(flow[1]);
      CAPTURE(flow[2]);
      CHECK(std::abs(flow[1] / flow[2] - 1) < 0.01);
      CHECK(std::abs(flow[0] / flow[2] - 1) < 0.03);
    }
  }
}

// The film's smallest thickness is that of the land: the bearing's own where the narrowest gap lies beside the pocket,
// and the one at the pocket's border where it would lie within.
TEST_CASE("SmallestFilm_IsThatOfTheLand") {
  for (const auto surface : {Surface::shell, Surface::journal}) {
    for (const int n_phi : {60, 61, 120}) {
      FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {n_phi, 13}};
      m.edge_left.pressure = m.edge_right.pressure = 1e6;
      const Journal journal = turning(m, 0.5, 100);  // narrowest at phi = pi: 15 um
      m.features = {
          {.name = "pocket", .surface = surface, .phi = 1, .arc = 0.5, .length = 8e-3, .is_fed = false, .depth = 1e-4}};
      // Nodes are 6 degrees apart: a parabola's error.
      CHECK(solve_cold(m, journal).observed.h_min == relative(15e-6).epsilon(1e-4));
      m.features[0].phi = pi + 0.1, m.features[0].length = 0.02;
      const FilmObservables o = solve_cold(m, journal).observed;
      // The nearer border lies 0.15 rad from the narrowest gap.
      CHECK(o.h_min == relative(30e-6 - 15e-6 * std::cos(0.15)).epsilon(0.003));
      CHECK(o.h_min_phi == doctest::Approx(pi - 0.15).epsilon(1e-3));  // nodes are 0.05 rad and more apart
      CHECK(o.h_min_features == relative(115e-6).epsilon(1e-2));       // at a node near the narrowest gap
    }
  }
}

TEST_CASE("SmallestFilmInTheMiddle_IsThatOfItsOwnRow") {
  // A groove all around ends just before the middle, whose row round-off puts on either side of z = 0.
  for (const double off : {-1e-17, 0.0, 1e-17}) {
    CAPTURE(off);
    FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 5}};
    m.grid.heights = {-0.5, -0.25, off, 0.25, 0.5};
    m.edge_left.pressure = m.edge_right.pressure = 1e6;
    m.features = {
        {.name = "groove", .phi = 0, .z = -4e-3, .arc = 2 * pi, .length = 6e-3, .pressure = 1e6, .depth = 1e-4}};
    // Nodes are 6 degrees apart: a parabola's error.
    CHECK(solve_cold(m, turning(m, 0.5, 100)).observed.h_min_centre == doctest::Approx(15e-6).epsilon(1e-4));
  }
}

TEST_CASE("SmallestFilm_OfAGrooveOverAllOfTheBearing_IsThatOfTheGroove") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 5}};
  m.features = {{.name = "groove", .arc = 2 * pi, .length = 0.02, .pressure = 1e6, .depth = 1e-4}};
  for (const double phi : {pi, 0.0}) {
    const FilmObservables o = solve_cold(m, {.e = {15e-6 * std::cos(phi), 0}, .omega_journal = 100}).observed;
    CHECK(o.h_min == doctest::Approx(115e-6));
    CHECK(std::abs(o.h_min_phi) == doctest::Approx(phi));
    CHECK(o.h_min_features == o.h_min);
  }
}

TEST_CASE("PositionOfTheSmallestFilm_IsReportedWithinARevolution") {
  const FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 5}, .cavitation = Cavitation::guembel};
  for (const double phi : {2 * pi - 0.03, 0.03, 2.0, 5.0}) {
    CAPTURE(phi);
    const Journal journal{.e = {15e-6 * std::cos(phi), 15e-6 * std::sin(phi)}, .omega_journal = 100};
    // Nodes are 6 degrees apart: a parabola's error.
    CHECK(solve_cold(m, journal).observed.h_min_phi == doctest::Approx(phi).epsilon(1e-3));
  }
}

// Beside a groove there are nodes for one parabola only, and its minimum may be negative.
TEST_CASE("SmallestFilmBesideAGroove_IsNotNegative") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 5}};
  m.features = {{.name = "groove", .phi = 0.4 * pi, .arc = 0.05, .length = 0.02, .pressure = 1e6, .depth = 1e-4}};
  Eigen::VectorXd h = Eigen::VectorXd::Constant(m.grid.size(), 1e-4);
  h.segment(m.grid.index(9, 0), 5).setConstant(1e-3);
  h.segment(m.grid.index(10, 0), 5).setConstant(1e-5);
  h.segment(m.grid.index(11, 0), 5).setConstant(1.1e-5);  // the groove covers the next line
  const Thinnest found = thinnest_film(m, GridGeometry(m), h, 0);
  CHECK(found.value == 1e-5);
  CHECK(found.in_the_middle == 1e-5);
}

// Rate and wedge of a gap that travels around the bearing are the same oil: exactly, on any grid.
TEST_CASE("TravellingGap_ConservesItsOil") {
  for (const Grid& grid : {Grid{12, 5}, Grid{60, 5}, graded().grid}) {
    FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = grid};
    const double omega = 100;
    const Eigen::Vector2d e(9e-6, -14e-6);
    // In the frame of the ground both surfaces rotate at omega and the centre with them.
    const Journal journal{
        .e = e, .e_rate = omega * Eigen::Vector2d(-e.y(), e.x()), .omega_shell = omega, .omega_journal = omega};
    FlowBalance balance(m);
    balance.evaluate(surfaces(m, journal), {}, Eigen::VectorXd::Zero(grid.size()));
    CHECK(balance.balance().cwiseAbs().maxCoeff() <
          1e-13 * omega * m.R * m.c * m.L);  // round-off of the terms of a row
  }
}

// Newton, multigrid and the sweeps of SOR have the same pockets, full and cavitated.
TEST_CASE("AllSolvers_AgreeOnPockets") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 13}};
  m.features = {pocket(Rectangle{}, Surface::shell), pocket(Ellipse{}, Surface::journal)};
  m.features[0].phi = 3.6, m.features[1].phi = 2.2;
  m.supply = {SupplyKind::fixed_angle, 0.3, 1e5};
  const Journal journal = turning(m, 0.5, 300);
  SurfaceMotion motion = surfaces(m, journal, 0.3);
  const SolvedFilm newton = solve_cold(m, motion, journal.e);
  REQUIRE(newton.summary.solved());
  CHECK(newton.fields.theta.minCoeff() < 0.5);
  CHECK(newton.fields.theta.minCoeff() >= 0);
  CHECK(newton.observed.mass_balance_error < 1e-8);  // the solver's tolerance is 1e-10 per node
  for (const auto solver : {FilmSolver::sor, FilmSolver::multigrid}) {
    const SolvedFilm other = solve_cold(m, motion, journal.e, {.solver = solver});
    REQUIRE(other.summary.solved());
    // rtol 1e-10, amplified by weak spots of the film.
    CHECK((other.wrench - newton.wrench).norm() < 1e-6 * newton.wrench.norm());
    // The same holds for fill fractions, which only flow determines.
    CHECK((other.fields.theta - newton.fields.theta).cwiseAbs().maxCoeff() < 1e-5);
  }
}

// A line may lie between two nodes: a grid of twice as many nodes, one of which lies on it, gives the same result to
// within the coarse grid's own error, which is that of a line on one of its nodes.
TEST_CASE("SupplyLineBetweenNodes_IsOfSecondOrder") {
  const auto solve = [](int n_phi, double line, double pressure) {
    FilmModel m{.R = 0.05, .L = 0.05, .c = 50e-6, .grid = {n_phi, 25}};
    m.lubricant.mu0 = 0.01;
    m.supply = {SupplyKind::fixed_angle, line, pressure};
    Journal journal = turning(m, 0.6, 100);  // widest at phi = 0
    const SolvedFilm film = solve_cold(m, surfaces(m, journal, line), journal.e);
    REQUIRE(film.summary.solved());
    CHECK(film.observed.mass_balance_error < kSolved);
    return film.observed;
  };
  for (const double pressure : {0.0, 3e5}) {
    CAPTURE(pressure);
    for (const double fraction : {0.25, 0.5, 0.75}) {
      CAPTURE(fraction);
      const double line = 2 * pi / 120 * (3 + fraction);
      const FilmObservables between = solve(120, line, pressure), on_node = solve(480, line, pressure);
      CHECK(between.wrench_on_shell.segment<2>(3).norm() ==
            doctest::Approx(on_node.wrench_on_shell.segment<2>(3).norm()).epsilon(0.003));
      // At the ends of a line whose pressure differs from the edges' the flow grows with the number of nodes.
      if (pressure > 0) continue;
      CHECK(between.flow_left + between.flow_right == relative(on_node.flow_left + on_node.flow_right).epsilon(0.003));
    }
  }
}

// A line across a groove fills the groove's depth as well, wherever between two nodes it lies: to within the coarse
// grid's own error, as above.
TEST_CASE("SupplyLineOverAGroove_FillsItsDepth") {
  const auto load = [](int n_phi, double line, Surface surface) {
    FilmModel m{.R = 0.05, .L = 0.05, .c = 50e-6, .grid = {n_phi, 17}};
    m.lubricant.mu0 = 0.01;
    m.supply = {SupplyKind::fixed_angle, line, 0};
    m.features = {
        {.name = "groove", .surface = surface, .arc = 2 * pi, .length = 0.0125, .is_fed = false, .depth = 100e-6}};
    Journal journal = turning(m, 0.6, 100);  // widest at phi = 0
    const SolvedFilm film = solve_cold(m, surfaces(m, journal, line), journal.e);
    REQUIRE(film.summary.solved());
    CHECK(film.observed.mass_balance_error < kSolved);
    return film.observed.wrench_on_shell.segment<2>(3).norm();
  };
  for (const Surface surface : {Surface::shell, Surface::journal}) {
    for (const double fraction : {0.25, 0.5, 0.75}) {
      CAPTURE(fraction);
      const double line = 2 * pi / 120 * (3 + fraction);
      CHECK(load(120, line, surface) == doctest::Approx(load(480, line, surface)).epsilon(0.003));
    }
  }
}

// Whirl: a full film converts the journal's displacement into force as it converts half its speed into damping. This is
// exact on a centred journal, on any grid; off-centre the error is of the order of the grid's other errors.
TEST_CASE("WhirlRatio_DoesNotDependOnTheGrid") {
  const auto whirl_ratio = [](const Grid& grid, double epsilon) {
    FilmModel m{.R = 0.03, .L = 0.03, .c = 30e-6, .grid = grid};
    m.edge_left.pressure = m.edge_right.pressure = 1e8;  // full everywhere
    m.shear_force = ShearForce::torque_only;             // shear would add c/R
    const double omega = 200;
    const SurfaceMotion motion = surfaces(m, turning(m, epsilon, omega));
    Reynolds reynolds(m);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(grid.size()), du;
    REQUIRE(solve_film(reynolds, motion, {}, {}, u).solved());
    Eigen::Matrix2d K, C;
    for (int k = 0; k < 4; ++k) {
      MotionDirection direction;
      Eigen::VectorXd field(grid.size());
      for (int n = 0; n < grid.size(); ++n)
        field[n] = k % 2 == 0 ? -std::cos(grid.phi(n / grid.n_z)) : -std::sin(grid.phi(n / grid.n_z));
      (k < 2 ? direction.g : direction.g_rate) = field;
      Vector6 partial;
      respond(reynolds, direction, du, partial);
      const Vector6 total = partial + reynolds.forces().wrench_by_u * du;
      (k < 2 ? K : C).col(k % 2) = total.segment<2>(3);
    }
    const double k = (K(0, 0) * C(1, 1) + K(1, 1) * C(0, 0) - K(0, 1) * C(1, 0) - K(1, 0) * C(0, 1)) / C.trace();
    return std::sqrt(((k - K(0, 0)) * (k - K(1, 1)) - K(0, 1) * K(1, 0)) / C.determinant()) / omega;
  };
  // The tolerance is the solver's, rtol 1e-10.
  for (const Grid& grid : {Grid{12, 5}, Grid{60, 13}})
    CHECK(whirl_ratio(grid, 0) == doctest::Approx(0.5).epsilon(1e-10));
  for (const double epsilon : {0.0, 0.3, 0.6}) {
    CAPTURE(epsilon);
    // The ratio contains the grid's other errors.
    CHECK(whirl_ratio({60, 13}, epsilon) == doctest::Approx(whirl_ratio({240, 13}, epsilon)).epsilon(1e-4));
  }
}

// A closing and turning film over many steps, part cavitated, whatever the step: oil at the end is oil at the start and
// what has come in, to round-off; no fill fraction leaves [0, 1].
TEST_CASE("Oil_IsConservedAtAnyStep") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {48, 9}};
  m.supply = {SupplyKind::widest_gap, 0, 2e5};
  m.features = {pocket(Rectangle{}, Surface::shell), pocket(Ellipse{}, Surface::journal)};
  m.features[1].phi = 4;
  for (const double dt : {1e-5, 1e-3, 3e-3}) {
    CAPTURE(dt);
    if (dt == 3e-3) {  // a rotating groove feeds the land before the edges, within their last cells
      m.features.push_back({.name = "groove", .surface = Surface::journal, .phi = 2, .arc = 0.4, .length = 17e-3});
      m.features.back().pressure = 1e5;
    }
    Reynolds reynolds(m);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
    FilmHistory history{dt, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
    StepOilBalance oil;
    double volume = 0, passed = 0, worst = 0;
    // Orbit with a radius that pulsates: gap and rate at the end of each step are exact, so that a step's rate is not
    // the quotient of its gaps.
    const auto at = [&](double t) {
      const double r = m.c * (0.5 + 0.4 * std::sin(900 * t)), r_rate = m.c * 0.4 * 900 * std::cos(900 * t), a = 140 * t;
      const Eigen::Vector2d er(std::cos(a), std::sin(a)), ea(-er.y(), er.x());
      SurfaceMotion motion =
          surfaces(m, {.e = r * er, .e_rate = r_rate * er + 140 * r * ea, .omega_journal = 300}, a + pi);
      motion.phi_journal = 300 * t;
      return motion;
    };
    for (int step = 0; step <= 40; ++step) {
      const SurfaceMotion motion = at(step * dt);
      REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
      if (step == 0) {
        oil = oil_at_start(m, motion, history, u);
      } else {
        reynolds.settle(motion, history, u, oil);
        if (oil.redistributed_overfill > 0.02) {
          history.by_gap = true;
          REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
          reynolds.settle(motion, history, u, oil);
          history.by_gap = false;
        }
        const double in = dt * (oil.flow_supply - oil.flow_left - oil.flow_right);
        worst = std::max(worst, std::abs(oil.volume - volume - in));
        passed += dt * std::max(std::abs(oil.flow_supply), std::abs(oil.flow_left + oil.flow_right));
      }
      volume = oil.volume;
      const FilmFields fields = film_fields(m, motion, u);
      CHECK(fields.theta.minCoeff() >= 0);
      CHECK(oil.content.minCoeff() >= 0);
      CHECK(oil.content.maxCoeff() <= 1 + 1e-12);  // round-off
      history.theta = oil.content, history.w = fields.w, history.gap = oil.gap,
      history.phi_journal = motion.phi_journal;
    }
    CHECK(worst < 1e-9 * passed / 40);  // of a step's throughput: round-off, and what the solver leaves
  }
}

TEST_CASE("InterpolatedGaps_AreOfFourthOrder") {
  std::array<double, 2> face{}, cell{};
  for (int k = 0; k < 2; ++k) {
    FilmModel m{.R = 1, .L = 1, .c = 1, .grid = {k == 0 ? 40 : 80, 3}};
    const GridGeometry geometry(m);
    const GapInterpolation interpolation(m.grid, geometry);
    Eigen::VectorXd field(m.grid.size()), bends, excesses;
    for (int i = 0; i < m.grid.size(); ++i) field[i] = std::cos(3 * geometry.phi[i / 3]);
    interpolation.bends(field, bends);
    interpolation.excesses(field, excesses);
    const double half = 0.5 * geometry.dx[0];
    for (int i = 0; i < m.grid.n_phi; ++i) {
      const int here = m.grid.index(i, 1), next = m.grid.index((i + 1) % m.grid.n_phi, 1);
      const double at_face = 0.5 * (field[here] + field[next]) + bends[here], phi = geometry.phi[i];
      face[k] = std::max(face[k], std::abs(at_face - std::cos(3 * (phi + half))));
      const double mean = (std::sin(3 * (phi + half)) - std::sin(3 * (phi - half))) / (6 * half);
      cell[k] = std::max(cell[k], std::abs(field[here] + excesses[here] - mean));
    }
  }
  CHECK(std::log2(face[0] / face[1]) == doctest::Approx(4).epsilon(0.02));
  CHECK(std::log2(cell[0] / cell[1]) == doctest::Approx(4).epsilon(0.02));
}

// Parabolas that become negative between nodes, in one direction or in both together, are not used.
TEST_CASE("SmallestFilmBetweenNodes_IsThatOfTheNodeWhereParabolasDipBelowNothing") {
  FilmModel m{.R = 0.03, .L = 0.06 * pi, .c = 30e-6, .grid = {60, 61}};  // equal cells both ways
  for (const double beside : {4.0, 6.0, 20.0}) {
    CAPTURE(beside);
    // Four nodes as narrow as each other, all around them wider: parabolas dip by an eighth of the step.
    Eigen::VectorXd h = Eigen::VectorXd::Constant(m.grid.size(), 1e-3);
    for (int i = 9; i <= 12; ++i) {
      for (int j = 9; j <= 12; ++j) {
        const bool out_i = i == 9 || i == 12, out_j = j == 9 || j == 12;
        h[m.grid.index(i, j)] = 1e-5 * (1 + (out_i ? beside - 1 : 0) + (out_j ? beside - 1 : 0));
      }
    }
    const double dip = (beside - 1) / 8, both = 1 - 2 * dip;
    const double found = thinnest_film(m, GridGeometry(m), h, 0).value;
    CHECK(found == relative(1e-5 * (both > 0 ? both : 1)).epsilon(1e-9));  // round-off
  }
}

// Of two dips of a gap the one that is deeper between nodes counts, even if the lowest node lies in the other. Where
// both are equally deep, as in a lemon bore, round-off decides which node is lowest.
TEST_CASE("SmallestFilm_IsThatOfTheDeeperOfTwoDips") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 5}};
  for (const bool is_first : {true, false}) {
    CAPTURE(is_first);
    Eigen::VectorXd h = Eigen::VectorXd::Constant(m.grid.size(), 1e-4);
    const auto set = [&](int i, double thickness) { h.segment(m.grid.index(i, 0), 5).setConstant(thickness); };
    const int node = is_first ? 40 : 10, between = is_first ? 10 : 40;
    set(node - 1, 2e-5), set(node, 1e-5), set(node + 1, 2e-5);
    set(between - 1, 2e-5), set(between, 1.02e-5), set(between + 1, 1.02e-5), set(between + 2, 2e-5);
    const Thinnest found = thinnest_film(m, GridGeometry(m), h, 0);
    const double dip = 1.02e-5 - (2e-5 - 1.02e-5) / 8;          // of a parabola half-way between two equal nodes
    CHECK(found.value == relative(dip).epsilon(1e-9));          // round-off
    CHECK(found.in_the_middle == relative(dip).epsilon(1e-9));  // round-off
    CHECK(found.phi == doctest::Approx(m.grid.phi(between) + pi / 60).epsilon(1e-9));  // round-off
  }
}

// Between two rows only positions count at which neither lies in a groove.
TEST_CASE("SmallestFilmInTheMiddle_IsThatBesideTheGroove") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {60, 6}};
  for (const double side : {-1.0, 1.0}) {
    CAPTURE(side);
    m.features = {{.name = "pocket", .phi = pi, .z = side * 3e-3, .arc = 0.55, .length = 5e-3, .depth = 1e-4}};
    const Eigen::VectorXd h = surfaces(m, turning(m, 0.5, 100)).g;
    // The pocket ends 0.275 rad from the narrowest gap; the next line beside it lies at 18 degrees.
    const double at_line = 30e-6 - 15e-6 * std::cos(pi / 10);
    CHECK(thinnest_film(m, GridGeometry(m), h, 0).in_the_middle == relative(at_line).epsilon(1e-9));  // round-off
  }
}

}  // namespace pocket_relief_test
}  // namespace hersey::film
