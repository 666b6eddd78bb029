#include "hersey/bearing/steady_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>
#include <vector>

#include "clearance_growth.h"
#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/core/contract.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/grid_transfer.h"
#include "hersey/film/reynolds.h"
#include "short_bearing.h"
#include "steady_film.h"
#include "temperature_path.h"

namespace hersey::bearing {
namespace {

// One Newton step may turn the journal by this angle [rad].
constexpr double kLargestTurn = 0.3;

// Fractions of the way to the load below which raising it is given up.
constexpr double kSmallestLoadStep = 1e-3;

// Iterations on film and position together without getting nearer by half, after which they are taken in turn.
constexpr int kPatience = 6;

// ln of the viscosity over that at rest from which on no film between rigid surfaces is an oil's. Of Weibull's
// transformation alpha p = -ln(1 - alpha p_iso): 1 - alpha p_iso = 6e-6.
constexpr double kSolid = 12;

// A gap of this share of the clearance is none.
constexpr double kTouching = 3e-3;

// Share of the load below which a force has no size to compare with.
constexpr double kForceFloor = 1e-6;

// Positions tried on the way from the start to the bearing's centre, where the film at the start cannot be found.
constexpr int kMostStarts = 5;

// Linearisations that the search from the inside out may take beside those of the paths from the start, as a share.
constexpr double kShareOfSearch = 0.6;

// The search from the inside out: turns until the force points along the load, the angle at which it does [rad], steps
// outwards, and halvings of the last one.
constexpr int kMostTurns = 8, kMostStepsOut = 16, kMostHalvings = 9;
constexpr double kAligned = 0.02;

// Beyond this turn the film at the last position is no start for the next [rad].
constexpr double kFreshTurn = 0.2;

// Turns of film and temperature, and the change of temperatures over the largest rise (plus 1 K) at which they end.
constexpr int kMostHeatIterations = 150;
constexpr double kHeatTolerance = 1e-8;

// On half the grid they come as near as its films are to those on the whole one.
constexpr double kHalfGridTolerance = 0.1;

// The film is solved to this share of how far its temperatures still move.
constexpr double kShareOfNearness = 0.1;

// No film is solved less well than this: none at all would do.
constexpr double kCoarsest = 1e-3;

// What Newton's method leaves of a small residual is this many times its square.
constexpr double kCurvature = 3;

// A step of the journal over the smallest gap that needs no care.
constexpr double kSmallStep = 0.05;

using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Film and position of one bearing (bearing.17), and the Newton iterations that bring them together.
class Search {
 public:
  Search(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options)
      : model_(model), point_(point), options_(options), film_(model, point_, options), x_(film_.start()) {
    for (int k = 0; k <= kTyRate; ++k) directions_.push_back(surface_direction(model, k));
  }

  // The film at `e`, from the film there is.
  [[nodiscard]] bool film_at(const Eigen::Vector2d& e) {
    e_ = e;
    is_unsolved_ = false;
    if (!stands_inside()) return false;
    const film::FilmSolveSummary solved = film_.solve(e, x_);
    (is_swept() ? summary_.film_iterations : summary_.iterations) += solved.iterations;
    summary_.message = solved.message;
    is_unsolved_ = is_unsolved(solved);
    return solved.converged && flows() && linearise();
  }

  [[nodiscard]] bool is_swept() const { return options_.solver == film::FilmSolver::sor && !film_.deforms(); }

  // Whether a solver has not arrived. A film that closes, starves or has an oil that stiffens without bound is none.
  [[nodiscard]] bool is_unsolved(const film::FilmSolveSummary& solved) const {
    using Trouble = film::FilmDomain::Trouble;
    if (solved.domain.is_inside()) return solved.relative_residual > rtol_;
    const bool stiffens = !std::holds_alternative<film::ConstantViscosity>(model_.lubricant.viscosity_law);
    return solved.domain.trouble != Trouble::closed && !(solved.domain.trouble == Trouble::pressure && stiffens);
  }

  // Between rigid surfaces an oil that stiffens has, beyond Weibull's limit, numerical answers in which it is a solid.
  [[nodiscard]] bool flows() {
    Eigen::Index node = 0;
    const double p = film_.film_of(x_).maxCoeff(&node);
    if (film_.yields() || film::log_viscosity_ratio(model_.lubricant, p).value < kSolid) return true;
    summary_.message =
        film::text(model_, {.trouble = film::FilmDomain::Trouble::pressure, .node = static_cast<int>(node)});
    return false;
  }

