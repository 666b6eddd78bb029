#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "film_cases.h"
#include "relative.h"

// Films far from any answer, and answers that the first way does not reach.
namespace hersey::film {
namespace far_films_test {

using Violation = FilmDomain::Violation;

constexpr double omega = 374;

FilmModel big_end(Cavitation cavitation = Cavitation::mass_conserving) {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {36, 9}, .cavitation = cavitation};
  m.supply = {SupplyKind::widest_gap, 0, 1e5};
  return m;
}

// Walls on both sides and no supply: the level of pressure is undetermined.
FilmModel closed_ring(double L) {
  FilmModel m{.R = 0.0225, .L = L, .c = 34e-6, .grid = {24, 7}, .cavitation = Cavitation::guembel};
  m.edge_left = m.edge_right = {.kind = EdgeKind::closed};
  return m;
}

TEST_CASE("SweepsWithoutIterations_ReportTheResidual") {
  const FilmModel m = big_end();
  const SurfaceMotion motion = surfaces(m, turning(m, 0.7, omega));
  for (const double start : {0.0, 1e6}) {  // cold, and from a film that is none
    CAPTURE(start);
    Eigen::VectorXd u = Eigen::VectorXd::Constant(m.grid.size(), start);
    Reynolds reynolds(m);
    const FilmSolveSummary summary =
        solve_film(reynolds, motion, {}, {.solver = FilmSolver::sor, .max_iterations = 0}, u);
    CHECK_FALSE(summary.solved());
    CHECK(summary.message.find("after 0 iterations") != std::string::npos);
    CHECK(summary.relative_residual > 1e-10);  // the tolerance
  }
}

// Where a cavitated film fills again in a pocket of 25 times the gap, oil there has next to no pressure. With the
// pressure of the land the viscosity was off by a percent, over conductances 15,000 times the land's: Newton's method
// cycled, sweeps took ten times as long, and for the mirror image of this bearing they did not converge.
TEST_CASE("PocketOfACavitatedFilm_IsFilledWithoutCycles") {
  FilmModel m{.R = 11.49e-3, .L = 20.6e-3, .c = 6.242e-6, .grid = {48, 9}, .cavitation = Cavitation::reynolds};
  m.lubricant.mu0 = 4.703e-3, m.lubricant.viscosity_law = Barus{2.125e-9};
  m.edge_left = m.edge_right = {.pressure = 280300};
  m.supply = {.kind = SupplyKind::fixed_angle};
  const double angle = 288 * pi / 180, c = m.c;
  for (const double side : {-1.0, 1.0}) {
    m.features = {{.name = "pocket",
                   .shape = Ellipse{},
                   .phi = 0.257,
                   .z = side * 5.208e-3,
                   .arc = 0.3108,
                   .length = 6.72e-3,
                   .is_fed = false,
                   .depth = 157.6e-6}};
    for (const FilmSolver solver : {FilmSolver::newton, FilmSolver::multigrid}) {
      CAPTURE(side);
      CAPTURE(static_cast<int>(solver));
      const Journal journal{.e = 0.7476 * c * Eigen::Vector2d(std::cos(angle), std::sin(angle)),
                            .tilt = {side * -2.74e-5, side * 4.01e-5},
                            .omega_journal = 56.7};
      const SurfaceMotion motion = surfaces(m, journal, angle - pi);
      const SolvedFilm film = solve_cold(m, motion, journal.e, {.solver = solver}, journal.tilt);
      CHECK(film.summary.solved());
      CHECK(film.summary.iterations <= 10);  // 5 with hardly any viscosity under pressure
    }
  }
}

// Sweeps follow only where they are allowed and Newton's method has not converged.
TEST_CASE("FilmWithoutFallback_EndsWhereNewtonDoes") {
  const FilmModel m = big_end();
  const SurfaceMotion motion = surfaces(m, turning(m, 0.9, omega));
  std::array<Eigen::VectorXd, 2> u{Eigen::VectorXd::Zero(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  for (const bool allows_fallback : {false, true}) {
    Reynolds reynolds(m);
    CHECK_FALSE(solve_film(reynolds, motion, {}, {.max_iterations = 1, .allows_fallback = allows_fallback},
                           u[allows_fallback ? 1 : 0])
                    .solved());
  }
  CHECK(u[0] == u[1]);
}

// On a soft liner the surfaces overlap without pressure: increments that remove all of the pressure close the film, and
// are shortened.
TEST_CASE("PressureThatSeparatesSurfaces_IsFoundFromFarAbove") {
  FilmModel m = big_end();
  m.edge_left = m.edge_right = {.kind = EdgeKind::closed};  // an open one has no pressure that could
  m.compliance = 2e-3 / 1e9;
  const SurfaceMotion motion = surfaces(m, turning(m, 1.05, omega));
  Reynolds reynolds(m);
  Eigen::VectorXd answer = Eigen::VectorXd::Zero(m.grid.size());
  for (const double e : {0.8, 0.9, 1.0, 1.05})
    REQUIRE(solve_film(reynolds, surfaces(m, turning(m, e, omega)), {}, {}, answer).solved());
  for (const double factor : {0.9, 2.0, 10.0, 100.0}) {
    CAPTURE(factor);
    Eigen::VectorXd u = answer.unaryExpr([&](double one) { return one > 0 ? factor * one : one; });
    const FilmSolveSummary summary = solve_film(reynolds, motion, {}, {}, u);
    CAPTURE(summary.message);
    CHECK(summary.solved());
    // A residual of 1e-10, which weak spots of the film amplify by the condition, some 1e3.
    CHECK((u - answer).norm() < 1e-7 * answer.norm());
  }
}

// The equations are finite for gaps of any size, or the domain excludes the gap.
TEST_CASE("GapsOfAnySize_AreFiniteOrReported") {
  const FilmModel m = big_end();
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  SurfaceMotion motion = surfaces(m, turning(m, 0.3, omega));
  Reynolds reynolds(m);
  int unbounded = 0;
  for (double size = 1; size < 1e150; size *= 3) {
    motion.g.setConstant(size);
    const FilmDomain domain = reynolds.linearise(motion, {}, u);
    if (!domain.is_inside()) {
      CHECK(domain.violation == Violation::not_finite);
      ++unbounded;
      continue;
    }
    CHECK(unbounded == 0);  // no gap after the first one outside the domain is inside it
    REQUIRE(reynolds.residual().value.allFinite());
    REQUIRE(reynolds.jacobian_product(Eigen::VectorXd::Ones(u.size())).allFinite());
  }
  CHECK(unbounded > 0);
}

// A pressure everywhere changes nothing: the Jacobian is singular, and a shift by the model's scale has no effect in
// gaps a million times as wide. What is left of the residual does not depend on which pressure it is.
TEST_CASE("FilmWithoutPrescribedPressure_HasAnIncrement") {
  const FilmModel m = closed_ring(0.0156);
  SurfaceMotion motion = surfaces(m, {});
  Eigen::VectorXd u(m.grid.size()), du;
  for (int k = 0; k < u.size(); ++k) u[k] = 1e5 * (2 + std::cos(m.grid.phi(k / m.grid.n_z)) + 0.1 * (k % m.grid.n_z));
  for (const double wider : {1.0, 1e6}) {
    for (const LinearSolver linear : {LinearSolver::direct, LinearSolver::multigrid}) {
      CAPTURE(wider);
      CAPTURE(static_cast<int>(linear));
      motion.g.setConstant(wider * m.c);
      Reynolds reynolds(m, linear);
      REQUIRE(reynolds.linearise(motion, {}, u).is_inside());
      const double before = reynolds.residual().value.norm();
      reynolds.newton_increment(du);
      REQUIRE(du.allFinite());
      // The equations are linear: what is left is the shift's part, below a tenth of any entry.
      REQUIRE(reynolds.linearise(motion, {}, u + du).is_inside());
      CHECK(reynolds.residual().value.norm() < before);
    }
  }
}

// The ring is so narrow that flow around disappears in the round-off of flow along the axis: lines of multigrid have no
// pivots.
TEST_CASE("RingAsNarrowAsAThread_IsLeftToTheDirectSolver") {
  const FilmModel m = closed_ring(1e-9);
  const SurfaceMotion motion = surfaces(m, turning(m, 0.5, omega));
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  std::array<Eigen::VectorXd, 2> du;
  std::array<Reynolds, 2> films{Reynolds(m), Reynolds(m, LinearSolver::multigrid)};
  for (const std::size_t k : {0U, 1U}) {
    REQUIRE(films[k].linearise(motion, {}, u).is_inside());
    films[k].newton_increment(du[k]);
  }
  CHECK(films[1].linear_solver().fallback_solves == 1);
  CHECK(du[1] == du[0]);
}

// An earlier factor has no effect on it.
TEST_CASE("RegularisedIncrement_IsTheSameForANewFilm") {
  const FilmModel m = big_end();
  const SurfaceMotion motion = surfaces(m, turning(m, 0.7, omega));
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Reynolds fresh(m), used(m);
  Eigen::VectorXd du, other, newton;
  CHECK_FALSE(fresh.linear_solver().has_factor);
  REQUIRE((fresh.linearise(motion, {}, u).is_inside() && used.linearise(motion, {}, u).is_inside()));
  used.newton_increment(newton);
  fresh.newton_increment(du, {.is_regularised = true}), used.newton_increment(other, {.is_regularised = true});
  CHECK((du - other).norm() < 1e-10 * du.norm());  // pivots of another matrix: round-off times the condition
  CHECK(du.norm() < newton.norm());
}

TEST_CASE("ChordOutsideTheDomain_IsReportedAndLeavesNoFactor") {
  const FilmModel m = big_end();
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Eigen::VectorXd du;
  Reynolds reynolds(m);
  REQUIRE(reynolds.linearise(surfaces(m, turning(m, 0.7, omega)), {}, u).is_inside());
  reynolds.newton_increment(du);
  CHECK(reynolds.chord_increment(surfaces(m, turning(m, 1.2, omega)), {}, u, du).violation == Violation::closed);
  CHECK_FALSE(reynolds.linear_solver().has_factor);
  CHECK(reynolds.linearise(surfaces(m, turning(m, 0.7, omega)), {}, u).is_inside());
}

// The oil of a step follows from its equations, whether the factor is that of the same film or of one far away.
TEST_CASE("OilOfAStep_DoesNotDependOnTheFactor") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const double sense : {1.0, -1.0}) {
      CAPTURE(static_cast<int>(cavitation));
      CAPTURE(sense);
      const FilmModel m = big_end(cavitation);
      FilmHistory history{1e-4, Eigen::VectorXd::Constant(m.grid.size(), 0.9), {}, {}};
      const Journal journal{.e = {-0.8 * m.c, 0}, .e_rate = {0.02, 0.01}, .omega_journal = sense * omega};
      const SurfaceMotion motion = surfaces(m, journal);
      Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size()), du;
      std::array<StepOilBalance, 2> oil;
      std::array<Reynolds, 2> films{Reynolds(m), Reynolds(m)};
      REQUIRE(solve_film(films[0], motion, history, {}, u).solved());
      films[0].newton_increment(du);
      REQUIRE(films[1].linearise(surfaces(m, turning(m, 0.1, -sense * omega)), {}, 0.3 * u).is_inside());
      films[1].newton_increment(du);
      for (const std::size_t k : {0U, 1U}) films[k].settle(motion, history, u, oil[k]);
      // Refinement leaves 1e-10 of the defect.
      CHECK((oil[0].content - oil[1].content).cwiseAbs().maxCoeff() < 1e-8);
      const double scale = 1e-8 * std::abs(oil[0].flow_supply);
      CHECK(std::abs(oil[1].flow_out() - oil[0].flow_out()) < scale);
      CHECK(std::abs(oil[1].flow_supply - oil[0].flow_supply) < scale);
    }
  }
}

