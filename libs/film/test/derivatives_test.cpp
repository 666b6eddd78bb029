#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "balance/flow_balance.h"
#include "film_cases.h"
#include "observe/film_wrench.h"
#include "rough_states.h"
#include "seeded_random.h"

// Every derivative against central differences: residual and wrench, with respect to the unknown and to every change of
// the surfaces.
namespace hersey::film {
namespace derivatives_test {

using namespace rough_states;

constexpr double kLinear = 1e-8;  // multigrid answers to 1e-10; summed over nodes and directions

Eigen::VectorXd sparse_times(const FlowBalance& balance, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int column = 0; column < balance.size(); ++column) {
    for (int k = balance.column_start()[column]; k < balance.column_start()[column + 1]; ++k) {
      y[balance.row_index()[k]] += balance.values()[k] * x[column];
    }
  }
  return y;
}

TEST_CASE("FilmJacobian_MatchesFiniteDifference") {
  for (const State& s : all_states()) {
    CAPTURE(s.name);
    FlowBalance balance(s.model);
    const Eigen::VectorXd du = 1e-2 * s.u.cwiseAbs().cwiseProduct(seeded_random(s.u.size(), 1, 5).col(0));
    balance.evaluate(s.motion, s.history, s.u + d * du);
    const Eigen::VectorXd after = balance.residual();
    balance.evaluate(s.motion, s.history, s.u - d * du);
    const Eigen::VectorXd before = balance.residual();
    balance.evaluate(s.motion, s.history, s.u);
    balance.assemble_jacobian();
    const Eigen::VectorXd exact = sparse_times(balance, du), difference = (after - before) / (2 * d);
    // du is a hundredth of u, so round-off weighs a hundred times more.
    CHECK((exact - difference).norm() < 100 * tolerance * exact.norm());
  }
}

TEST_CASE("ResidualAlongSurfaceChanges_MatchesFiniteDifference") {
  for (const State& s : all_states()) {
    CAPTURE(s.name);
    FlowBalance balance(s.model);
    for (const auto& [name, direction] : directions(s)) {
      const std::string what = name;  // clang 14 captures no structured binding
      CAPTURE(what);
      balance.evaluate(moved(s.motion, direction, d), s.history, s.u);
      const Eigen::VectorXd after = balance.residual();
      balance.evaluate(moved(s.motion, direction, -d), s.history, s.u);
      const Eigen::VectorXd before = balance.residual();
      balance.evaluate(s.motion, s.history, s.u);
      const double scale = balance.residual().norm();
      Eigen::VectorXd exact;
      balance.derivative(direction, exact);
      const double round_off = std::numeric_limits<double>::epsilon() * scale / d;
      CHECK((exact - (after - before) / (2 * d)).norm() < tolerance * exact.norm() + round_off);
      const bool storage_only = what == "gap rate";
      CHECK(exact.norm() > (storage_only ? 10 : 1000) * round_off);  // the check above cannot pass on zeros
    }
  }
}

TEST_CASE("WrenchDerivatives_MatchFiniteDifference") {
  for (const State& s : all_states()) {
    CAPTURE(s.name);
    Reynolds reynolds(s.model);
    const auto wrench = [&](const SurfaceMotion& motion, const Eigen::VectorXd& u) {
      reynolds.linearise(motion, s.history, u);
      return reynolds.forces().wrench_on_shell;
    };
    const Eigen::VectorXd du = 1e-2 * s.u.cwiseAbs().cwiseProduct(seeded_random(s.u.size(), 1, 5).col(0));
    const Vector6 by_u = (wrench(s.motion, s.u + d * du) - wrench(s.motion, s.u - d * du)) / (2 * d);
    // Moments and forces are compared as forces, with the bearing's radius as arm.
    const Vector6 unit = (Vector6() << 1 / s.model.R, 1 / s.model.R, 1 / s.model.R, 1, 1, 1).finished();
    const double scale = unit.cwiseProduct(wrench(s.motion, s.u)).norm();
    CHECK(unit.cwiseProduct(reynolds.forces().wrench_by_u * du - by_u).norm() < 10 * tolerance * scale);
    for (const auto& [name, direction] : directions(s)) {
      const std::string what = name;  // clang 14 captures no structured binding
      CAPTURE(what);
      const Vector6 difference =
          (wrench(moved(s.motion, direction, d), s.u) - wrench(moved(s.motion, direction, -d), s.u)) / (2 * d);
      wrench(s.motion, s.u);
      Eigen::VectorXd answer;
      Vector6 partial;
      respond(reynolds, direction, answer, partial);
      CHECK(unit.cwiseProduct(partial - difference).norm() < 10 * tolerance * scale);
    }
  }
}

// The condensed derivative a bearing uses: the film solved to the end at both sides of a difference.
TEST_CASE("ResponseOfASolvedFilm_MatchesFiniteDifference") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    CAPTURE(static_cast<int>(cavitation));
    State s = rough_state(cavitation, true, true);
    s.history.theta.setOnes();
    s.history.w.setZero();
    s.u.setZero();
    Reynolds reynolds(s.model);
    const FilmSolveOptions options{.rtol = 1e-13};
    REQUIRE(solve_film(reynolds, s.motion, s.history, options, s.u).solved());
    for (const auto& [name, direction] : directions(s)) {
      const std::string what = name;  // clang 14 captures no structured binding
      CAPTURE(what);
      Eigen::VectorXd du;
      Vector6 partial;
      reynolds.linearise(s.motion, s.history, s.u);
      respond(reynolds, direction, du, partial);
      const Vector6 total = partial + reynolds.forces().wrench_by_u * du;
      // Smaller steps than above: the set of cavitated nodes must not change between both sides.
      constexpr double step = 1e-6;
      Eigen::VectorXd before = s.u, after = s.u;
      REQUIRE(solve_film(reynolds, moved(s.motion, direction, step), s.history, options, after).solved());
      const Vector6 wrench_after = reynolds.forces().wrench_on_shell;
      REQUIRE(solve_film(reynolds, moved(s.motion, direction, -step), s.history, options, before).solved());
      const Vector6 difference = (wrench_after - reynolds.forces().wrench_on_shell) / (2 * step);
      // Round-off of the solves, amplified by 1/step, against the wrench itself.
      CHECK((total - difference).norm() < 1e-6 * reynolds.forces().wrench_on_shell.norm());
      CHECK((du - (after - before) / (2 * step)).norm() < 1e-6 * s.u.norm());
    }
  }
}

