#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "steady/short_bearing.h"
#include "steady/steady_search.h"

// Ways to the load where Newton's method does not arrive from the start (bearing.19, bearing.20), and what they have
// seen.
namespace hersey::bearing {
namespace {

// Fractions of the way to the load below which raising it is given up.
constexpr double kSmallestLoadStep = 1e-3;

// A gap of this share of the clearance is none.
constexpr double kTouching = 3e-3;

// The search from the inside out: turns until the force points along the load, the angle at which it does [rad], and
// halvings of the last step outwards.
constexpr int kMostTurns = 8, kMostHalvings = 9;
constexpr double kAligned = 0.02;

// Beyond this turn the film at the last position is no start for the next [rad].
constexpr double kFreshTurn = 0.2;

}  // namespace

std::string SteadySearch::why_not() const {
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

std::string SteadySearch::not_found_further_out() const {
  const std::string other = film_.deforms() ? "" : is_swept() ? "; `solver: newton` may" : "; `solver: sor` may";
  return fmt::format(
      "no equilibrium found: along this load of {:.4g} N the film bears {:.4g} N at eccentricity ratio {:.4f} and "
      "perhaps more; further out the solver does not find it ({}){}",
      point_.load->norm(), limit_.force, limit_.r / clearance(), limit_.why, other);
}

std::string SteadySearch::what_to_try() const {
  const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
  std::string text = is_smooth ? "; `asperities` would bear what the film does not" : "";
  if (!film_.yields()) text += "; surfaces that give way (`compliance`) spread the pressure";
  return text;
}

bool SteadySearch::from_here() {
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

Eigen::Vector2d SteadySearch::between(const Eigen::Vector2d& from, double share) const {
  const Eigen::Vector2d& W = *point_.load;
  const double turn = std::atan2(from.x() * W.y() - from.y() * W.x(), from.dot(W));
  const double size = std::exp(share * std::log(W.norm() / from.norm()));
  return size * (Eigen::Rotation2Dd(share * turn) * from);
}

bool SteadySearch::from_light_load() {
  for (const double share : {1.0 / 16, 1.0 / 128}) {
    if (!film_.deforms() || is_tired()) return false;
    OperatingPoint light = point_;
    light.load = share * *point_.load;
    x_ = film_.start();
    if (film_at(ocvirk_position(model_, light)) && follow(*light.load) && change_load()) return true;
  }
  return false;
}

bool SteadySearch::change_load() {
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

bool SteadySearch::follow(const Eigen::Vector2d& target) {
  if (!film_.deforms()) return in_turn(target);
  const Eigen::Vector2d e = e_;
  const Eigen::VectorXd x = x_;
  if (together(target)) return true;
  x_ = x;
  return film_at(e) && in_turn(target);
}

SteadySearch::Look SteadySearch::turn_to_load(Position& at) {
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

std::vector<double> SteadySearch::distances() {
  const double c = clearance(), room = std::max(0.1, 1 - 0.5 * model_.L * point_.tilt.norm() / c) * c;
  const bool is_smooth = model_.asperities.model == film::AsperityModel::none;
  std::vector<double> result;
  for (double gap = 0.5; gap > (is_smooth ? 1 : 0.1) * kTouching; gap /= 2) result.push_back((1 - gap) * room);
  const double depth = model_.compliance * point_.load->norm() / (model_.R * model_.L) + film_.depth(*point_.load);
  for (double share = 0.25; depth > 0 && share <= 8; share *= 2) result.push_back(room + share * depth);
  return result;
}

void SteadySearch::look_at(double r, Bounds& bounds) {
  Position at{r, bounds.angle, {}};
  const Look observed = turn_to_load(at);
  if (observed == Look::across) return;
  if (observed == Look::no_film) {
    limit_.why = summary_.message;
    limit_.is_unsolved = is_unsolved_;
    bounds.outer = r;
    return;
  }
  if (force_.norm() > limit_.force) limit_.force = force_.norm(), limit_.r = r;
  bounds.angle = at.angle;
  (observed == Look::strong ? bounds.outer : bounds.inner) = r;
  if (observed == Look::strong) bounds.strong = at;
}

bool SteadySearch::from_inside_out() {
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

bool SteadySearch::is_reached(const Bounds& bounds) {
  if (!bounds.strong) return false;
  const Position& from = *bounds.strong;
  const auto back = [&] {
    x_ = from.x;
    return film_at(from.r * Eigen::Vector2d(std::cos(from.angle), std::sin(from.angle)));
  };
  return (back() && in_turn(*point_.load)) || (back() && change_load());
}

}  // namespace hersey::bearing