// Both surfaces at once, one against the other, do what they do one by one.
TEST_CASE("SurfacesThatMoveAgainstEachOther_AddUp") {
  FilmModel m = big_end();
  m.supply = {SupplyKind::fixed_angle, 0.4, 1e5};
  m.roughness = {FlowFactors::patir_cheng, {3e-6, 0.2}, {5e-6, 4}};  // drags oil with the surfaces
  const SurfaceMotion motion = surfaces(m, turning(m, 0.7, omega), 0.4);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Reynolds reynolds(m);
  REQUIRE(solve_film(reynolds, motion, {}, {}, u).solved());
  REQUIRE(reynolds.linearise(motion, {}, u).is_inside());
  const std::array<MotionDirection, 3> directions{
      MotionDirection{.u_shell = 1}, {.u_journal = -1}, {.u_shell = 1, .u_journal = -1}};
  Eigen::MatrixXd residual;
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrench;
  reynolds.partials(directions, residual, wrench);
  const Eigen::VectorXd shell = residual.col(0), journal = residual.col(1), both = residual.col(2);
  const Vector6 by_shell = wrench.col(0), by_journal = wrench.col(1), by_both = wrench.col(2);
  CHECK((shell + journal - both).norm() < 1e-12 * (shell.norm() + journal.norm()));              // round-off
  CHECK((by_shell + by_journal - by_both).norm() < 1e-12 * (by_shell.norm() + by_both.norm()));  // likewise
  CHECK(both.norm() > 0);
}