TEST_CASE("ResponsesTogether_AreTheResponsesOneByOne") {
  const State s = rough_state(Cavitation::mass_conserving, true, true);
  std::vector<MotionDirection> all;
  for (const auto& [what, direction] : directions(s)) all.push_back(direction);
  Reynolds reynolds(s.model);
  reynolds.linearise(s.motion, s.history, s.u);
  Eigen::MatrixXd du;
  Eigen::Matrix<double, 6, Eigen::Dynamic> partial;
  respond(reynolds, all, du, partial);
  for (std::size_t k = 0; k < all.size(); ++k) {
    Eigen::VectorXd one;
    Vector6 one_partial;
    respond(reynolds, all[k], one, one_partial);
    CHECK((du.col(k) - one).norm() <= 1e-12 * one.norm());  // same elimination, other order of summation
    CHECK((partial.col(k) - one_partial).norm() == 0);
  }
}

// Two surfaces that deform by functions of which some are zero at a node; the second turns.
SurfaceShapes some_shapes(int n) {
  const auto functions = [n](int count, unsigned seed) {
    Eigen::MatrixXd dense = seeded_random(n, count, seed);
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < n; ++i)
        if ((i + k) % 3 != 0) dense(i, k) = 0;
    return SurfaceShapes::Functions(dense.sparseView());
  };
  SurfaceShapes shapes = SurfaceShapes::none(n);
  shapes.surfaces.push_back({functions(7, 1), {}, seeded_random(7, 4, 2), true});
  shapes.surfaces.push_back({functions(5, 3), functions(5, 4), seeded_random(5, 3, 5), false});
  shapes.openings.resize(n, 7);
  shapes.openings << shapes.surfaces[0].opening * shapes.surfaces[0].functions,
      shapes.surfaces[1].opening * shapes.surfaces[1].functions;
  return shapes;
}