  [[nodiscard]] SteadySummary solve() {
    has_film_ = true;
    if (!point_.load && options_.start_heat) take_start();
    return point_.load ? under_load() : at_given_position();
  }

  // A film and a position to go on from.
  void begin_at(const Eigen::Vector2d& e, const Eigen::VectorXd& u) {
    e_ = e;
    x_.head(u.size()) = u;
    has_film_ = true;
  }
  [[nodiscard]] bool has_film() const { return has_film_; }

  [[nodiscard]] SteadySummary at_given_position() {
    summary_.converged = film_at(point_.e);
    if (summary_.converged) x_ += film_.increment();  // beyond the tolerance: derivatives and differences then agree
    return summary_;
  }

  [[nodiscard]] SteadySummary under_load() {
    if (!film_at_start()) return summary_;
    if (bears_nothing()) {
      summary_.message =
          "the film bears no load: it has no pressure anywhere. Where edges at the cavitation pressure "
          "and no supply let no oil in, there is no other film";
      return summary_;
    }
    budget_ = options_.max_linearisations;
    const bool found = together(*point_.load) || from_light_load() || from_here() || raise_load();
    budget_ = summary_.iterations + static_cast<int>(kShareOfSearch * options_.max_linearisations);
    if (!found && !from_inside_out()) {
      summary_.message = why_not();
      return summary_;
    }
    summary_.converged = true;
    summary_.message.clear();
    return summary_;
  }

  // The same with other viscosities, from the film and the position there are.
  [[nodiscard]] SteadySummary once_more() {
    if (!point_.load) return at_given_position();
    budget_ = summary_.iterations + options_.max_linearisations;
    const Eigen::Vector2d e = e_;
    const Eigen::VectorXd x = x_;
    summary_.converged = linearise() && (one_step(*point_.load) || together(*point_.load));
    if (!summary_.converged) {
      x_ = x;
      summary_.converged = film_at(e) && together(*point_.load);
    }
    if (!summary_.converged) return under_load();
    summary_.message.clear();
    return summary_;
  }

  // Whether the film and position there are, linearised anew, are the answer.
  [[nodiscard]] bool is_settled() {
    if (!linearise() || film_.relative_residual() > options_.rtol) return false;
    if (point_.load) {
      summary_.force_error = (force_ - *point_.load).norm() / point_.load->norm();
      if (summary_.force_error > options_.rtol) return false;
    }
    x_ += film_.increment();
    return true;
  }

  void set_viscosity(film::LayeredViscosity viscosity) { film_.set_viscosity(std::move(viscosity)); }

  void set_thermal_shape(Eigen::VectorXd shape) { film_.set_thermal_shape(std::move(shape)); }
  // The clearance at other temperatures of its walls; the journal stays where it is in it.
  void set_growth(double growth) {
    e_ *= (model_.c + growth) / clearance();
    point_ = with_growth(point_, model_, growth);
  }

  // How near to an answer it comes, on the way to one of film and temperature.
  void set_tolerance(double rtol) {
    rtol_ = rtol;
    film_.set_tolerance(rtol);
  }

  // Temperatures by the film found.
  void heat(film::FilmHeat& heat) { heat.advance(film_.surfaces(e_, x_), film_.history(), film_.film_of(x_)); }

  // Derivatives at the film found (bearing.21): one solve with four right-hand sides each on the factor of the last
  // linearisation. What a motion of the journal does to surfaces that deform, they do at its rate (bearing.29).
  [[nodiscard]] DynamicCoefficients coefficients() {
    Eigen::MatrixXd dx;
    Columns by_position, by_rate;
    respond(4, dx, by_position);
    std::vector<film::MotionDirection> rates(directions_.begin() + 4, directions_.end());
    for (Eigen::Index a = 0; film_.deforms() && a < 4; ++a) {
      film::MotionDirection& rate = rates[static_cast<std::size_t>(a)];
      rate.g_rate += film_.opening(film_.amplitudes_of(dx.col(a)));
    }
    film_.respond(rates, dx, by_rate);
    DynamicCoefficients result;
    const auto generalised = [](const Columns& wrench) {
      Eigen::Matrix4d rows;
      rows << wrench.row(3), wrench.row(4), wrench.row(1), -wrench.row(0);
      return rows;
    };
    result.stiffness = generalised(by_position);
    result.damping = generalised(by_rate);
    return result;
  }

