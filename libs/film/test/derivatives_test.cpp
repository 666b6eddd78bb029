#include <doctest/doctest.h>

#include <limits>
#include <random>
#include <string>

#include "balance/flow_balance.h"
#include "film_cases.h"
#include "observe/film_wrench.h"
#include "seeded_random.h"

// Every derivative against central differences: residual and wrench, with respect to the unknown and to every change of
// the surfaces, for every cavitation model, with all laws on and with each kind of boundary.
namespace hersey::film {
namespace derivatives_test {

constexpr double kLinear = 1e-8;  // multigrid answers to 1e-10; summed over nodes and directions

struct State {
  FilmModel model;
  SurfaceMotion motion;
  FilmHistory history;
  Eigen::VectorXd u;
  std::string name;
};

// A rough film: full and cavitated nodes side by side, nothing symmetric, nothing within a difference step of a switch.
State rough_state(Cavitation cavitation, bool all_laws, bool transient, const Grid& grid = {14, 6}) {
  State s;
  s.model = {.R = 0.03, .L = 0.02, .c = 20e-6, .grid = grid, .cavitation = cavitation, .p_cav = 1e4};
  s.model.edge_left.pressure = 2e5, s.model.edge_right.pressure = 3e5;
  s.model.supply = {SupplyKind::widest_gap, 0, 4e5};
  s.model.features = {{.name = "groove", .phi = 4, .arc = 0.7, .length = 0.009, .pressure = 5e5},
                      {.name = "hole",
                       .shape = Ellipse{},
                       .surface = Surface::journal,
                       .phi = 2.9,
                       .z = 1e-3,
                       .arc = 0.8,
                       .length = 0.008,
                       .pressure = 6e5}};
  if (all_laws) {
    s.model.lubricant.viscosity_law = Barus{2e-8};
    s.model.lubricant.density_law = DowsonHigginson{5e-9, 2e-9};  // ten times as soft as oil
    s.model.compliance = 5e-13;
    s.model.asperities = {AsperityModel::greenwood_tripp_exact, 4e-6, 3e-3, 57e9, 0.1};  // many nodes in contact
  }
  const Journal journal{
      .e = {9e-6, 14e-6}, .e_rate = {0.01, -0.02}, .tilt = {2e-4, -1e-4}, .omega_shell = -20, .omega_journal = 300};
  s.motion = surfaces(s.model, journal, 1.3);
  s.motion.phi_journal = -0.3;
  s.motion.w_journal = 0.4, s.motion.w_shell = -0.1;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  const int n = s.model.grid.size();
  s.motion.shell_opening.resize(n);  // as much as the gap itself
  for (int i = 0; i < n; ++i) s.motion.shell_opening[i] = 20e-6 * uniform(generator);
  s.u.resize(n);
  const double P0 = fill_scale(s.model);
  for (int i = 0; i < n; ++i)
    s.u[i] = uniform(generator) < 0.4 ? -0.5 * P0 * uniform(generator) : 2e7 * uniform(generator);
  if (transient) {
    s.history.dt = 1e-4;
    s.history.theta.resize(n), s.history.w.resize(n);
    for (int i = 0; i < n; ++i) s.history.theta[i] = uniform(generator), s.history.w[i] = 1e-6 * uniform(generator);
    s.history.density = Eigen::VectorXd::Constant(n, 1.01);
  }
  s.name = "cavitation " + std::to_string(static_cast<int>(cavitation)) + (all_laws ? ", all laws" : "") +
           (transient ? ", transient" : ", steady");
  return s;
}

State graded_state() {
  const Grid grid = graded_grid(14, 6, {{.position = 1.0, .reach = 0.6, .factor = 3}},
                                {{.position = 0.5, .reach = 0.2, .factor = 3}});
  State s = rough_state(Cavitation::mass_conserving, true, true, grid);
  s.name = "graded grid";
  return s;
}

std::vector<State> rough_states() {
  std::vector<State> states;
  for (const auto cavitation : {Cavitation::guembel, Cavitation::reynolds, Cavitation::mass_conserving}) {
    for (const bool all_laws : {false, true}) {
      for (const bool transient : {false, true}) states.push_back(rough_state(cavitation, all_laws, transient));
    }
  }
  State s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.asperities.model = AsperityModel::greenwood_tripp_fit;
  s.model.shear_force = ShearForce::torque_only;
  s.model.cavitated_shear = CavitatedShear::full;
  s.model.edge_left.kind = s.model.edge_right.kind = EdgeKind::closed;
  s.name = "closed edges, torque only, full shear";
  states.push_back(s);
  s = rough_state(Cavitation::mass_conserving, true, true);
  s.motion.u_journal *= -1, s.motion.w_journal *= -1;
  s.name = "turning backwards";
  states.push_back(s);
  states.push_back(graded_state());
  s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.edge_left.pressure = s.model.p_cav, s.model.edge_right.pressure = s.model.p_cav;
  s.model.edge_left.ambient_fill = 0.8, s.model.edge_right.ambient_fill = 1;
  s.name = "edges in oil mist and in oil";
  states.push_back(s);
  for (const bool transient : {false, true}) {
    s = rough_state(Cavitation::mass_conserving, true, transient);
    for (int i = 0; i < s.model.grid.n_phi; ++i) {
      const bool is_wide = i % 4 < 2;  // what is fitted through the nodes would cross zero between two narrow ones
      s.motion.g.segment(s.model.grid.index(i, 0), s.model.grid.n_z) *= is_wide ? 30 : 1;
    }
    s.name = std::string("gap that jumps from line to line") + (transient ? ", transient" : ", steady");
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.motion.phi_supply = 1.5;  // within a cell, away from its middle
    s.name = "line between nodes";
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.model.roughness = {FlowFactors::patir_cheng, {3e-6, 0.2}, {5e-6, 4}};  // from contact to full film
    s.name = std::string("flow factors") + (transient ? ", transient" : ", steady");
    states.push_back(s);
    if (!transient) continue;
    s.history.w.resize(0);
    s.name = "flow factors, liner at rest";
    states.push_back(s);
    s.model.roughness = {};
    s.name = "liner at rest";
    states.push_back(s);
  }
  return states;
}

// Oils that thin by the sliding of surfaces that slide slantwise: by a critical rate, and by a critical stress, which
// pressure raises.
std::vector<State> sheared_states() {
  std::vector<State> states;
  for (State s : {rough_state(Cavitation::mass_conserving, true, true), rough_state(Cavitation::guembel, true, false),
                  rough_state(Cavitation::reynolds, false, false)}) {
    s.motion.phi_supply = 1.5;
    s.motion.w_journal = 4;
    s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
    s.name += ", Cross by rate";
    states.push_back(s);
    s.model.lubricant.shear_thinning = {Carreau{.limit = 0.2, .exponent = 0.4, .transition = 1.3}, 0, 4e3};
    s.model.roughness = {FlowFactors::patir_cheng, {3e-6, 0.2}, {5e-6, 4}};
    s.name += "; Carreau by stress, flow factors";
    states.push_back(s);
  }
  State s = rough_state(Cavitation::mass_conserving, true, true);
  s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
  s.model.asperities.mu_friction = 0;  // changes its direction within less than a difference step
  s.motion.u_shell = s.motion.u_journal - 0.2, s.motion.w_journal = s.motion.w_shell;
  s.name = "hardly any sliding";
  states.push_back(s);
  return states;
}

// Depth on both surfaces, one over the other in part.
std::vector<State> states_with_pockets() {
  std::vector<State> states;
  for (const bool transient : {false, true}) {
    for (const bool backwards : {false, true}) {
      State s = rough_state(Cavitation::mass_conserving, true, transient);
      s.model.features = {
          {.name = "shell's", .phi = 1.1, .z = 2e-3, .arc = 1.3, .length = 0.008, .is_fed = false, .depth = 3e-5},
          {.name = "journal's",
           .shape = Ellipse{},
           .surface = Surface::journal,
           .phi = 2.1,
           .z = -1e-3,
           .arc = 1.2,
           .length = 0.011,
           .is_fed = false,
           .depth = 8e-5},
          {.name = "slot",
           .surface = Surface::journal,
           .phi = 4.6,
           .arc = 0.7,
           .length = 0.013,
           .is_fed = false,
           .depth = 2e-5}};
      s.motion.u_shell = 0;
      if (backwards) s.motion.u_journal *= -1;
      s.history.phi_journal = backwards ? -0.27 : -0.33;
      s.name = std::string("pockets") + (transient ? ", transient" : ", steady") + (backwards ? ", backwards" : "");
      states.push_back(s);
      for (const double line : {1.5, 2.3, 4.85}) {  // through each of them, within cells; 1.5: through two
        State crossed = s;
        crossed.motion.phi_supply = line;
        crossed.name += ", line at " + std::to_string(line);
        states.push_back(crossed);
      }
      if (!transient) continue;
      s.model.roughness = {FlowFactors::patir_cheng, {1e-6, 0.2}, {2e-6, 4}};
      s.name += ", rough";
      s.motion.phi_supply = 1.5;
      states.push_back(s);
      s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 0, 4e3};
      s.name += ", sheared";
      states.push_back(s);
    }
  }
  return states;
}

// Pads of a bore, with an edge in air among their ends; an annulus, on which speeds grow with the radius; and a plane.
std::vector<State> states_on_surfaces() {
  std::vector<State> states;
  for (const bool transient : {false, true}) {
    const Grid pads = patch_grid({{.from = 0.3, .to = 2.5, .lines = 7}, {.from = 2.6, .to = 5.8, .lines = 8}}, 6);
    State s = rough_state(Cavitation::mass_conserving, true, transient, pads);
    s.model.supply.kind = SupplyKind::none;
    s.model.ends = {{.first = {.pressure = 4e5}, .last = {.pressure = 1e4, .ambient_fill = 0.7}},
                    {.first = {.kind = EdgeKind::closed}, .last = {.pressure = 2e5}}};
    s.name = "pads";
    states.push_back(s);
    // The gap is wide there, because the interpolation through the nodes would cross zero beside the ends.
    for (const int line : {2, 4, 9, 12}) s.motion.g.segment(s.model.grid.index(line, 0), s.model.grid.n_z) *= 40;
    s.name = "pads, gap that jumps";
    states.push_back(s);
    s.motion = rough_state(Cavitation::mass_conserving, true, transient, pads).motion;
    s.motion.u_shell = 0;
    s.history.phi_journal = -0.33;
    s.model.features = {{.name = "slot",
                         .surface = Surface::journal,
                         .phi = 4.6,
                         .arc = 0.7,
                         .length = 0.013,
                         .is_fed = false,
                         .depth = 2e-5}};
    s.name = "pads, pocket that travels";
    states.push_back(s);
    for (State pockets : states_with_pockets()) {
      if ((pockets.history.dt > 0) != transient || pockets.motion.phi_supply != 1.3) continue;
      pockets.model.surface = Annulus{};
      pockets.motion.shell_opening.resize(0);
      pockets.name += ", annulus";
      states.push_back(pockets);
    }
    s = rough_state(Cavitation::mass_conserving, true, transient);
    s.model.surface = Annulus{};
    s.model.lubricant.shear_thinning = {Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
    s.motion.shell_opening.resize(0);
    s.motion.phi_supply = 1.5, s.motion.w_journal = 4;
    s.name = "annulus, sheared";
    states.push_back(s);
    s = rough_state(Cavitation::mass_conserving, true, transient, pads);
    s.model.surface = Plane{};
    s.model.supply.kind = SupplyKind::none;
    s.model.ends.resize(2);
    for (PatchEnds& ends : s.model.ends) ends.first.pressure = ends.last.pressure = s.model.p_cav;
    s.motion.shell_opening.resize(0);
    s.name = "plane";
    states.push_back(s);
  }
  for (State& s : states) s.name += s.history.dt > 0 ? ", transient" : ", steady";
  return states;
}

std::vector<State> all_states() {
  std::vector<State> states = rough_states();
  for (const State& s : states_on_surfaces()) states.push_back(s);
  for (const State& s : states_with_pockets()) states.push_back(s);
  for (const State& s : sheared_states()) states.push_back(s);
  return states;
}

// The error of a central difference with relative step d is d^2 times third derivatives (the laws bend over about a
// tenth of a state) plus round-off over d.
constexpr double d = 1e-5;
constexpr double tolerance = 1e3 * d * d + 10 * std::numeric_limits<double>::epsilon() / d;

SurfaceMotion moved(const SurfaceMotion& motion, const MotionDirection& direction, double step) {
  SurfaceMotion m = motion;
  if (direction.g.size()) m.g += step * direction.g;
  if (direction.shell_share != 0) m.shell_opening += step * direction.shell_share * direction.g;
  if (direction.g_rate.size()) m.g_rate += step * direction.g_rate;
  m.u_shell += step * direction.u_shell;
  m.u_journal += step * direction.u_journal;
  m.w_shell += step * direction.w_shell;
  m.w_journal += step * direction.w_journal;
  m.phi_supply += step * direction.phi_supply;
  m.phi_journal += step * direction.phi_journal;
  return m;
}

// One direction per kind of change, each of the size of the quantity it changes.
std::vector<std::pair<std::string, MotionDirection>> directions(const State& s) {
  const Eigen::VectorXd random = seeded_random(s.model.grid.size(), 1, 3);
  const double speed = s.model.R * 300;
  std::vector<std::pair<std::string, MotionDirection>> all{
      {"gap", {.g = 1e-6 * random, .g_rate = {}}},
      {"gap rate", {.g = {}, .g_rate = 0.02 * random}},
      {"u_shell", {.g = {}, .g_rate = {}, .u_shell = speed}},
      {"u_journal", {.g = {}, .g_rate = {}, .u_journal = speed}},
      {"w_shell", {.g = {}, .g_rate = {}, .w_shell = speed}},
      {"w_journal", {.g = {}, .g_rate = {}, .w_journal = speed}},
      {"phi_journal", {.g = {}, .g_rate = {}, .phi_journal = 0.1}}};
  if (s.motion.shell_opening.size() != 0)
    all.push_back({"gap by the shell's surface", {.g = 1e-6 * random, .g_rate = {}, .shell_share = 1}});
  if (s.model.supply.kind != SupplyKind::none)
    all.push_back({"phi_supply", {.g = {}, .g_rate = {}, .phi_supply = 0.1}});
  return all;
}

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

TEST_CASE("CondensedFilm_IsThatOfItsResponses") {
  const State s = rough_state(Cavitation::mass_conserving, true, true);
  std::vector<MotionDirection> all;
  for (const auto& [what, direction] : directions(s)) all.push_back(direction);
  Eigen::VectorXd du0, du;
  Eigen::MatrixXd answers;
  Eigen::Matrix<double, 6, Eigen::Dynamic> partial;
  CondensedFilm film;
  const Eigen::MatrixXd openings = seeded_random(s.model.grid.size(), 3, 4);
  const Eigen::VectorXd ds = 1e-7 * Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(all.size()), 1, 2);
  for (const auto linear : {LinearSolver::direct, LinearSolver::multigrid}) {
    CAPTURE(static_cast<int>(linear));
    Reynolds reynolds(s.model, linear);
    reynolds.linearise(s.motion, s.history, s.u);
    reynolds.newton_increment(du0);
    respond(reynolds, all, answers, partial);
    reynolds.condense(all, openings, film);
    const NormalForces normal = reynolds.forces().normal;
    const auto pushed = [&](const Eigen::VectorXd& force) -> Eigen::VectorXd { return openings.transpose() * force; };
    CHECK((film.Q - pushed(normal.value + normal.by_u.cwiseProduct(du0))).norm() < kLinear * film.Q.norm());
    CHECK((film.wrench - reynolds.forces().wrench_on_shell - reynolds.forces().wrench_by_u * du0).norm() <
          1e-8 * film.wrench.norm());
    for (Eigen::Index k = 0; k < answers.cols(); ++k) {
      const Vector6 total = partial.col(k) + reynolds.forces().wrench_by_u * answers.col(k);
      CHECK((film.wrench_ds.col(k) - total).norm() <= kLinear * total.norm());
      Eigen::VectorXd force = normal.by_u.cwiseProduct(answers.col(k));
      const MotionDirection& direction = all[static_cast<std::size_t>(k)];
      if (direction.g.size() > 0) force += normal.by_g.cwiseProduct(direction.g);
      CHECK((film.Q_ds.col(k) - pushed(force)).norm() <= kLinear * pushed(force).norm());
    }
    reynolds.follow(ds, du);
    CHECK((du - du0 - answers * ds).norm() < kLinear * du.norm());
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
