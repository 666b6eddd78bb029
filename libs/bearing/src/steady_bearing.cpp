#include "hersey/bearing/steady_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/core/contract.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {
namespace {

// exp(20) = 5e8 times the viscosity: no oil, and far from overflow.
constexpr double kLargestExponent = 20;

// One Newton step may use up this share of the smallest gap of rigid surfaces, or of the film between elastic ones.
constexpr double kLargestApproach = 0.7;

// Fractions of the load below which raising it is given up.
constexpr double kSmallestLoadStep = 1e-3;

using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

ParameterVector parameters_of(const film::FilmModel& model, const OperatingPoint& point, const Eigen::Vector2d& e) {
  ParameterVector parameters = ParameterVector::Zero();
  parameters.segment<2>(kEx) = e;
  parameters.segment<2>(kTx) = point.tilt;
  parameters[kJournalSpeed] = model.R * point.journal_speed;
  parameters[kSupplyAngle] = e.squaredNorm() > 0 ? std::atan2(-e.y(), -e.x()) : 0.0;
  return parameters;
}

// Film and position of one bearing, and the Newton iterations that bring them together.
class Search {
 public:
  Search(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options)
      : model_(model), point_(point), options_(options), reynolds_(model) {
    u_ = Eigen::VectorXd::Zero(model.grid.size());
    film_options_.rtol = options.rtol;
    for (int k = 0; k <= kTyRate; ++k) directions_.push_back(surface_direction(model, k));
  }

  // The film at `e`, from the film there is.
  [[nodiscard]] bool film_at(const Eigen::Vector2d& e) {
    e_ = e;
    motion_ = steady_surfaces(model_, point_, e);
    const film::FilmSolveSummary solved = film::solve_film(reynolds_, motion_, history_, film_options_, u_);
    summary_.iterations += solved.iterations;
    summary_.message = solved.message;
    if (solved.converged) linearise();
    return solved.converged;
  }

  [[nodiscard]] SteadySummary at_given_position() {
    summary_.converged = film_at(point_.e);
    if (summary_.converged) u_ += du0_;  // beyond the tolerance: derivatives and differences then agree
    return summary_;
  }

  [[nodiscard]] SteadySummary under_load() {
    const Eigen::Vector2d start = options_.start.value_or(ocvirk_position(model_, point_));
    if (!film_at(start)) return summary_;
    if (bears_nothing()) {
      summary_.message =
          "the film bears no load: it has no pressure anywhere. Where edges at the cavitation pressure "
          "and no supply let no oil in, there is no other film";
      return summary_;
    }
    if (!together() && !raise_load(start)) {
      summary_.message =
          fmt::format("no equilibrium found: force off by {:.2g} of the load at eccentricity ratio {:.4f}",
                      summary_.force_error, e_.norm() / model_.c);
      return summary_;
    }
    summary_.converged = true;
    summary_.message.clear();
    return summary_;
  }

  // Derivatives at the film found: one solve with eight right-hand sides on the factor of the last linearisation.
  [[nodiscard]] DynamicCoefficients coefficients() {
    Eigen::MatrixXd du;
    Columns dW;
    respond(8, du, dW);
    DynamicCoefficients result;
    const auto generalised = [](const Columns& wrench) {
      Eigen::Matrix4d rows;
      rows << wrench.row(3), wrench.row(4), wrench.row(1), -wrench.row(0);
      return rows;
    };
    result.stiffness = generalised(dW.leftCols<4>());
    result.damping = generalised(dW.rightCols<4>());
    return result;
  }

  [[nodiscard]] SteadyState state() {
    SteadyState state;
    state.point = point_;
    state.e = e_;
    state.u = u_;
    state.film = film::observe_film(model_, motion_, history_, e_, u_);
    state.load = state.film.wrench_on_shell.segment<2>(3);
    state.coefficients = coefficients();
    return state;
  }

 private:
  [[nodiscard]] bool bears_nothing() const {
    const film::FilmFields fields = film::film_fields(model_, motion_, u_);
    const double scale = model_.lubricant.mu0 * std::abs(point_.entraining_speed()) * std::pow(model_.R / model_.c, 2);
    return fields.p.maxCoeff() - fields.p.minCoeff() <= 1e-9 * scale &&
           model_.asperities.model == film::AsperityModel::none;
  }