  [[nodiscard]] const Eigen::Vector2d& position() const { return e_; }
  [[nodiscard]] Eigen::VectorXd film() const { return film_.film_of(x_); }

  [[nodiscard]] SteadyState state() {
    SteadyState state;
    state.point = point_;
    state.e = e_;
    state.u = film_.film_of(x_);
    state.s = film_.amplitudes_of(x_);
    state.tilt = film_.tilt(x_);
    state.turn = film_.turn(x_);
    state.d_shell = film_.shell_displacement(x_);
    state.d_journal = film_.journal_displacement(x_);
    state.thermal_shape = film_.thermal_shape();
    state.film = film::observe_film(model_, film_.surfaces(e_, x_), film_.history(), e_, state.u, state.tilt);
    state.load = state.film.wrench_on_shell.segment<2>(3);
    state.coefficients = coefficients();
    return state;
  }

 private:
  // A position whose force points along the load.
  struct Position {
    double r = 0, angle = 0;  // from the bearing's centre [m, rad]
    Eigen::VectorXd x;
  };

  // Of the search from the inside out: the load is too much at `inner`, and at `outer` it is not, or there is no film.
  struct Bounds {
    double angle = 0, inner = 0, outer = 0;
    std::optional<Position> strong = {};  // the last one with more force than the load
  };

  // The largest force along the load that has been seen, where, and what is further out: no film, or none found.
  struct Limit {
    double force = 0, r = 0;
    std::string why;
    bool is_unsolved = false;
  };

  [[nodiscard]] std::string why_not() const {
    if (!limit_.why.empty() && 0 < limit_.force && limit_.force < point_.load->norm()) {
      if (limit_.is_unsolved) return not_found_further_out();
      return fmt::format(
          "no equilibrium: along this load of {:.4g} N the film bears at most about {:.4g} N, at eccentricity ratio "
          "{:.4f}; further out {}{}",
          point_.load->norm(), limit_.force, limit_.r / clearance(), limit_.why, what_to_try());
    }
    std::string text = fmt::format(
        "no equilibrium found in {} linearisations: force off by {:.2g} of the load at eccentricity ratio {:.4f}",
        summary_.iterations, summary_.force_error, e_.norm() / clearance());
    if (gap_at(e_) > kTouching * clearance()) return text;
    const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
    if (is_smooth && film_.yields())
      return text + "; the surfaces touch at the edges, where no film pressure parts them: give asperities";
    if (is_smooth) return text + "; the film would be thinner than any surface is smooth: give asperities";
    return film_.yields() ? text : text + "; more than the asperities of rigid surfaces bear: give a compliance";
  }

  // That a solver does not arrive says nothing of what the film bears.
  [[nodiscard]] std::string not_found_further_out() const {
    const std::string other = film_.deforms() ? "" : is_swept() ? "; `solver: newton` may" : "; `solver: sor` may";
    return fmt::format(
        "no equilibrium found: along this load of {:.4g} N the film bears {:.4g} N at eccentricity ratio {:.4f} and "
        "perhaps more; further out the solver does not find it ({}){}",
        point_.load->norm(), limit_.force, limit_.r / clearance(), limit_.why, other);
  }

  [[nodiscard]] std::string what_to_try() const {
    const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
    std::string text = is_smooth ? "; `asperities` would bear what the film does not" : "";
    if (!film_.yields()) text += "; surfaces that give way (`compliance`) spread the pressure";
    return text;
  }

  [[nodiscard]] bool is_tired() const { return summary_.iterations >= budget_; }

  [[nodiscard]] bool bears_nothing() {
    const film::FilmFields fields = film::film_fields(model_, film_.surfaces(e_, x_), film_.film_of(x_));
    const double scale = model_.lubricant.mu0 * point_.film_speed(model_.c) * std::pow(model_.R / model_.c, 2);
    return fields.p.maxCoeff() - fields.p.minCoeff() <= 1e-9 * scale &&
           model_.asperities.model == film::AsperityModel::none;
  }

  [[nodiscard]] bool linearise() {
    const int linearisations = film_.linearise_near(e_, x_);
    force_ = film_.force();
    summary_.iterations += linearisations;
    return linearisations > 0;
  }