// Directions, between which and those of ports the shapes stand; shapes whose films feed nothing are found without
// columns of their own.
TEST_CASE("CondensedFilm_IsThatOfItsResponses") {
  State s = rough_state(Cavitation::mass_conserving, true, true);
  const SurfaceShapes shapes = some_shapes(s.model.grid.size());
  s.motion.shell_opening = Eigen::VectorXd::Zero(s.model.grid.size());
  for (const auto linear : {LinearSolver::direct, LinearSolver::multigrid}) {
    for (const PortFlows flows : {PortFlows::left_out, PortFlows::included}) {
      CAPTURE(static_cast<int>(linear));
      CAPTURE(static_cast<int>(flows));
      std::vector<MotionDirection> given, ports, all;
      for (const auto& [what, direction] : directions(s))
        (direction.port_pressure.size() ? ports : given).push_back(direction);
      REQUIRE(!ports.empty());
      all = given;
      for (Eigen::Index a = 0; a < shapes.amplitudes(); ++a) shapes.find_along_amplitude(a, all.emplace_back());
      for (Eigen::Index a = 0; a < shapes.amplitudes(); ++a) shapes.find_along_rate(a, all.emplace_back());
      all.insert(all.end(), ports.begin(), ports.end());
      given.insert(given.end(), ports.begin(), ports.end());
      const Eigen::VectorXd ds = 1e-7 * Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(all.size()), 1, 2);
      Eigen::VectorXd du0, du;
      Eigen::MatrixXd answers;
      Eigen::Matrix<double, 6, Eigen::Dynamic> partial;
      CondensedFilm film;
      Reynolds reynolds(s.model, linear);
      reynolds.linearise(s.motion, s.history, s.u);
      reynolds.newton_increment(du0);
      respond(reynolds, all, answers, partial);
      reynolds.condense(given, shapes, film, flows);
      const NormalForces normal = reynolds.forces().normal;
      FlowBalance balance(s.model);
      REQUIRE(balance.evaluate(s.motion, s.history, s.u).is_inside());
      Eigen::VectorXd flow;
      Eigen::MatrixXd by_u;
      balance.find_port_flows(flow);
      balance.find_port_flows_by_u(by_u);
      const bool feeds = flows == PortFlows::included;
      CHECK(film.port_flow.size() == (feeds ? flow.size() : 0));
      if (feeds) CHECK((film.port_flow - flow - by_u.transpose() * du0).norm() < kLinear * film.port_flow.norm());
      const auto pushed = [&](const Eigen::VectorXd& force) -> Eigen::VectorXd {
        return shapes.openings.transpose() * force;
      };
      CHECK((film.Q - pushed(normal.value + normal.by_u.cwiseProduct(du0))).norm() < kLinear * film.Q.norm());
      CHECK((film.wrench - reynolds.forces().wrench_on_shell - reynolds.forces().wrench_by_u * du0).norm() <
            1e-8 * film.wrench.norm());
      for (Eigen::Index k = 0; k < answers.cols(); ++k) {
        CAPTURE(k);
        const Vector6 total = partial.col(k) + reynolds.forces().wrench_by_u * answers.col(k);
        CHECK((film.wrench_by_s.col(k) - total).norm() <= kLinear * total.norm());
        Eigen::VectorXd force = normal.by_u.cwiseProduct(answers.col(k));
        const MotionDirection& direction = all[static_cast<std::size_t>(k)];
        if (direction.g.size() > 0) force += normal.by_g.cwiseProduct(direction.g);
        CHECK((film.Q_by_s.col(k) - pushed(force)).norm() <= kLinear * pushed(force).norm());
        if (!feeds) continue;
        balance.find_port_flows_along(direction, flow);
        const Eigen::VectorXd total_flow = flow + by_u.transpose() * answers.col(k);
        CHECK((film.port_flow_by_s.col(k) - total_flow).norm() <= kLinear * total_flow.norm());
      }
      reynolds.follow(ds, shapes, du);
      CHECK((du - du0 - answers * ds).norm() < kLinear * du.norm());
    }
  }
}

// The operator, its transpose and the wrench by the gap beside derivatives along one change: at rows of lines, features
// and seals, in pockets, on pads.
TEST_CASE("GapOperator_IsTheDerivativeByTheGap") {
  for (State s : all_states()) {
    for (const bool leaks : {false, true}) {
      CAPTURE(s.name);
      CAPTURE(leaks);
      if (leaks) s.model.edge_left.kind = EdgeKind::leaking, s.model.edge_left.leakage = 0.3;
      const int n = s.model.grid.size();
      FlowBalance balance(s.model);
      REQUIRE(balance.evaluate(s.motion, s.history, s.u).is_inside());
      const Eigen::MatrixXd changes = seeded_random(n, 2, 6);
      const MotionDirection change{.g = changes.col(0), .g_rate = changes.col(1)};
      Eigen::VectorXd expected, dr;
      balance.derivative(change, expected);

      GapOperator by_gap = balance.gap_operator();
      balance.find_gap_operator(by_gap);
      by_gap.apply(change.g, change.g_rate, dr);
      CHECK((dr - expected).norm() <= 1e-14 * expected.norm());  // the same terms, summed in another order

      const PackedColumns x = seeded_random(n, Packed::width, 7);
      PackedColumns of_gap, of_rate;
      GapOperator::Scratch scratch;
      by_gap.apply_transposed(x, of_gap, of_rate, scratch);
      const Eigen::VectorXd there = x.transpose() * expected,
                            back = of_gap.transpose() * change.g + of_rate.transpose() * change.g_rate;
      CHECK((there - back).norm() <= 1e-12 * x.norm() * expected.norm());  // sums of n terms of either sign

      FilmWrench wrench(s.model);
      wrench.evaluate(balance, s.motion, true);
      Eigen::Matrix<double, 6, Eigen::Dynamic> wrench_by_gap;
      wrench.find_by_gap(wrench_by_gap);
      const Vector6 along = wrench.along(change);
      CHECK((wrench_by_gap * change.g - along).norm() <= 1e-12 * along.norm());  // likewise
    }
  }
}

TEST_CASE("NewtonIncrement_SolvesTheLinearisedFilm") {
  const State s = rough_state(Cavitation::mass_conserving, true, true);
  Reynolds reynolds(s.model);
  FlowBalance balance(s.model);
  balance.evaluate(s.motion, s.history, s.u);
  balance.assemble_jacobian();
  reynolds.linearise(s.motion, s.history, s.u);
  Eigen::VectorXd du;
  reynolds.newton_increment(du);
  // Backward stable elimination: a multiple of round-off times the size of the terms added up.
  CHECK((sparse_times(balance, du) + balance.residual()).norm() < 1e-11 * balance.residual().norm());
}

}  // namespace derivatives_test
}  // namespace hersey::film
