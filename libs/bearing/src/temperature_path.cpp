#include "temperature_path.h"

#include <algorithm>
#include <utility>

#include "short_bearing.h"

namespace hersey::bearing {
namespace {

// Turns after which temperatures go this share of their way at a time, and steps back at most in all.
constexpr int kTurnsOfAcceleration = 40, kMostStepsBack = 12;
constexpr double kSlowShare = 0.3;

// Of a change of the logarithm of viscosity by shear, the rise of temperature that changes it as much [K].
constexpr double kHeatOfShear = 30;

}  // namespace

TemperaturePath::TemperaturePath(const film::FilmModel& model, const film::ThermalModel& thermal,
                                 const OperatingPoint& point, const std::optional<film::HeatState>& start)
    : model_(model), thermal_(thermal), heat_(model, thermal) {
  if (const auto* body = std::get_if<film::BodyWall>(&thermal.shell); body != nullptr && body->conduction->deforms())
    per_watt_ = body->conduction->rise.rowwise().sum().mean();
  if (start) {
    heat_.set_state(*start);
    tried_ = state();
  } else {
    fill(likely_temperature(model, thermal.T_supply, point));
  }
}

void TemperaturePath::fill(double T_oil) {
  T_oil_ = T_oil;
  film::HeatState state = heat_.state();
  state.film.setConstant(T_oil);
  try_next(std::move(state));
}

Eigen::VectorXd TemperaturePath::state() const {
  const film::HeatState& now = heat_.state();
  const Eigen::VectorXd heat = per_watt_ * now.wall_heat.head(per_watt_ > 0 ? now.wall_heat.size() : 0);
  Eigen::VectorXd x(now.film.size() + heat.size() + now.thinning.size());
  x << now.film.array() - thermal_.T_supply, heat, kHeatOfShear * now.thinning.array().log();
  return x;
}

void TemperaturePath::put(const Eigen::VectorXd& x, film::HeatState& next) const {
  next.film = x.head(next.film.size()).array() + thermal_.T_supply;
  if (per_watt_ > 0) next.wall_heat = x.segment(next.film.size(), next.wall_heat.size()) / per_watt_;
  next.thinning = (x.tail(next.thinning.size()) / kHeatOfShear).array().exp();
}

void TemperaturePath::try_next(film::HeatState next) {
  next.film = next.film.cwiseMax(coldest_trial).cwiseMin(hottest_trial);
  heat_.set_state(next);
  tried_ = state();
}

void TemperaturePath::take() {
  last_ = tried_;
  image_ = state();
  nearness_ = std::min(1.0, (image_ - last_).cwiseAbs().maxCoeff() / (1 + image_.cwiseAbs().maxCoeff()));
}

void TemperaturePath::step_on(int turn) {
  if (turn == kTurnsOfAcceleration) mixing_ = solver::FixedPointIteration(solver::Acceleration::constant, kSlowShare);
  film::HeatState next = heat_.state();
  if (T_oil_) {
    next = film::first_guess(model_, thermal_, *T_oil_, std::move(next));
  } else {
    put(mixing_.next(last_, image_), next);
  }
  T_oil_.reset();
  try_next(std::move(next));
}

bool TemperaturePath::step_back() {
  if (last_.size() == 0) {
    if (!T_oil_ || *T_oil_ == thermal_.T_supply) return false;
    fill(thermal_.T_supply);
    return true;
  }
  if (++steps_back_ > kMostStepsBack) return false;
  film::HeatState next = heat_.state();
  put(0.5 * (tried_ + last_), next);
  mixing_.begin_step();
  try_next(std::move(next));
  return true;
}

}  // namespace hersey::bearing