  void linearise() {
    reynolds_.linearise(motion_, history_, u_);
    reynolds_.newton_increment(du0_);
    force_ = (reynolds_.wrench_on_shell() + reynolds_.wrench_gradient(du0_)).segment<2>(3);
    ++summary_.iterations;
  }

  // Answers du and dW (total derivatives) to the first `count` directions; a supply at the widest gap follows e.
  void respond(int count, Eigen::MatrixXd& du, Columns& dW) {
    std::vector<film::MotionDirection> wanted(directions_.begin(), directions_.begin() + count);
    if (model_.supply.kind == film::SupplyKind::widest_gap && e_.norm() > 1e-6 * model_.c) {
      wanted[kEx].phi_supply = -e_.y() / e_.squaredNorm();
      wanted[kEy].phi_supply = e_.x() / e_.squaredNorm();
    }
    reynolds_.responses(wanted, du, dW);
    for (Eigen::Index k = 0; k < count; ++k) dW.col(k) += reynolds_.wrench_gradient(du.col(k));
  }

  [[nodiscard]] double error_of(const Eigen::Vector2d& target) const {
    return (force_ - target).norm() / point_.load->norm();
  }

  // The step in position of Newton's method at the present linearisation, short enough for the gap.
  [[nodiscard]] Eigen::Vector2d position_step(const Eigen::Vector2d& target) {
    Columns dW;
    respond(2, du_de_, dW);
    const Eigen::Matrix2d K = dW.block<2, 2>(3, 0);
    const Eigen::Vector2d de = K.fullPivLu().solve(target - force_);
    if (!de.allFinite()) return Eigen::Vector2d::Zero();
    double share = std::min(1.0, 0.5 * model_.c / std::max(de.norm(), 1e-300));
    const double h_min = film::film_fields(model_, motion_, u_).h.minCoeff();
    const double room = model_.compliance > 0 ? std::max(gap_at(e_), h_min) : gap_at(e_);
    // Rigid surfaces: the gap itself may not close. Elastic ones yield; a step of many film thicknesses is still too
    // long for a linear film.
    const auto approach = [&](double s) { return gap_at(e_) - gap_at(e_ + s * de); };
    while (share > 1e-12 && approach(share) > kLargestApproach * room) share *= 0.5;
    return share * de;
  }

  [[nodiscard]] double gap_at(const Eigen::Vector2d& e) const {
    return smallest_gap(model_, parameters_of(model_, point_, e));
  }

  [[nodiscard]] bool is_sensible(const Eigen::VectorXd& u) const {
    const double largest = u.maxCoeff();
    if (!u.allFinite() || film::log_viscosity_ratio(model_.lubricant, largest).value > kLargestExponent) return false;
    return gap_at(e_) > 0 || film::film_fields(model_, motion_, u).h.minCoeff() > 0;
  }

  [[nodiscard]] bool settled(const Eigen::Vector2d& target) {
    summary_.force_error = error_of(target);
    if (summary_.force_error > options_.rtol || reynolds_.relative_residual() > options_.rtol) return false;
    u_ += du0_;
    return true;
  }

  // Newton on film and position at once: one linearisation per iteration.
  [[nodiscard]] bool together() {
    for (int k = 0; k < options_.max_iterations; ++k) {
      if (settled(*point_.load)) return true;
      const Eigen::Vector2d de = position_step(*point_.load);
      const Eigen::VectorXd u = u_ + du0_ + du_de_ * de;
      e_ += de;
      motion_ = steady_surfaces(model_, point_, e_);
      if (is_sensible(u)) {
        u_ = u;
        linearise();
      } else if (!film_at(e_)) {
        return false;
      }
    }
    return false;
  }

  // Newton on the position with the film solved at each; a step that does not bring the force nearer is halved.
  [[nodiscard]] bool in_turn(const Eigen::Vector2d& target) {
    for (int k = 0; k < options_.max_iterations; ++k) {
      if (settled(target)) return true;
      const Eigen::Vector2d e = e_;
      const Eigen::VectorXd u = u_;
      const double error = error_of(target);
      const Eigen::Vector2d de = position_step(target);
      const Eigen::MatrixXd du_de = du_de_;
      bool nearer = false;
      for (double share = 1; !nearer && share > 1e-4; share /= 2) {
        u_ = u + share * (du_de * de);
        motion_ = steady_surfaces(model_, point_, e + share * de);
        if (!is_sensible(u_)) u_ = u;
        nearer = film_at(e + share * de) && error_of(target) < error;
      }
      if (!nearer) return false;
    }
    return false;
  }

