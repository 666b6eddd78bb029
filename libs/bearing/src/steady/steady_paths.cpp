#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steady/angle_between.h"
#include "steady/steady_search.h"

// Ways to the load where Newton's method does not arrive from the start (bearing.19, bearing.20), and what they have
// found.
namespace hersey::bearing {
namespace {

// Fractions of the way to the load below which raising it is given up.
constexpr double kSmallestLoadStep = 1e-3;

// A gap of this fraction of the clearance is none.
constexpr double kTouching = 3e-3;

// The search from the inside out: turns until the force points along the load, the angle at which it does [rad], and
// halvings of the last step outwards.
constexpr int kMostTurns = 8, kMostHalvings = 9;
constexpr double kAligned = 0.02;

// Beyond this turn the film at the last position is no start for the next [rad].
constexpr double kFreshTurn = 0.2;

}  // namespace

std::string SteadySearch::failure_message() const {
  if (!limit_.why.empty() && 0 < limit_.force && limit_.force < point_.load->norm()) {
    if (limit_.solver_failed) return unsolved_message();
    return fmt::format(
        "no equilibrium: along this load of {:.4g} N the film bears at most about {:.4g} N, at {}; "
        "further out {}{}",
        point_.load->norm(), limit_.force, limit_.where, limit_.why, suggestion());
  }
  std::string text =
      fmt::format("no equilibrium found in {} linearisations: force off by {:.2g} of the load at {}",
                  summary_.iterations, (force_ - *point_.load).norm() / point_.load->norm(), position_text());
  if (gap_at(e_) > kTouching * coordinates_of().scale(point_, e_)) return text;
  const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
  if (is_smooth && film_.may_overlap())
    return text + "; the surfaces touch at the edges, where no film pressure parts them: give asperities";
  if (is_smooth) return text + "; the film would be thinner than any surface is smooth: give asperities";
  return film_.may_overlap() ? text : text + "; more than the asperities of rigid surfaces bear: give a compliance";
}

std::string SteadySearch::unsolved_message() const {
  const std::string other = film_.deforms() ? "" : is_swept() ? "; `solver: newton` may" : "; `solver: sor` may";
  return fmt::format(
      "no equilibrium found: along this load of {:.4g} N the film bears {:.4g} N at {} and "
      "perhaps more; further out the solver does not find it ({}){}",
      point_.load->norm(), limit_.force, limit_.where, limit_.why, other);
}

std::string SteadySearch::suggestion() const {
  const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
  std::string text = is_smooth ? "; `asperities` would bear what the film does not" : "";
  if (!film_.may_overlap()) text += "; surfaces that give way (`compliance`) spread the pressure";
  return text;
}

bool SteadySearch::continue_nested() {
  const Coordinates here = e_;
  if (!film_at_start()) return false;
  const Coordinates start = e_;
  const Eigen::VectorXd film = x_;
  const double distance = log_force_error(*point_.load);
  if (!film_at(here) || log_force_error(*point_.load) > distance) {
    x_ = film;
    if (!film_at(start)) return false;
  }
  return solve_nested(*point_.load);
}

Coordinates SteadySearch::between(const Coordinates& from, double fraction) const {
  const Coordinates& W = *point_.load;
  const double turn = angle_between(from, W);
  const double size = std::exp(fraction * std::log(W.norm() / from.norm()));
  if (from.size() != 2) return size * from;
  return size * (Eigen::Rotation2Dd(fraction * turn) * Eigen::Vector2d(from));
}

bool SteadySearch::raise_from_light_load() {
  for (const double fraction : {1.0 / 16, 1.0 / 128}) {
    if (!film_.deforms() || is_over_budget()) return false;
    OperatingPoint light = point_;
    light.load = fraction * *point_.load;
    x_ = film_.start();
    if (film_at(coordinates_of().start(light)) && track(*light.load) && change_load()) return true;
  }
  return false;
}

bool SteadySearch::change_load() {
  const Coordinates from = force_;
  double reached = 0, step = 0.25;
  while (reached < 1 && !is_over_budget()) {
    const Coordinates e = e_;
    const Eigen::VectorXd x = x_;
    const double next = std::min(1.0, reached + step);
    if (track(next == 1 ? *point_.load : between(from, next))) {
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

bool SteadySearch::track(const Coordinates& target) {
  if (!film_.deforms()) return solve_nested(target);
  const Coordinates e = e_;
  const Eigen::VectorXd x = x_;
  if (solve_jointly(target)) return true;
  x_ = x;
  return film_at(e) && solve_nested(target);
}

SteadySearch::Probe SteadySearch::rotate_to_load(Position& at) {
  const Coordinates& W = *point_.load;
  double turn = std::numbers::pi;
  for (int k = 0; k < kMostTurns && !is_over_budget(); ++k) {
    if (std::abs(turn) > kFreshTurn) x_.head(model_.grid.size()).setZero();
    if (!film_at(coordinates_of().at(point_, at.r, at.angle))) return Probe::no_film;
    turn = angle_between(force_, W);
    if (std::abs(turn) < kAligned) {
      at.x = x_;
      return force_.norm() < W.norm() ? Probe::below_load : Probe::above_load;
    }
    at.angle += turn;
  }
  return Probe::not_aligned;
}

void SteadySearch::probe(double r, Bounds& bounds) {
  Position at{r, bounds.angle, {}};
  const Probe observed = rotate_to_load(at);
  if (observed == Probe::not_aligned) return;
  if (observed == Probe::no_film) {
    limit_.why = summary_.message;
    limit_.solver_failed = solver_failed_;
    bounds.outer = r;
    return;
  }
  if (force_.norm() > limit_.force) limit_.force = force_.norm(), limit_.where = position_text();
  bounds.angle = at.angle;
  if (observed == Probe::above_load)
    bounds.outer = r, bounds.strong = at;
  else
    bounds.inner = r;
}

bool SteadySearch::search_outwards() {
  const Coordinates start = coordinates_of().start(point_);
  Bounds bounds{.angle = start.size() == 2 ? std::atan2(start.y(), start.x()) : 0};
  for (const double r : coordinates_of().distances(point_, film_.depth(*point_.load))) {
    if (bounds.outer || is_over_budget()) break;
    probe(r, bounds);
  }
  for (int k = 0; k < kMostHalvings && bounds.outer && !is_over_budget(); ++k) {
    if (is_reached(bounds)) return true;
    probe(0.5 * (bounds.inner + *bounds.outer), bounds);
  }
  if (!bounds.outer && !is_over_budget()) limit_.why = "the surfaces all but touch";
  return is_reached(bounds);
}

bool SteadySearch::is_reached(const Bounds& bounds) {
  if (!bounds.strong) return false;
  const Position& from = *bounds.strong;
  const auto back = [&] {
    x_ = from.x;
    return film_at(coordinates_of().at(point_, from.r, from.angle));
  };
  return (back() && solve_nested(*point_.load)) || (back() && change_load());
}

}  // namespace hersey::bearing