// A wall is closed, also where a groove ends just before it; an edge is open.
TEST_CASE("GrooveThatEndsJustBeforeAWall_LosesNoOilThere") {
  for (const EdgeKind kind : {EdgeKind::closed, EdgeKind::pressure}) {
    FilmModel m = big_end();
    m.supply = {};
    m.edge_left.kind = kind;
    const double step = m.L / (m.grid.n_z - 1);
    m.features = {
        {.name = "groove", .phi = 1, .z = -0.2 * step, .arc = 0.6, .length = m.L - 0.8 * step, .pressure = 3e5}};
    const SolvedFilm film = solve_cold(m, turning(m, 0.6, omega));
    REQUIRE(film.summary.solved());
    CHECK((film.observed.flow_left == 0) == (kind == EdgeKind::closed));
    CHECK(film.observed.flow_right > 0);
    CHECK(film.observed.mass_balance_error < 1e-9);  // what the residual of 1e-10 leaves
  }
}

// In a film at rest any amount of oil is a solution, a negative one included: it is set to zero there, without
// pressure.
TEST_CASE("FilmAtRest_HasNoNegativeOil") {
  FilmModel m = big_end();
  m.supply = {};
  for (const FilmSolver solver : {FilmSolver::newton, FilmSolver::multigrid, FilmSolver::sor}) {
    CAPTURE(static_cast<int>(solver));
    Reynolds reynolds(m);
    Eigen::VectorXd u = Eigen::VectorXd::Constant(m.grid.size(), -0.5 * fill_scale(m));
    u.segment(m.grid.index(5, 0), m.grid.n_z).setConstant(-1.5 * fill_scale(m));
    const int emptiest = lowest_fill_node(m, u);
    REQUIRE(emptiest >= 0);
    CHECK(solve_film(reynolds, surfaces(m, {.e = {1e-5, 0}}), {}, {.solver = solver}, u).solved());
    CHECK(lowest_fill_node(m, u) == -1);
    CHECK(u.maxCoeff() <= 0);
  }
}