  // Answers dx and dW (total derivatives) to the first `count` directions; a supply at the widest gap follows e.
  void respond(int count, Eigen::MatrixXd& dx, Columns& dW) {
    std::vector<film::MotionDirection> wanted(directions_.begin(), directions_.begin() + count);
    if (model_.supply.kind == film::SupplyKind::widest_gap && e_.norm() > 1e-6 * clearance()) {
      wanted[kEx].phi_supply = -e_.y() / e_.squaredNorm();
      wanted[kEy].phi_supply = e_.x() / e_.squaredNorm();
    }
    film_.respond(wanted, dx, dW);
  }

  // Where the film at the given start cannot be found, it is sought nearer to the centre, where it is thicker.
  [[nodiscard]] bool film_at_start() {
    const Eigen::Vector2d start = options_.start.value_or(ocvirk_position(model_, point_));
    for (int k = 0; k < kMostStarts; ++k) {
      x_ = film_.start();
      if (k == 0) take_start();
      if (film_at(std::exp2(-k) * start)) return true;
    }
    return false;
  }

  void take_start() {
    const Eigen::Index n = model_.grid.size();
    if (options_.start_film.size() == n) x_.head(n) = options_.start_film;
    if (options_.start_deformation.size() == film_.amplitudes()) x_.tail(x_.size() - n) = options_.start_deformation;
  }

  // What is missing from the force to the target, as if the force followed a power of the film thickness: the logarithm
  // of the ratio along the force and the angle across it, to first order their difference.
  [[nodiscard]] Eigen::Vector2d missing(const Eigen::Vector2d& target) const {
    const double F = force_.norm(), W = target.norm();
    const double turn = std::atan2(force_.x() * target.y() - force_.y() * target.x(), force_.dot(target));
    if (F < kForceFloor * W || std::abs(turn) > 0.5 * std::numbers::pi) return target - force_;
    return std::log(W / F) * force_ + turn * Eigen::Vector2d(-force_.y(), force_.x());
  }

  // The same as one number: 0 at the target.
  [[nodiscard]] double distance_to(const Eigen::Vector2d& target) const {
    const double F = std::max(force_.norm(), 1e-300), W = target.norm();
    const double turn = std::atan2(force_.x() * target.y() - force_.y() * target.x(), force_.dot(target));
    return std::hypot(std::log(W / F), turn);
  }

  // A step of position, and of film and deformation.
  struct Step {
    Eigen::Vector2d de;
    Eigen::VectorXd dx;
  };

  // Newton's step (bearing.18) at the present linearisation towards `target`, cut to where the linear film may be
  // trusted.
  [[nodiscard]] Step newton_step(const Eigen::Vector2d& target) {
    Columns dW;
    respond(2, dx_de_, dW);
    const Eigen::Matrix2d K = film_.change_of_force(dx_de_, dW);
    Step step{K.fullPivLu().solve(missing(target)), film_.increment()};
    if (!step.de.allFinite()) step.de.setZero();
    step.de *= std::min(1.0, 0.5 * clearance() / std::max(step.de.norm(), 1e-300));
    if (!film_.yields()) step.de *= share_of_gap(step.de);
    step.dx += dx_de_ * step.de;
    double share = 1;
    while (share > 1e-6 && !film_.keeps_film(e_, x_, e_ + share * step.de, x_ + share * step.dx)) share *= 0.7;
    step.de *= share;
    step.dx *= share;
    return step;
  }

  // Rigid surfaces: the force follows a power of the gap, so its logarithm is what a step changes in proportion.
  [[nodiscard]] double share_of_gap(const Eigen::Vector2d& de) const {
    const double gap = gap_at(e_), tiny = 1e-3;
    const double x = (gap - gap_at(e_ + tiny * de)) / (tiny * gap);
    return std::abs(x) < 1e-6 ? 1 : std::min(2.0, -std::expm1(-x) / x);
  }

  [[nodiscard]] double gap_at(const Eigen::Vector2d& e) const { return film_.undeformed_gap(e); }

  [[nodiscard]] double clearance() const { return bearing::clearance(model_, point_); }

  // Whether the journal stands inside its bore, as far as a rigid one must.
  [[nodiscard]] bool stands_inside() const { return film_.yields() || gap_at(e_) > 0; }

  // A supply at the widest gap turns with the position: after a large turn the film is another one.
  [[nodiscard]] bool turns_far(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    if (model_.supply.kind != film::SupplyKind::widest_gap) return false;
    const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
    return std::abs(turn) > kLargestTurn;
  }

