#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "balance/flow_balance.h"
#include "hersey/film/observables.h"
#include "rough_states.h"

// Oil that enters through the features of a film, its ports.
namespace hersey::film {
namespace port_flows_test {

using namespace rough_states;

constexpr double kSolved = 1e-5;  // films solved to 1e-13, over the change of a few 1e-5 that a difference makes

TEST_CASE("FlowsThroughPorts_AreThoseOfTheFeatures_AndTheirDerivativesMatchFiniteDifference") {
  for (const State& s : all_states()) {
    if (s.motion.feature_pressure.size() == 0) continue;
    CAPTURE(s.name);
    FlowBalance balance(s.model);
    Eigen::VectorXd flow;
    const auto flow_at = [&](const SurfaceMotion& motion, const Eigen::VectorXd& u) -> const Eigen::VectorXd& {
      REQUIRE(balance.evaluate(motion, s.history, u).is_inside());
      balance.find_port_flows(flow);
      return flow;
    };
    const auto difference = [&](const MotionDirection& direction, const Eigen::VectorXd& du) -> Eigen::VectorXd {
      const Eigen::VectorXd after = flow_at(moved(s.motion, direction, d), s.u + d * du);
      return (after - flow_at(moved(s.motion, direction, -d), s.u - d * du)) / (2 * d);
    };
    const Eigen::VectorXd du = 1e-2 * s.u.cwiseAbs().cwiseProduct(seeded_random(s.u.size(), 1, 5).col(0));
    const Eigen::VectorXd by_du = difference({}, du),
                          observed = observe_film(s.model, s.motion, s.history, {}, s.u).flow_features;
    CHECK((flow_at(s.motion, s.u) - observed).norm() <= 1e-14 * observed.norm());  // a sum in another order
    const double scale = flow.norm() + balance.balance().norm();
    Eigen::MatrixXd by_u;
    balance.find_port_flows_by_u(by_u);
    CHECK((by_u.transpose() * du - by_du).norm() < 10 * tolerance * scale);
    for (const auto& [name, direction] : directions(s)) {
      const std::string what = name;  // clang 14 captures no structured binding
      CAPTURE(what);
      const Eigen::VectorXd numeric = difference(direction, Eigen::VectorXd::Zero(s.u.size()));
      (void)flow_at(s.motion, s.u);
      Eigen::VectorXd exact;
      balance.find_port_flows_along(direction, exact);
      CHECK((exact - numeric).norm() < 10 * tolerance * scale);
    }
  }
}

// What a circuit of oil couples with: the film solved to the end at both sides of a difference.
TEST_CASE("FlowThroughAPort_FollowsItsPressureAsTheSolvedFilmDoes") {
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    CAPTURE(static_cast<int>(cavitation));
    State s = rough_state(cavitation, true, true);
    s.history.theta.setOnes();
    s.history.w.setZero();
    s.u.setZero();
    Reynolds reynolds(s.model);
    const FilmSolveOptions options{.rtol = 1e-13};
    REQUIRE(solve_film(reynolds, s.motion, s.history, options, s.u).solved());
    std::vector<MotionDirection> ports(2);
    for (std::size_t k : {0U, 1U}) ports[k].port_pressure = Eigen::Vector2d::Unit(static_cast<Eigen::Index>(k));
    REQUIRE(reynolds.linearise(s.motion, s.history, s.u).is_inside());
    CondensedFilm film;
    reynolds.condense(ports, SurfaceShapes::none(s.u.size()), film, PortFlows::included);
    const double step = 10;  // Pa of 5e5: the set of cavitated nodes does not change
    for (std::size_t k : {0U, 1U}) {
      const auto solved_at = [&](double change) {
        const SurfaceMotion motion = moved(s.motion, ports[k], change);
        Eigen::VectorXd u = s.u;
        REQUIRE(solve_film(reynolds, motion, s.history, options, u).solved());
        return std::pair<Eigen::VectorXd, Vector6>(observe_film(s.model, motion, s.history, {}, u).flow_features,
                                                   reynolds.forces().wrench_on_shell);
      };
      const auto [flow_after, wrench_after] = solved_at(step);
      const auto [flow_before, wrench_before] = solved_at(-step);
      const auto column = static_cast<Eigen::Index>(k);
      const Eigen::VectorXd flow = (flow_after - flow_before) / (2 * step);
      CHECK((film.port_flow_by_s.col(column) - flow).norm() < kSolved * flow.norm());
      const Vector6 wrench = (wrench_after - wrench_before) / (2 * step);
      CHECK((film.wrench_by_s.col(column) - wrench).norm() < kSolved * wrench.norm());
      CHECK(film.port_flow_by_s(column, column) > 0);
    }
  }
}

}  // namespace port_flows_test
}  // namespace hersey::film