// Sweeps between walls, with a line between nodes, are tested in both senses of rotation.
TEST_CASE("SweepsBetweenWalls_AgreeWithNewton") {
  for (const double sense : {1.0, -1.0, 0.0}) {
    for (const double line : {0.0, 0.26, 0.9}) {
      CAPTURE(sense);
      CAPTURE(line);
      FilmModel m = big_end();
      m.edge_left = m.edge_right = {.kind = EdgeKind::closed};
      m.supply = {SupplyKind::fixed_angle, line, 1e5};
      const SurfaceMotion motion = surfaces(m, turning(m, 0.6, sense * omega), line);
      const SolvedFilm newton = solve_cold(m, motion, {0, 0}),
                       sor = solve_cold(m, motion, {0, 0}, {.solver = FilmSolver::sor});
      REQUIRE(newton.summary.solved());
      REQUIRE(sor.summary.solved());
      // At rest the line's pressure acts everywhere, and the film carries no load.
      const double load = sense == 0 ? m.supply.pressure * m.R * m.L : newton.wrench.norm();
      // Residuals of 1e-10, which weak spots of the film amplify by the condition, some 1e3.
      CHECK((sor.wrench - newton.wrench).norm() < 1e-6 * load);
      CHECK((sor.fields.theta - newton.fields.theta).cwiseAbs().maxCoeff() < 1e-5);
    }
  }
}