  [[nodiscard]] bool settled(const Eigen::Vector2d& target) {
    summary_.force_error = (force_ - target).norm() / target.norm();
    if (summary_.force_error > rtol_ || film_.relative_residual() > rtol_) return false;
    x_ += film_.increment();
    return true;
  }

  // Near the answer one step of Newton's method from the present linearisation is enough, and known to be.
  [[nodiscard]] bool one_step(const Eigen::Vector2d& target) {
    if (is_swept()) return false;
    const double off = std::max((force_ - target).norm() / target.norm(), film_.relative_residual());
    if (kCurvature * off * off > rtol_) return false;
    Columns dW;
    respond(2, dx_de_, dW);
    const Eigen::Vector2d de = film_.change_of_force(dx_de_, dW).fullPivLu().solve(target - force_);
    if (!(de.norm() < kSmallStep * gap_at(e_))) return false;
    e_ += de;
    x_ += film_.increment() + dx_de_ * de;
    return true;
  }

  // Newton on film and position at once: one linearisation per iteration.
  [[nodiscard]] bool together(const Eigen::Vector2d& target) {
    if (is_swept()) return false;
    double best = std::numeric_limits<double>::infinity();
    int idle = 0;
    for (int k = 0; k < options_.max_iterations && idle < kPatience; ++k) {
      if (settled(target)) return true;
      const double now = distance_to(target) + film_.relative_residual();
      idle = now < 0.5 * best ? 0 : idle + 1;
      best = std::min(best, now);
      const Step step = newton_step(target);
      const Eigen::Vector2d from = e_;
      e_ += step.de;
      const Eigen::VectorXd film = x_;
      x_ += step.dx;
      if (stands_inside() && !turns_far(from, e_) && linearise()) continue;
      x_ = film;
      if (!film_at(e_)) return false;
    }
    return false;
  }

  // Newton on the position with the film solved at each; a step that does not bring the force nearer is halved.
  [[nodiscard]] bool in_turn(const Eigen::Vector2d& target) {
    for (int k = 0; k < options_.max_iterations && !is_tired(); ++k) {
      if (settled(target)) return true;
      const Eigen::Vector2d e = e_;
      const Eigen::VectorXd x = x_;
      const double distance = distance_to(target);
      const Step step = newton_step(target);
      bool nearer = false;
      for (double share = 1; !nearer && share > 1e-4 && !is_tired(); share /= 2) {
        x_ = x + share * step.dx;
        if (!film::judge_unknowns(model_, film_.film_of(x_)).is_inside()) x_ = x;
        nearer = film_at(e + share * step.de) && distance_to(target) < distance;
      }
      if (!nearer) return false;
    }
    return false;
  }

  // Where the joint iteration has left off, if its position is nearer to the load than the start, else from there.
  [[nodiscard]] bool from_here() {
    const Eigen::Vector2d here = e_;
    if (!film_at_start()) return false;
    const Eigen::Vector2d start = e_;
    const Eigen::VectorXd film = x_;
    const double distance = distance_to(*point_.load);
    if (!film_at(here) || distance_to(*point_.load) > distance) {
      x_ = film;
      if (!film_at(start)) return false;
    }
    return in_turn(*point_.load);
  }

  // A force on the way from `from` to the load: turning at an even rate and growing by an even factor.
  [[nodiscard]] Eigen::Vector2d between(const Eigen::Vector2d& from, double share) const {
    const Eigen::Vector2d& W = *point_.load;
    const double turn = std::atan2(from.x() * W.y() - from.y() * W.x(), from.dot(W));
    const double size = std::exp(share * std::log(W.norm() / from.norm()));
    return size * (Eigen::Rotation2Dd(share * turn) * from);
  }

  // Between surfaces that deform: from a share of the load at which they hardly do.
  [[nodiscard]] bool from_light_load() {
    for (const double share : {1.0 / 16, 1.0 / 128}) {
      if (!film_.deforms() || is_tired()) return false;
      OperatingPoint light = point_;
      light.load = share * *point_.load;
      x_ = film_.start();
      if (film_at(ocvirk_position(model_, light)) && follow(*light.load) && change_load()) return true;
    }
    return false;
  }

  [[nodiscard]] bool raise_load() { return film_at_start() && change_load(); }

