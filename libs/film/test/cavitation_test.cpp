#include <doctest/doctest.h>

#include <array>

#include "film_cases.h"
#include "relative.h"

// Conservation of oil: the film's own balances, and cavitation that appears and disappears.
namespace hersey::film {
namespace cavitation_test {

constexpr double kSolved = 1e-9;  // the solver leaves 1e-10 of the largest throughput per node

FilmModel bearing(int n_phi = 60, int n_z = 13) {
  FilmModel m{.R = 0.0225, .L = 0.0156, .c = 34e-6, .grid = {n_phi, n_z}};
  m.supply = {SupplyKind::widest_gap, 0, 0};
  return m;
}

constexpr double omega = 374;

TEST_CASE("FloodedEdgesWithoutSupply_HaveNoNetSideFlow") {
  FilmModel m = bearing();
  m.supply = {};
  m.p_cav = 0;
  m.edge_left.pressure = m.edge_right.pressure = 1e5;
  const SolvedFilm film = solve_cold(m, turning(m, 0.6, omega));
  REQUIRE(film.summary.solved());
  CHECK(film.observed.p_max > 1e6);
  CHECK(film.observed.cavitated_share > 0.1);
  // The solver leaves 1e-10 of the largest throughput per node.
  const double scale = m.R * omega * m.c * m.L;
  CHECK(std::abs(film.observed.flow_left + film.observed.flow_right) < kSolved * scale);
  CHECK(film.observed.flow_left == doctest::Approx(film.observed.flow_right).epsilon(kSolved).scale(scale));
}

TEST_CASE("FilmWithoutAnySupply_Starves") {
  FilmModel m = bearing();
  m.supply = {};
  const SolvedFilm film = solve_cold(m, turning(m, 0.6, omega));
  CHECK(film.summary.solved());
  CHECK(film.summary.message.find("supply") != std::string::npos);
  CHECK(film.observed.p_max < 1e-6);                  // Pa: no pressure at all
  CHECK(film.observed.force_pressure.norm() < 1e-6);  // N; with supply this bearing carries 456 N
  CHECK(film.fields.theta.maxCoeff() <= 1 + 1e-12);   // round-off
  CHECK(film.fields.theta.minCoeff() >= 0);
}

TEST_CASE("SteadyFilm_BalancesItsOil") {
  for (const double e : {0.1, 0.5, 0.9, 0.98}) {
    CAPTURE(e);
    FilmModel m = bearing();
    m.edge_right.pressure = 2e5;  // from right to left through the bearing, one edge flooded and one in air
    m.supply.pressure = 3e5;
    const SolvedFilm film = solve_cold(m, surfaces(m, turning(m, e, omega), 0.03), {-e * m.c, 0});
    REQUIRE(film.summary.solved());
    CHECK(film.observed.flow_left > 0);
    CHECK(film.observed.flow_supply > 0);
    CHECK(film.observed.mass_balance_error < 1e-9);  // residual of the solver, summed
  }
}

// A time step conserves the oil it started with exactly if the gap's rate is that of the step itself.
TEST_CASE("TimeSteps_ConserveOil") {
  FilmModel m = bearing();
  m.compliance = 4e-13;
  const double dt = 2e-4;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Journal journal = turning(m, 0.5, omega);
  SurfaceMotion before = surfaces(m, journal);
  REQUIRE(solve_film(reynolds, before, {}, {}, u).solved());
  for (int step = 1; step <= 20; ++step) {
    const FilmFields fields = film_fields(m, before, u);
    const FilmHistory history{dt, fields.theta, fields.w};
    const double volume_before = observe_film(m, before, {}, journal.e, u).oil_volume;
    journal.e = 0.5 * m.c * Eigen::Vector2d(-std::cos(0.1 * step), 0.8 * std::sin(0.1 * step));
    SurfaceMotion motion = surfaces(m, journal);
    motion.g_rate = (motion.g - before.g) / dt;
    const FilmSolveSummary summary = solve_film(reynolds, motion, history, {}, u);
    REQUIRE(summary.solved());
    CHECK(summary.iterations <= 8);
    const FilmObservables o = observe_film(m, motion, history, journal.e, u);
    const double change = (o.oil_volume - volume_before) / dt;
    const double scale = m.R * omega * m.c * m.L;
    // This is the error of a step, summed over nodes for which the solver leaves 1e-10 of the largest throughput.
    CHECK(std::abs(o.flow_supply - o.flow_left - o.flow_right - change) < 1e-8 * scale);
    CHECK(o.mass_balance_error < 1e-8);
    before = motion;
  }
}

// Pure squeeze with cavitation that opens and closes again (Ausas, Jai and Buscaglia 2009): plates of length 1 with
// h(t) = 0.125 cos(4 pi t) + 0.375 and p = 0.025 at both ends, d/dx(h^3 p_x) = 2 d(theta h)/dt. As the film cavitates,
// its front W has p = p_x = 0, so that W^2 = 0.025 h^3/h'. From the turning point on oil flows past it, (1 - theta) h
// W' = (0.025 h^3/W - h' W)/2, where theta h is what stayed behind as the front passed on its way in.
class SqueezeFront {
 public:
  static double gap(double t) { return 0.125 * std::cos(4 * pi * t) + 0.375; }
  static double gap_rate(double t) { return -0.5 * pi * std::sin(4 * pi * t); }
  static double breaking(double t) { return std::sqrt(0.025 * std::pow(gap(t), 3) / gap_rate(t)); }

