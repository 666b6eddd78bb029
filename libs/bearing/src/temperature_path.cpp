#include "temperature_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/turn.h"

namespace hersey::bearing {
namespace {

// Turns after which temperatures go this share of their way at a time, and steps back at most in all.
constexpr int kTurnsOfAcceleration = 40, kMostStepsBack = 12;
constexpr double kSlowShare = 0.3;

// No first guess thins the oil by more than this.
constexpr double kThinnestGuess = 0.2;

// Turns in which the guess finds its own viscosity, each half of the way.
constexpr int kTurnsOfGuess = 12;

// Power and side flow of a short bearing (thermal.41); beside the middle some oil always leaves.
double likely_temperature(const film::FilmModel& model, double T_supply, const OperatingPoint& point) {
  const film::Lubricant& oil = model.lubricant;
  if (!film::depends_on_temperature(oil.temperature_law)) return T_supply;
  const double U = model.R * std::abs(point.journal_speed - point.shell_speed);
  const double carried = model.R * std::abs(point.entraining_speed()) * model.c * model.L;
  const double mu_supply = film::viscosity_at(oil.temperature_law, T_supply);
  film::FilmModel at = model;
  double T = T_supply;
  for (int k = 0; k < kTurnsOfGuess && carried > 0; ++k) {
    at.lubricant.mu0 = film::viscosity_at(oil.temperature_law, T);
    if (at.lubricant.mu0 < kThinnestGuess * mu_supply) break;
    const double e = point.load ? ocvirk_position(at, point).norm() : point.e.norm();
    const double epsilon = std::clamp(e / model.c, 0.1, 0.95);
    const double power =
        at.lubricant.mu0 * U * U * turn * model.R * model.L / (model.c * std::sqrt(1 - epsilon * epsilon));
    const double rise = power / (2 * oil.density * oil.specific_heat * epsilon * carried);
    T += 0.5 * (T_supply + rise - T);
  }
  return T;
}

}  // namespace

TemperaturePath::TemperaturePath(const film::FilmModel& model, const film::ThermalModel& thermal,
                                 const OperatingPoint& point, const std::optional<film::HeatState>& start)
    : model_(model), thermal_(thermal), heat_(model, thermal) {
  if (start) {
    heat_.set_state(*start);
    tried_ = rises();
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

Eigen::VectorXd TemperaturePath::rises() const { return heat_.state().film.array() - thermal_.T_supply; }

void TemperaturePath::try_next(film::HeatState next) {
  next.film = next.film.cwiseMax(coldest_trial).cwiseMin(hottest_trial);
  heat_.set_state(next);
  tried_ = rises();
}

void TemperaturePath::take() {
  last_ = tried_;
  image_ = rises();
  nearness_ = std::min(1.0, (image_ - last_).cwiseAbs().maxCoeff() / (1 + image_.cwiseAbs().maxCoeff()));
}

void TemperaturePath::step_on(int turn) {
  if (turn == kTurnsOfAcceleration) mixing_ = solver::FixedPointIteration(solver::Acceleration::constant, kSlowShare);
  film::HeatState next = heat_.state();
  if (T_oil_) {
    next = film::first_guess(model_, thermal_, *T_oil_, std::move(next));
  } else {
    next.film = mixing_.next(last_, image_).array() + thermal_.T_supply;
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
  next.film = 0.5 * (tried_ + last_).array() + thermal_.T_supply;
  mixing_.begin_step();
  try_next(std::move(next));
  return true;
}

}  // namespace hersey::bearing