  // From the force the film has at `start` to the load, each equilibrium the start of the next (bearing.13).
  [[nodiscard]] bool raise_load(const Eigen::Vector2d& start) {
    u_.setZero();
    if (!film_at(start)) return false;
    const Eigen::Vector2d from = force_;
    double reached = 0, step = 0.25;
    while (reached < 1) {
      const Eigen::Vector2d e = e_;
      const Eigen::VectorXd u = u_;
      const double next = std::min(1.0, reached + step);
      if (in_turn(from + next * (*point_.load - from))) {
        reached = next;
        step *= 2;
        continue;
      }
      step /= 4;
      if (step < kSmallestLoadStep) return false;
      u_ = u;
      if (!film_at(e)) return false;
    }
    return true;
  }

  const film::FilmModel& model_;
  const OperatingPoint& point_;
  const SteadyOptions& options_;
  film::Reynolds reynolds_;
  film::FilmSolveOptions film_options_;
  film::FilmHistory history_;  // dt = 0: a steady film
  std::vector<film::MotionDirection> directions_;
  film::SurfaceMotion motion_;
  Eigen::Vector2d e_ = Eigen::Vector2d::Zero(), force_ = Eigen::Vector2d::Zero();
  Eigen::VectorXd u_, du0_;
  Eigen::MatrixXd du_de_;
  SteadySummary summary_;
};

}  // namespace

film::SurfaceMotion steady_surfaces(const film::FilmModel& model, const OperatingPoint& point,
                                    const Eigen::Vector2d& e) {
  film::SurfaceMotion motion;
  place_surfaces(model, parameters_of(model, point, e), motion);
  motion.u_shell = model.R * point.shell_speed;
  return motion;
}

Eigen::Vector2d ocvirk_position(const film::FilmModel& model, const OperatingPoint& point) {
  HERSEY_REQUIRE(point.load && point.load->norm() > 0, "a load that is not zero");
  constexpr double pi = std::numbers::pi;
  const double R_c = model.R / model.c, slenderness = model.L / (2 * model.R);
  const double revolutions = std::abs(point.entraining_speed()) / (2 * pi);
  const double wanted = model.lubricant.mu0 * revolutions * R_c * R_c * 2 * model.R * model.L / point.load->norm() *
                        slenderness * slenderness;
  // S (L/D)^2 falls from infinity to zero as epsilon goes from 0 to 1.
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double x = (low + high) / 2, y = 1 - x * x;
    (y * y / (pi * x * std::sqrt(pi * pi * y + 16 * x * x)) > wanted ? low : high) = x;
  }
  // A bearing of finite width stands nearer to its centre or, with contact, is held off the wall: keep away from both.
  const double epsilon = std::clamp(low, 0.01, 0.9);
  const double attitude = std::atan2(pi * std::sqrt(1 - epsilon * epsilon), 4 * epsilon);
  const double angle = std::atan2(point.load->y(), point.load->x()) + std::copysign(attitude, point.entraining_speed());
  // A tilted journal needs room at both edges.
  const double room = std::max(0.1, 1 - 0.5 * model.L * point.tilt.norm() / model.c);
  return epsilon * room * model.c * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

SteadySummary solve_steady(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                           SteadyState& state) {
  HERSEY_REQUIRE(!point.load || point.load->norm() > 0, "a load that is not zero");
  HERSEY_REQUIRE(point.entraining_speed() != 0, "speeds that drag oil into the gap");
  const double gap = smallest_gap(model, parameters_of(model, point, point.load ? Eigen::Vector2d::Zero() : point.e));
  HERSEY_REQUIRE(gap > 0, "a journal inside its bore");
  Search search(model, point, options);
  const SteadySummary summary = point.load ? search.under_load() : search.at_given_position();
  if (summary.converged) state = search.state();
  return summary;
}

}  // namespace hersey::bearing