  // From the force the film has here to the load, each equilibrium the start of the next (bearing.19).
  [[nodiscard]] bool change_load() {
    const Eigen::Vector2d from = force_;
    double reached = 0, step = 0.25;
    while (reached < 1 && !is_tired()) {
      const Eigen::Vector2d e = e_;
      const Eigen::VectorXd x = x_;
      const double next = std::min(1.0, reached + step);
      if (follow(next == 1 ? *point_.load : between(from, next))) {
        reached = next;
        step *= 2;
        continue;
      }
      step /= 4;
      if (step < kSmallestLoadStep) return false;
      x_ = x;
      if (!film_at(e)) return false;
    }
    return reached >= 1;
  }

  // To a force near the present one. Soft bodies give way under a load that is held, but not where the journal is held:
  // position and deformation then go together.
  [[nodiscard]] bool follow(const Eigen::Vector2d& target) {
    if (!film_.deforms()) return in_turn(target);
    const Eigen::Vector2d e = e_;
    const Eigen::VectorXd x = x_;
    if (together(target)) return true;
    x_ = x;
    return film_at(e) && in_turn(target);
  }

  enum class Look { no_film, across, too_weak, strong };

  // Turns the journal about the bearing's centre, at the distance at.r from it, until the force points along the load.
  // A round bearing without features needs one turn: its force turns with it.
  [[nodiscard]] Look turn_to_load(Position& at) {
    const Eigen::Vector2d& W = *point_.load;
    double turn = std::numbers::pi;
    for (int k = 0; k < kMostTurns && !is_tired(); ++k) {
      if (std::abs(turn) > kFreshTurn) x_.head(model_.grid.size()).setZero();
      if (!film_at(at.r * Eigen::Vector2d(std::cos(at.angle), std::sin(at.angle)))) return Look::no_film;
      turn = std::atan2(force_.x() * W.y() - force_.y() * W.x(), force_.dot(W));
      if (std::abs(turn) < kAligned) {
        at.x = x_;
        return force_.norm() < W.norm() ? Look::too_weak : Look::strong;
      }
      at.angle += turn;
    }
    return Look::across;
  }

  // Distances from the centre to look at: each halves what is left of the clearance; surfaces that give way overlap
  // beyond it by up to a few times what the load deforms them.
  [[nodiscard]] std::vector<double> distances() {
    const double c = clearance(), room = std::max(0.1, 1 - 0.5 * model_.L * point_.tilt.norm() / c) * c;
    const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
    std::vector<double> result;
    for (double gap = 0.5; gap > (is_smooth ? 1 : 0.1) * kTouching; gap /= 2) result.push_back((1 - gap) * room);
    const double depth = model_.compliance * point_.load->norm() / (model_.R * model_.L) + film_.depth(*point_.load);
    for (double share = 0.25; depth > 0 && share <= 8; share *= 2) result.push_back(room + share * depth);
    return result;
  }

  // One look further out, or half-way between the last two: moves one of the bounds, and keeps what has been borne.
  void look_at(double r, Bounds& bounds) {
    Position at{r, bounds.angle, {}};
    const Look seen = turn_to_load(at);
    if (seen == Look::across) return;
    if (seen == Look::no_film) {
      limit_.why = summary_.message;
      limit_.is_unsolved = is_unsolved_;
      bounds.outer = r;
      return;
    }
    if (force_.norm() > limit_.force) limit_.force = force_.norm(), limit_.r = r;
    bounds.angle = at.angle;
    (seen == Look::strong ? bounds.outer : bounds.inner) = r;
    if (seen == Look::strong) bounds.strong = at;
  }

  // The force of a film grows the further out the journal stands, without bound or up to where the film ends: outwards
  // until it reaches the load, then halving the last step, then Newton (bearing.20). What has been seen on the way
  // says, where the load is not found, what the film bears.
  [[nodiscard]] bool from_inside_out() {
    const Eigen::Vector2d start = ocvirk_position(model_, point_);
    Bounds bounds{.angle = std::atan2(start.y(), start.x())};
    for (const double r : distances()) {
      if (bounds.outer > 0 || is_tired()) break;
      look_at(r, bounds);
    }
    for (int k = 0; k < kMostHalvings && bounds.outer > 0 && !is_tired(); ++k) {
      if (is_reached(bounds)) return true;
      look_at(0.5 * (bounds.inner + bounds.outer), bounds);
    }
    if (bounds.outer == 0 && !is_tired()) limit_.why = "the surfaces all but touch";
    return is_reached(bounds);
  }