// Oil that enters through grooves of pads leaves over their edges and ends, or over their ends alone.
TEST_CASE("GroovesOfPads_FeedWhatLeavesOverTheEdges") {
  for (const EdgeKind kind : {EdgeKind::pressure, EdgeKind::closed}) {
    for (const double sense : {1.0, -1.0}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(sense);
      FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = patch_grid({{0.5, 1.5, 11}, {2, 2.6, 7}}, 7)};
      m.ends.resize(2);
      m.edge_left.kind = m.edge_right.kind = kind;
      m.fill_speed = 100;
      // The grooves reach almost to both edges, at the first end of one pad and the last of the other.
      for (const double phi : {0.55, 2.55})
        m.features.push_back({.name = "groove", .phi = phi, .arc = 0.2, .length = 0.9 * m.L, .pressure = 2e5});
      m.features.push_back({.name = "stronger", .phi = 0.6, .arc = 0.2, .length = 0.92 * m.L, .pressure = 3e5});
      const Journal journal{.e = {5e-6, 5e-6}, .omega_journal = sense * 100};
      const SolvedFilm film = solve_cold(m, journal);
      CAPTURE(film.summary.message);
      REQUIRE(film.summary.solved());
      CHECK(film.observed.flow_supply > 0);
      CHECK(film.observed.flow_out() == relative(film.observed.flow_supply).epsilon(1e-8));  // the residual of 1e-10
      CHECK((film.observed.flow_left == 0) == (kind == EdgeKind::closed));
    }
  }
}

// The film of a pad with a pocket up to its end is independent of the origin of its coordinate.
TEST_CASE("PocketOfAPlane_DoesNotDependOnTheOriginAlongIt") {
  std::vector<SolvedFilm> films;
  constexpr double far = 7;  // more than 2 pi, which has no meaning on a plane
  for (const double from : {0.0, far}) {
    FilmModel m{.surface = Plane{}, .R = 0.05, .L = 0.04, .c = 40e-6, .grid = patch_grid({{from, from + 1, 21}}, 9)};
    m.ends = {{.first = {.pressure = 1e5}}};
    m.features = {{.name = "pocket", .phi = from + 0.85, .arc = 0.3, .length = 0.02, .is_fed = false, .depth = 30e-6},
                  {.name = "dimple",
                   .shape = Ellipse{},
                   .phi = from + 0.3,
                   .arc = 0.2,
                   .length = 0.01,
                   .is_fed = false,
                   .depth = 20e-6}};
    SurfaceMotion motion = surfaces(m, {});
    for (int k = 0; k < m.grid.size(); ++k) {
      const double along = m.grid.phi(k / m.grid.n_z) - from;
      motion.g[k] = m.c * (1.5 - along);  // thinnest at its end, beside the pocket
    }
    motion.u_shell = 5;
    films.push_back(solve_cold(m, motion, {0, 0}));
    REQUIRE(films.back().summary.solved());
  }
  const FilmObservables &here = films[0].observed, &there = films[1].observed;
  CHECK(here.p_max > 1e5);
  CHECK((films[0].fields.p - films[1].fields.p).norm() < 1e-7 * films[0].fields.p.norm());  // the residual of 1e-10
  CHECK(there.h_min == relative(here.h_min).epsilon(1e-9));                                 // round-off of angles
  CHECK(here.h_min == relative(0.5 * 40e-6).epsilon(1e-9));                                 // likewise
  CHECK(there.h_min_phi - far == relative(here.h_min_phi).epsilon(1e-9));                   // likewise
  CHECK(there.h_min_features == relative(here.h_min_features).epsilon(1e-9));               // likewise
}

