#include "temperature_path.h"

#include <algorithm>
#include <utility>

namespace hersey::bearing {
namespace {

// Turns after which temperatures go this share of their way at a time, and steps back at most in all.
constexpr int kTurnsOfAcceleration = 40, kMostStepsBack = 12;
constexpr double kSlowShare = 0.3;

}  // namespace

TemperaturePath::TemperaturePath(const film::FilmModel& model, const film::ThermalModel& thermal,
                                 const std::optional<film::HeatState>& start)
    : model_(model), thermal_(thermal), heat_(model, thermal), is_cold_(!start) {
  if (const auto* body = std::get_if<film::BodyWall>(&thermal.shell); body != nullptr && body->conduction->deforms())
    per_watt_ = body->conduction->rise.rowwise().sum().mean();
  if (start) heat_.set_state(*start);
  tried_ = unknowns();
}

Eigen::VectorXd TemperaturePath::unknowns() const {
  const film::HeatState& state = heat_.state();
  const Eigen::Index walls = per_watt_ > 0 ? state.wall_heat.size() : 0;
  Eigen::VectorXd x(state.film.size() + walls);
  x.head(state.film.size()) = state.film.array() - thermal_.T_supply;
  x.tail(walls) = per_watt_ * state.wall_heat.head(walls);
  return x;
}

void TemperaturePath::try_next(const Eigen::VectorXd& x) {
  film::HeatState next = heat_.state();
  next.film = x.head(next.film.size()).array() + thermal_.T_supply;
  if (per_watt_ > 0) next.wall_heat = x.tail(next.wall_heat.size()) / per_watt_;
  try_next(std::move(next));
}

void TemperaturePath::try_next(film::HeatState next) {
  next.film = next.film.cwiseMax(coldest_trial).cwiseMin(hottest_trial);
  heat_.set_state(next);
  tried_ = unknowns();
}

void TemperaturePath::take() {
  last_ = tried_;
  image_ = unknowns();
  nearness_ = std::min(1.0, (image_ - last_).cwiseAbs().maxCoeff() / (1 + image_.cwiseAbs().maxCoeff()));
}

void TemperaturePath::step_on(int turn) {
  if (turn == kTurnsOfAcceleration) mixing_ = solver::FixedPointIteration(solver::Acceleration::constant, kSlowShare);
  if (is_cold_) {
    try_next(film::first_guess(model_, thermal_, heat_.state()));
  } else {
    try_next(mixing_.next(last_, image_));
  }
  is_cold_ = false;
}

bool TemperaturePath::step_back() {
  if (last_.size() == 0 || ++steps_back_ > kMostStepsBack) return false;
  const Eigen::VectorXd half = 0.5 * (tried_ + last_);
  mixing_.begin_step();
  try_next(half);
  return true;
}

}  // namespace hersey::bearing
