#include "hersey/mbd/coordinate_laws.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "tree/quadrature.h"

namespace hersey::mbd {

FunctionSpring::FunctionSpring(std::shared_ptr<const ScalarFunction> function, double free_position)
    : function_(std::move(function)), free_position_(free_position) {
  HERSEY_REQUIRE(function_ != nullptr, "a spring has a function of its stretch");
}

CoordinateEffort FunctionSpring::evaluate(double, double position, double) const {
  const double stretch = position - free_position_;
  double slope = 0;
  function_->gradient({&stretch, 1}, {&slope, 1});
  return {-function_->value({&stretch, 1}), -slope, 0};
}

double FunctionSpring::stored_energy(double position) const {
  return energy_ + integrate(
                       [&](double stretch) {
                         return function_->value({&stretch, 1});
                       },
                       reached_, position - free_position_);
}

void FunctionSpring::accept_step(double, double position, double) {
  energy_ = stored_energy(position);
  reached_ = position - free_position_;
}

void FunctionSpring::persist(Archive& archive) { archive.io("reached", reached_), archive.io("energy", energy_); }

JointFriction::JointFriction(double coulomb, double viscous, double transition)
    : coulomb_(coulomb), viscous_(viscous), transition_(transition) {
  HERSEY_REQUIRE(coulomb >= 0 && viscous >= 0 && transition > 0, "friction takes energy");
}

CoordinateEffort JointFriction::evaluate(double, double, double rate) const {
  const double s = std::hypot(rate, transition_);
  return {-coulomb_ * rate / s - viscous_ * rate, 0, -coulomb_ * transition_ * transition_ / (s * s * s) - viscous_};
}

/// State at the end of the last step.
struct SpeedController::Memory {
  bool started = false;
  double t = 0, position = 0, integral = 0;
};

SpeedController::SpeedController(std::shared_ptr<const ScalarFunction> target, double kp, double ki, double limit)
    : target_(std::move(target)), kp_(kp), ki_(ki), limit_(limit), memory_(std::make_unique<Memory>()) {
  HERSEY_REQUIRE(target_ != nullptr, "a controller has a target");
  HERSEY_REQUIRE(kp >= 0 && ki >= 0 && limit > 0, "a controller's gains are not negative");
}

SpeedController::~SpeedController() = default;

double SpeedController::integral(double t, double position) const {
  if (!memory_->started || ki_ == 0) return 0;
  const double wanted = integrate([&](double s) { return target_->value({&s, 1}); }, memory_->t, t);
  return memory_->integral + ki_ * (wanted - (position - memory_->position));
}

CoordinateEffort SpeedController::evaluate(double t, double position, double rate) const {
  const double u = kp_ * (target_->value({&t, 1}) - rate) + integral(t, position);
  if (std::abs(u) > limit_) return {std::copysign(limit_, u), 0, 0};
  return {u, memory_->started ? -ki_ : 0, -kp_};
}

void SpeedController::accept_step(double t, double position, double) {
  memory_->integral = std::clamp(integral(t, position), -limit_, limit_);
  memory_->t = t;
  memory_->position = position;
  memory_->started = true;
}

void SpeedController::persist(Archive& archive) {
  archive.io("started", memory_->started);
  archive.io("t", memory_->t);
  archive.io("position", memory_->position);
  archive.io("integral", memory_->integral);
}

}  // namespace hersey::mbd