  // Newton from the last position whose force exceeds the load, if that is near enough; from further away the load is
  // lowered from its force.
  [[nodiscard]] bool is_reached(const Bounds& bounds) {
    if (!bounds.strong) return false;
    const Position& from = *bounds.strong;
    const auto back = [&] {
      x_ = from.x;
      return film_at(from.r * Eigen::Vector2d(std::cos(from.angle), std::sin(from.angle)));
    };
    return (back() && in_turn(*point_.load)) || (back() && change_load());
  }

  const film::FilmModel& model_;
  OperatingPoint point_;
  const SteadyOptions& options_;
  SteadyFilm film_;
  std::vector<film::MotionDirection> directions_;
  Eigen::Vector2d e_ = Eigen::Vector2d::Zero(), force_ = Eigen::Vector2d::Zero();
  Eigen::VectorXd x_;  // film and deformation
  Eigen::MatrixXd dx_de_;
  SteadySummary summary_;
  Limit limit_;
  double rtol_ = options_.rtol;
  bool has_film_ = false;     // to go on from
  bool is_unsolved_ = false;  // the solver has not found the film last sought
  int budget_ = 0;            // of linearisations
};

// Bodies of a network in balance with the film's heat, and the film with their temperatures (thermal.47).
void balance(film::ThermalNetwork& network, film::FilmHeat& heat) {
  const film::FilmTerminals at = film::terminals_of(heat.thermal());
  network.advance(0, {{at, heat.exchange()}});
  heat.move_walls(network.walls(at, heat.exchange().T));
}

double celsius(double T) { return T - film::zero_celsius; }

// Where the hottest oil is.
std::string hottest_of(const film::HeatObservables& seen) {
  return fmt::format("{:.0f} degC at {:.0f} deg, z = {:.3g} mm", celsius(seen.T_max),
                     seen.T_max_phi * 180 / std::numbers::pi, 1e3 * seen.T_max_z);
}

// A film that was there and is lost as its oil warms and thins, or heat that leaves only at temperatures of no oil:
// told as what it is.
void tell_runaway(const film::HeatObservables& seen, bool has_lost_film, SteadySummary& summary) {
  if (has_lost_film) {
    summary.message = fmt::format("thermal runaway: oil that warms to {} is too thin for the film to stay; {}",
                                  hottest_of(seen), summary.message);
  } else if (seen.T_max > hottest_oil) {
    summary.converged = false;
    summary.message = fmt::format(
        "thermal runaway: the film's heat leaves it with oil of {} only, and no oil is one above {:.0f} degC",
        hottest_of(seen), celsius(hottest_oil));
  }
}

// Walls have grown into each other.
std::string seizure(const film::FilmModel& model, double growth, const film::HeatObservables& seen) {
  return fmt::format(
      "a seizure: the clearance of {:.4g} um closes to {:.4g} um with the shell at {:.0f} degC and the journal at "
      "{:.0f} degC",
      1e6 * model.c, 1e6 * (model.c + growth), celsius(seen.T_shell_wall), celsius(seen.T_journal_wall));
}

// Film and temperature in turn until the film's temperatures, and the clearance with those of its walls, stay.
// @param network  of walls that are nodes; null: none is
SteadySummary come_together(const film::FilmModel& model, const SteadyOptions& options, double nearness, Search& search,
                            TemperaturePath& path, film::ThermalNetwork* network) {
  SteadySummary summary;
  for (int k = 0; k < kMostHeatIterations; ++k) {
    const bool is_open = model.c + path.growth() > seized * model.c;
    summary.converged = false;
    if (is_open) {
      search.set_growth(path.growth());
      search.set_tolerance(std::max(options.rtol, std::min(kCoarsest, kShareOfNearness * path.nearness())));
      search.set_viscosity(path.heat().viscosity());
      search.set_thermal_shape(path.heat().shell_opening());
      summary = search.has_film() ? search.once_more() : search.solve();
    }
    summary.heat_iterations = k + 1;
    if (!summary.converged) {
      if (path.step_back()) continue;
      if (!is_open)
        summary.message = seizure(model, path.growth(), path.heat().observables());
      else if (path.has_film())
        tell_runaway(path.heat().observables(), true, summary);
      return summary;
    }
    search.heat(path.heat());
    if (network != nullptr) balance(*network, path.heat());
    path.take();
    if (path.nearness() <= nearness && (nearness > kHeatTolerance || search.is_settled())) {
      tell_runaway(path.heat().observables(), false, summary);
      return summary;
    }
    path.step_on(k);
  }
  summary.converged = false;
  summary.message = fmt::format("film and temperature do not come together in {} turns; hottest oil {}",
                                kMostHeatIterations, hottest_of(path.heat().observables()));
  tell_runaway(path.heat().observables(), false, summary);
  return summary;
}

// From the same film on half the nodes each way, where a turn costs a quarter. Without an answer there, all stays.
void begin_on_half_grid(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                        Search& search, TemperaturePath& path) {
  if (options.start_heat || options.elasticity || !film::can_be_coarsened(model.grid)) return;
  // Walls that move with their heat find their way with the film of the grid itself.
  if (film::terminals_of(*options.thermal).has_any() || options.thermal->expansion ||
      std::holds_alternative<film::BodyWall>(options.thermal->shell))
    return;
  film::FilmModel half = model;
  half.grid = film::half_of(model.grid);
  SteadyOptions on_half = options;
  film::ThermalModel& thermal = *on_half.thermal;
  if (auto* wall = std::get_if<film::WallAtTemperature>(&thermal.shell); wall != nullptr && wall->around.size() > 0)
    wall->around = film::GridTransfer(model.grid, half.grid).around(wall->around);
  Search search_there(half, point, on_half);
  TemperaturePath path_there(half, thermal, point, std::nullopt);
  if (!come_together(half, on_half, kHalfGridTolerance, search_there, path_there, nullptr).converged) return;
  const film::GridTransfer transfer(half.grid, model.grid);
  const double fill = film::fill_scale(model) / film::fill_scale(half);
  search.begin_at(search_there.position(),
                  transfer(search_there.film().unaryExpr([fill](double u) { return u < 0 ? fill * u : u; })));
  path.begin_at(transfer(path_there.heat().state().film, thermal.layers));
}

SteadySummary solve_with_heat(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                              SteadyState& state) {
  Search search(model, point, options);
  TemperaturePath path(model, *options.thermal, point, options.start_heat);
  std::optional<film::ThermalNetwork> network;
  if (options.network && film::terminals_of(*options.thermal).has_any()) network.emplace(*options.network);
  begin_on_half_grid(model, point, options, search, path);
  const SteadySummary summary =
      come_together(model, options, kHeatTolerance, search, path, network ? &*network : nullptr);
  if (!summary.converged) return summary;
  state = search.state();
  state.heat = SteadyHeat{
      path.heat().state(), path.heat().observables(), path.heat().fields(), path.heat().body_temperatures(), {}};
  if (network) state.heat->network = network->observables();
  return summary;
}

}  // namespace

SteadySummary solve_steady(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options,
                           SteadyState& state) {
  HERSEY_REQUIRE(!point.load || point.load->norm() > 0, "a load that is not zero");
  HERSEY_REQUIRE(point.film_speed(model.c) > 0 || model.asperities.model != film::AsperityModel::none,
                 "speeds that move oil in the gap, or asperities");
  const ParameterVector first = parameters_of(model, point, point.load ? Eigen::Vector2d::Zero() : point.e);
  const double gap = smallest_gap(model, first, point.growth);
  HERSEY_REQUIRE(gap > 0, "a journal inside its bore");
  if (options.thermal) return solve_with_heat(model, point, options, state);
  Search search(model, point, options);
  const SteadySummary summary = search.solve();
  if (summary.converged) state = search.state();
  return summary;
}

film::FilmFields steady_fields(const film::FilmModel& model, const SteadyState& state) {
  OperatingPoint loaded = state.point;
  loaded.tilt = state.tilt;
  film::SurfaceMotion motion = steady_surfaces(model, loaded, state.e);
  add_to_shell(state.thermal_shape, motion);
  if (state.d_shell.size() > 0) motion.g += state.d_shell;
  if (state.d_journal.size() > 0) motion.g -= state.d_journal;
  film::FilmFields fields = film::film_fields(model, motion, state.u);
  fields.depth = film::mean_depth(model, motion.phi_journal);
  if (state.heat) state.heat->fields.show_in(fields);
  fields.d_shell = state.d_shell;
  fields.d_journal = state.d_journal;
  return fields;
}

}  // namespace hersey::bearing