// A border that two pockets have in common disappears.
TEST_CASE("PocketsSideBySide_AreOne") {
  std::vector<SolvedFilm> films;
  for (const bool are_two : {false, true}) {
    FilmModel m = big_end();
    const SurfaceFeature pocket{.arc = 0.25, .length = 0.008, .is_fed = false, .depth = 30e-6};
    m.features.assign(are_two ? 2 : 1, pocket);
    m.features[0].phi = are_two ? 1 : 1.125;
    if (are_two) m.features[1].phi = 1.25;
    if (!are_two) m.features[0].arc = 0.5;
    films.push_back(solve_cold(m, turning(m, 0.6, omega)));
    REQUIRE(films.back().summary.solved());
  }
  CHECK((films[0].fields.p - films[1].fields.p).norm() < 1e-7 * films[0].fields.p.norm());  // the residual of 1e-10
}

// The history is brought to coarser grids, too: a step solved from zero ends where one from nearby does.
TEST_CASE("StepOfACompressibleOil_EndsWhereItDoesFromAnyStart") {
  FilmModel m = big_end();
  m.grid = {60, 13};
  m.lubricant.density_law = DowsonHigginson{};
  Journal journal = turning(m, 0.7, omega);
  journal.e_rate = {0.03, -0.05};
  const SurfaceMotion motion = surfaces(m, journal);
  const int n = m.grid.size();
  FilmHistory history{1e-4, Eigen::VectorXd::Constant(n, 0.9), {}, Eigen::VectorXd::Constant(n, 1.01)};
  history.gap = 0.98 * motion.g;
  Reynolds reynolds(m);
  Eigen::VectorXd cold = Eigen::VectorXd::Zero(n);
  REQUIRE(solve_film(reynolds, motion, history, {}, cold).solved());
  Eigen::VectorXd warm = 0.9 * cold;
  REQUIRE(solve_film(reynolds, motion, history, {}, warm).solved());
  CHECK((warm - cold).norm() < 1e-7 * cold.norm());  // the residual of 1e-10
}

// No oil is lost where a line lies in a groove or beside it, and where a hole reaches an edge.
TEST_CASE("LineAcrossAGrooveAndHoleOnAnEdge_KeepTheirOil") {
  FilmModel m = big_end();
  const double step = 2 * pi / m.grid.n_phi, dz = m.L / (m.grid.n_z - 1);
  m.features = {{.name = "groove", .phi = 6 * step, .arc = 2.6 * step, .length = 0.6 * m.L, .pressure = 2e5},
                {.name = "hole",
                 .shape = Ellipse{},
                 .phi = 12 * step,
                 .z = 0.5 * m.L,
                 .arc = 2.6 * step,
                 .length = 0.3 * m.L,
                 .pressure = 3e5},
                {.name = "slit",
                 .phi = 20 * step,
                 .z = -0.5 * m.L + 0.5 * dz,
                 .arc = 2.6 * step,
                 .length = 0.4 * dz,
                 .pressure = 3e5}};
  for (const double line : {4.4, 4.9, 5.0, 5.5, 6.0, 7.1, 7.5, 8.3}) {
    CAPTURE(line);
    m.supply = {SupplyKind::fixed_angle, line * step, 1e5};
    const SolvedFilm film = solve_cold(m, surfaces(m, turning(m, 0.5, omega), line * step), {-0.5 * m.c, 0});
    REQUIRE(film.summary.solved());
    CHECK(film.observed.mass_balance_error < 1e-8);  // what the residual of 1e-10 leaves
    // Round-off of its angle has no effect.
    const SolvedFilm beside = solve_cold(m, surfaces(m, turning(m, 0.5, omega), line * step + 1e-12), {-0.5 * m.c, 0});
    CHECK((beside.fields.p - film.fields.p).norm() < 1e-6 * film.fields.p.norm());  // 1e-12 over a step, residuals
  }
}

