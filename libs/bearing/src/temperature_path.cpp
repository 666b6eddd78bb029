#include "temperature_path.h"

#include <algorithm>
#include <cmath>
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
  if (thermal.expansion) {
    const double largest = std::max(std::abs(thermal.expansion->shell), std::abs(thermal.expansion->journal));
    if (largest > 0) per_metre_ = 1 / (model.R * largest);
  }
  if (start) {
    heat_.set_state(*start);
    growth_ = called_for();
    tried_ = unknowns(growth_);
  } else {
    fill(likely_temperature(model, thermal.T_supply, point));
  }
}

void TemperaturePath::fill(double T_oil) {
  T_oil_ = T_oil;
  film::HeatState state = heat_.state();
  state.film.setConstant(T_oil);
  try_next(std::move(state), called_for());
}

// By the walls as they are now (thermal.32).
double TemperaturePath::called_for() const {
  if (per_metre_ == 0) return 0;
  const film::HeatObservables& seen = heat_.observables();
  return thermal_.expansion->growth(model_.R, seen.T_shell_wall, seen.T_journal_wall);
}

Eigen::VectorXd TemperaturePath::unknowns(double growth) const {
  const film::HeatState& now = heat_.state();
  Eigen::VectorXd x(now.film.size() + now.thinning.size() + (per_metre_ > 0 ? 1 : 0));
  x.head(now.film.size()) = now.film.array() - thermal_.T_supply;
  x.segment(now.film.size(), now.thinning.size()) = kHeatOfShear * now.thinning.array().log();
  if (per_metre_ > 0) x[x.size() - 1] = per_metre_ * growth;
  return x;
}

void TemperaturePath::try_next(film::HeatState next, double growth) {
  next.film = next.film.cwiseMax(coldest_trial).cwiseMin(hottest_trial);
  heat_.set_state(next);
  growth_ = growth;
  tried_ = unknowns(growth);
}

void TemperaturePath::try_next(const Eigen::VectorXd& x) {
  film::HeatState next = heat_.state();
  next.film = x.head(next.film.size()).array() + thermal_.T_supply;
  next.thinning = (x.segment(next.film.size(), next.thinning.size()) / kHeatOfShear).array().exp();
  try_next(std::move(next), per_metre_ > 0 ? x[x.size() - 1] / per_metre_ : 0);
}

void TemperaturePath::take() {
  last_ = tried_;
  image_ = unknowns(called_for());
  nearness_ = std::min(1.0, (image_ - last_).cwiseAbs().maxCoeff() / (1 + image_.cwiseAbs().maxCoeff()));
}

void TemperaturePath::step_on(int turn) {
  if (turn == kTurnsOfAcceleration) mixing_ = solver::FixedPointIteration(solver::Acceleration::constant, kSlowShare);
  if (T_oil_) {
    try_next(film::first_guess(model_, thermal_, *T_oil_, heat_.state()), called_for());
  } else {
    try_next(mixing_.next(last_, image_));
  }
  T_oil_.reset();
}

bool TemperaturePath::step_back() {
  if (last_.size() == 0) {
    if (!T_oil_ || *T_oil_ == thermal_.T_supply) return false;
    fill(thermal_.T_supply);
    return true;
  }
  if (++steps_back_ > kMostStepsBack) return false;
  const Eigen::VectorXd half = 0.5 * (tried_ + last_);
  mixing_.begin_step();
  try_next(half);
  return true;
}

}  // namespace hersey::bearing