  SqueezeFront() {
    turning_ = crossing(0.26, 0.34, [](double t) { return 3 * std::pow(gap_rate(t), 2) - gap(t) * gap_curvature(t); });
    start_ = crossing(0.2500001, turning_, [](double t) { return breaking(t) - 0.5; });
    // Just behind the turning point the front comes back on a parabola a quarter as steep as that on which it went.
    const double first = 1e-4, rise = breaking(turning_ + first) - breaking(turning_);
    width_.push_back(breaking(turning_) + 0.25 * rise);
    const auto next = [&](double t, double W) { return returning(t, W); };
    for (double t = turning_ + first; t < 0.65; t += step_) {
      const double W = width_.back(), k1 = next(t, W), k2 = next(t + step_ / 2, W + step_ / 2 * k1);
      const double k3 = next(t + step_ / 2, W + step_ / 2 * k2), k4 = next(t + step_, W + step_ * k3);
      width_.push_back(W + step_ / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
    }
    first_ = turning_ + first;
  }
  [[nodiscard]] double start() const { return start_; }
  [[nodiscard]] double turning() const { return turning_; }
  [[nodiscard]] double at(double t) const {
    if (t < start_) return 0.5;
    if (t < turning_) return breaking(t);
    const double position = std::max(0.0, (t - first_) / step_), k = std::floor(position);
    const auto i = static_cast<std::size_t>(k);
    return width_[i] + (position - k) * (width_[i + 1] - width_[i]);
  }

 private:
  static double gap_curvature(double t) { return -2 * pi * pi * std::cos(4 * pi * t); }
  // Returns the root of a function that falls through zero.
  template <class Function>
  static double crossing(double low, double high, Function f) {
    const bool falls = f(low) > 0;
    for (int k = 0; k < 60; ++k) ((f(0.5 * (low + high)) > 0) == falls ? low : high) = 0.5 * (low + high);
    return low;
  }
  [[nodiscard]] double returning(double t, double W) const {
    const double passed = crossing(start_, turning_, [W](double s) { return breaking(s) - W; });
    return 0.5 * (0.025 * std::pow(gap(t), 3) / W - gap_rate(t) * W) / (gap(t) - gap(passed));
  }

  static constexpr double step_ = 1e-4;
  double start_ = 0, turning_ = 0, first_ = 0;
  std::vector<double> width_;  ///< from first_ on, in steps of step_
};

struct Squeeze {
  double start = 0, narrowest = 1;  // time at which cavitation starts, smallest width of the full film
  double front_error = 0;           // largest of all steps, over one cell and what the front moves in one step
  double late_error = 0;            // of the front at t = 0.5, long after it turned
  double oil_error = 0;             // largest of all steps, over the oil in the gap
};

Squeeze squeeze(int n, double dt, const SqueezeFront& exact) {
  FilmModel m{.R = 1 / (2 * pi), .L = 0.1, .c = 0.4, .grid = {n, 3}, .lubricant = {.mu0 = 1.0 / 6}};
  m.supply = {SupplyKind::fixed_angle, 0, 0.025};
  m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
  Reynolds reynolds(m);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  FilmHistory history{dt, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
  Squeeze s;
  double volume = SqueezeFront::gap(0) * m.L;
  for (int step = 1; step * dt < 0.6; ++step) {
    const double t = step * dt;
    SurfaceMotion motion = surfaces(m, {});
    motion.g.setConstant(SqueezeFront::gap(t));
    motion.g_rate.setConstant((SqueezeFront::gap(t) - SqueezeFront::gap(t - dt)) / dt);
    REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
    const FilmObservables o = observe_film(m, motion, history, {0, 0}, u);
    s.oil_error = std::max(s.oil_error, std::abs(o.oil_volume - volume - dt * o.flow_supply) / volume);
    volume = o.oil_volume;
    history.theta = film_fields(m, motion, u).theta;
    const auto theta = [&](int i) { return history.theta[m.grid.index(i, 1)]; };
    int full = 0;  // nodes of full film from one end on
    while (full < n / 2 && theta(full) >= 1) ++full;
    // The front lies in the first node that is not full; its fill fraction gives the position.
    double width = 0.5;
    if (full < n / 2) {
      if (s.start == 0) s.start = t;
      const double next = theta(full + 1), fraction = std::max(0.0, (theta(full) - next) / (1 - next));
      width = (full - 0.5 + fraction) / n;
    }
    s.narrowest = std::min(s.narrowest, width);
    const double error = std::abs(width - exact.at(t));
    const double moved = std::max(std::abs(exact.at(t) - exact.at(t - dt)), std::abs(exact.at(t + dt) - exact.at(t)));
    s.front_error = std::max(s.front_error, error / (1.0 / n + moved));
    if (std::abs(t - 0.5) < 0.5 * dt) s.late_error = width - exact.at(t);
  }
  return s;
}

TEST_CASE("SqueezedFilm_CavitatesAndReforms") {
  const SqueezeFront exact;
  // Seven digits.
  CHECK(std::abs(exact.start() - 0.2500792) < 1e-7);
  CHECK(std::abs(exact.turning() - 0.3148259) < 1e-7);
  CHECK(std::abs(exact.at(exact.turning()) - 0.0230077) < 1e-7);
  std::array<double, 3> late{};
  for (int k = 0; k < 3; ++k) {
    const int n = std::array{200, 280, 400}[k];
    CAPTURE(n);
    const double dt = 0.4 / n, dx = 1.0 / n;
    const Squeeze s = squeeze(n, dt, exact);
    late[k] = s.late_error;
    CHECK(s.start >= 0.2500792);
    CHECK(s.start <= 0.2500792 + dt);
    CHECK(std::abs(s.narrowest - 0.0230077) <= dx);
    CHECK(s.front_error <= 1);
    CHECK(s.oil_error < 1e-10);  // the solver's residual, summed over the steps
  }
  // Backward Euler and upwind transport: order one as both step and cell become half.
  CHECK(std::log2(late[0] / late[2]) == doctest::Approx(1).epsilon(0.1));
}

// Oil carried around in a gap that is nowhere full: the fill fraction travels at half the journal's speed.
TEST_CASE("CarriedFill_IsOfFirstOrder") {
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) {
    const int n = 100 << k;
    FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {n, 3}};
    m.edge_left.kind = m.edge_right.kind = EdgeKind::closed;
    const SurfaceMotion motion = surfaces(m, {.omega_journal = 100});
    const double dt = 0.02 / n;  // a third of a cell
    const auto fill = [](double phi) { return 0.6 + 0.2 * std::sin(phi); };
    FilmHistory history{dt, Eigen::VectorXd::Zero(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
    for (int i = 0; i < n; ++i) history.theta.segment(m.grid.index(i, 0), 3).setConstant(fill(2 * pi * i / n));
    Reynolds reynolds(m);
    Eigen::VectorXd u = fill_scale(m) * (history.theta.array() - 1).matrix();
    for (int step = 0; step < 2 * n; ++step) {
      REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
      history.theta = film_fields(m, motion, u).theta;
    }
    const double turned = 0.5 * 100 * 2 * n * dt;
    for (int i = 0; i < n; ++i) {
      const double exact = fill(2 * pi * i / n - turned);
      error[k] = std::max(error[k], std::abs(history.theta[m.grid.index(i, 1)] - exact));
    }
  }
  CHECK(error[1] < 0.02);
  CHECK(std::log2(error[0] / error[1]) == doctest::Approx(1).epsilon(0.05));
}

// The film of an edge at p_cav draws in the oil of its surroundings. Oil outside (fill 1) is the limit of a flooded
// edge whose pressure falls to p_cav, air (fill 0) gives nothing.
TEST_CASE("AmbientFill_IsDrawnIn") {
  FilmModel m = bearing();
  m.p_cav = -0.5e5;
  const auto solved = [&](double p_edge, double fill, FilmSolver solver = FilmSolver::newton) {
    FilmModel other = m;
    other.edge_left.pressure = other.edge_right.pressure = p_edge;
    other.edge_left.ambient_fill = other.edge_right.ambient_fill = fill;
    other.supply.pressure = m.p_cav;
    const SolvedFilm film = solve_cold(other, turning(other, 0.6, omega), {.solver = solver, .rtol = 1e-10});
    REQUIRE(film.summary.solved());
    CHECK(film.observed.mass_balance_error < kSolved);
    return film;
  };
  const SolvedFilm flooded = solved(m.p_cav + 1e-3, 0), oil = solved(m.p_cav, 1);
  // An edge 1e-3 Pa above p_cav.
  CHECK((flooded.wrench - oil.wrench).norm() < 1e-6 * oil.wrench.norm());
  // Side flows are apart by 1.2e-3 of themselves: beside the cavitated film both edges are not quite alike.
  CHECK(flooded.observed.flow_left == relative(oil.observed.flow_left).epsilon(2e-3));
  CHECK(oil.fields.theta[m.grid.index(45, 0)] == 1);  // where the film is cavitated inside

  const SolvedFilm air = solved(m.p_cav, 0), mist = solved(m.p_cav, 0.9);
  double least_air = 1, least_mist = 1;
  for (int i = 0; i < m.grid.n_phi; ++i) {
    least_air = std::min(least_air, air.fields.theta[m.grid.index(i, 0)]);
    least_mist = std::min(least_mist, mist.fields.theta[m.grid.index(i, 0)]);
  }
  CHECK(least_air < 0.9);
  CHECK(least_mist == 0.9);
  // The more comes in beside the cavitated film, the less leaves in all.
  CHECK(air.observed.flow_left > 1.001 * mist.observed.flow_left);
  CHECK(mist.observed.flow_left > 1.001 * oil.observed.flow_left);
  const SolvedFilm sor = solved(m.p_cav, 0.9, FilmSolver::sor);
  // SOR ends at 1e-10, which weak spots of the film amplify.
  CHECK((sor.wrench - mist.wrench).norm() < 1e-6 * mist.wrench.norm());
  CHECK(sor.observed.flow_left == relative(mist.observed.flow_left).epsilon(1e-6));
}

// Oil around the edges at p_cav has nothing that would drive it in: without a supply the film starves all the same.
TEST_CASE("FilmInOilAtTheCavitationPressure_Starves") {
  FilmModel m = bearing();
  m.supply = {};
  m.edge_left.ambient_fill = m.edge_right.ambient_fill = 1;
  const SolvedFilm film = solve_cold(m, turning(m, 0.6, omega));
  CHECK(film.summary.solved());
  CHECK(film.summary.message.find("supply") != std::string::npos);
  CHECK(film.observed.p_max < 1e-6);  // Pa: no pressure at all
}

// Plates that part suck in what lies around them, as far as the film is emptier than that.
TEST_CASE("PartingPlates_DrawInTheAmbient") {
  FilmModel m{.R = 0.03, .L = 0.01, .c = 30e-6, .grid = {8, 9}};
  const double dt = 1e-3, h = 20e-6;
  for (const double fill : {0.0, 0.4, 0.8}) {
    CAPTURE(fill);
    m.edge_left.ambient_fill = fill;
    Reynolds reynolds(m);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
    FilmHistory history{dt, Eigen::VectorXd::Ones(m.grid.size()), Eigen::VectorXd::Zero(m.grid.size())};
    SurfaceMotion motion = surfaces(m, {});
    motion.g.setConstant(2 * h), motion.g_rate.setConstant(h / dt);  // from h to 2 h in one step: half full
    REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
    const FilmFields fields = film_fields(m, motion, u);
    const double edge = std::max(0.5, fill);
    CHECK(fields.theta[m.grid.index(3, 0)] == doctest::Approx(edge).epsilon(kSolved));
    CHECK(fields.theta[m.grid.index(3, 1)] == doctest::Approx(0.5).epsilon(kSolved));
    CHECK(fields.theta[m.grid.index(3, 8)] == doctest::Approx(0.5).epsilon(kSolved));
    const FilmObservables o = observe_film(m, motion, history, {0, 0}, u);
    const double half_row = 2 * pi * m.R * m.L / 16;
    CHECK(o.flow_left ==
          doctest::Approx(-(edge - 0.5) * 2 * h * half_row / dt).epsilon(kSolved).scale(h * half_row / dt));
    CHECK(std::abs(o.storage_rate + o.flow_left + o.flow_right) < kSolved * h * half_row / dt);
  }
}

// The film must not notice where the line lies between two nodes, nor lack oil there.
TEST_CASE("SupplyLine_WorksBetweenNodes") {
  const FilmModel m = bearing();
  const double e = 0.6, cell = 2 * pi / m.grid.n_phi;
  const double on_node = solve_cold(m, turning(m, e, omega)).wrench.segment<2>(3).norm();
  for (const double part : {0.05, 0.3, 0.5, 0.8}) {
    CAPTURE(part);
    const double angle = part * cell;
    const Journal journal{.e = -e * m.c * Eigen::Vector2d(std::cos(angle), std::sin(angle)), .omega_journal = omega};
    const SolvedFilm film = solve_cold(m, surfaces(m, journal, angle), journal.e);
    REQUIRE(film.summary.solved());
    CHECK(film.wrench.segment<2>(3).norm() == doctest::Approx(on_node).epsilon(0.5 * cell * cell));
    CHECK(film.fields.theta[m.grid.index(1, 6)] > 0.998);               // the first node downstream
    CHECK(film.fields.theta[m.grid.index(m.grid.n_phi - 1, 6)] < 0.9);  // upstream the film is cavitated
  }
}

TEST_CASE("FillScale_HasNoInfluence") {
  // The clearance only scales unknowns: with twice its value P0 is a quarter, the film the same.
  FilmModel m = bearing();
  const SurfaceMotion motion = surfaces(m, turning(m, 0.7, omega));
  const SolvedFilm film = solve_cold(m, motion, {0, 0});
  m.c *= 2;
  const SolvedFilm other = solve_cold(m, motion, {0, 0});
  CHECK((film.wrench - other.wrench).norm() < kSolved * film.wrench.norm());
  CHECK((film.fields.theta - other.fields.theta).cwiseAbs().maxCoeff() < kSolved);
}

}  // namespace cavitation_test
}  // namespace hersey::film