// Depths of overlapping pockets add, in either order in the file.
TEST_CASE("PocketsOverEachOther_AddUpInAnyOrder") {
  const SurfaceFeature slot{.phi = 1, .arc = 0.5, .length = 0.008, .is_fed = false, .depth = 30e-6};
  SurfaceFeature dimple = slot, deep = slot;
  dimple.shape = Ellipse{}, dimple.phi = 1.2;
  deep.depth = 60e-6;
  const auto film_with = [](const std::vector<SurfaceFeature>& features) {
    FilmModel m = big_end();
    m.features = features;
    return solve_cold(m, turning(m, 0.6, omega));
  };
  const auto differ = [](const SolvedFilm& a, const SolvedFilm& b) {
    return (a.fields.p - b.fields.p).norm() / a.fields.p.norm();
  };
  constexpr double solved = 1e-7;  // the residual of 1e-10
  CHECK(differ(film_with({slot, dimple}), film_with({dimple, slot})) < solved);
  CHECK(differ(film_with({slot, slot}), film_with({deep})) < solved);
  CHECK(differ(film_with({slot}), film_with({deep})) > 1e-4);
}

// A film that re-forms with its highest pressure at the first full node does so within the cell before it.
TEST_CASE("CavityThatEndsAtAPeak_EndsInTheCellBeforeIt") {
  const FilmModel m{.grid = {60, 13}};
  const Grid& grid = m.grid;
  Eigen::VectorXd u = Eigen::VectorXd::Constant(grid.size(), 1e5);
  for (int i = 20; i < 30; ++i) u.segment(grid.index(i, 0), grid.n_z).setConstant(-0.5 * fill_scale(m));
  u.segment(grid.index(30, 0), grid.n_z).setConstant(3e5);
  const FilmObservables observed = observe_film(m, surfaces(m, turning(m, 0.5, omega)), {}, {0, 0}, u);
  CHECK(observed.reformation_angle >= grid.phi(29) - 1e-12);  // round-off
  CHECK(observed.reformation_angle <= grid.phi(30) + 1e-12);  // likewise
}

// A groove across the line prescribes its nodes, and the line has no part in their rows.
TEST_CASE("SweepsOverALineAcrossAGroove_AgreeWithNewton") {
  FilmModel m = big_end();
  m.supply = {SupplyKind::fixed_angle, 0.26, 1e5};
  m.features = {{.name = "groove", .phi = 0.26, .arc = 0.6, .length = 0.5 * m.L, .pressure = 3e5}};
  const SurfaceMotion motion = surfaces(m, turning(m, 0.6, omega), 0.26);
  const SolvedFilm newton = solve_cold(m, motion, {0, 0}),
                   sor = solve_cold(m, motion, {0, 0}, {.solver = FilmSolver::sor});
  REQUIRE(newton.summary.solved());
  REQUIRE(sor.summary.solved());
  // Residuals of 1e-10, which weak spots of the film amplify by the condition, some 1e3.
  CHECK((sor.wrench - newton.wrench).norm() < 1e-6 * newton.wrench.norm());
}

// Surfaces that overlap are no film for sweeps either.
TEST_CASE("SweepsInAClosedGap_ReportTheNode") {
  const FilmModel m = big_end();
  const SurfaceMotion motion = surfaces(m, turning(m, 1.2, omega));
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const FilmSolveSummary summary = solve_film(reynolds, motion, {}, {.solver = FilmSolver::sor}, u);
  CHECK_FALSE(summary.solved());
  CHECK(summary.domain.violation == Violation::closed);
  CHECK(motion.g[summary.domain.node] <= 0);
}

// A step that is to follow its gap without knowing the initial one uses the rate, as any first step does.
TEST_CASE("StepWithoutInitialGap_UsesTheRate") {
  const FilmModel m = big_end();
  Journal journal = turning(m, 0.5, omega);
  journal.e_rate = {0, 2e-3};
  const SurfaceMotion motion = surfaces(m, journal);
  std::array<Eigen::VectorXd, 2> u;
  for (const bool by_gap : {false, true}) {
    FilmHistory history;
    history.dt = 1e-3, history.theta = Eigen::VectorXd::Ones(m.grid.size()), history.by_gap = by_gap;
    Reynolds reynolds(m);
    Eigen::VectorXd& film = u[by_gap ? 1 : 0];
    film.setZero(m.grid.size());
    REQUIRE(solve_film(reynolds, motion, history, {}, film).solved());
  }
  CHECK(u[1] == u[0]);
}

}  // namespace far_films_test
}  // namespace hersey::film
