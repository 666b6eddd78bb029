#pragma once

#include <memory>

#include "hersey/core/scalar_function.h"
#include "hersey/mbd/coordinate_force.h"

namespace hersey::mbd {

/// A spring whose force is a function of its stretch: -f(q - free). Its energy is the integral of f from the free
/// position, continued from where the last step ended.
class FunctionSpring final : public CoordinateForce {
 public:
  /// @param function  restoring force as a function of the stretch [N or N m], positive if it opposes a positive
  /// stretch
  FunctionSpring(std::shared_ptr<const ScalarFunction> function, double free_position);
  [[nodiscard]] CoordinateEffort evaluate(double t, double position, double rate) const override;
  void accept_step(double t, double position, double rate) override;
  void persist(Archive& archive) override;
  [[nodiscard]] bool is_store() const override { return true; }
  [[nodiscard]] double stored_energy(double position) const override;

 private:
  std::shared_ptr<const ScalarFunction> function_;
  double free_position_;
  double reached_ = 0, energy_ = 0;  ///< stretch at the end of the last step, and the energy there
};

/// Dry and viscous friction (theory manual eq. (mechanisms.25)): -(coulomb v / sqrt(v^2 + transition^2) + viscous v).
/// Below the transition speed the joint creeps instead of sticking.
class JointFriction final : public CoordinateForce {
 public:
  /// @param coulomb     friction force of sliding [N] or torque [N m], >= 0
  /// @param viscous     [N s/m] or [N m s/rad], >= 0
  /// @param transition  speed at which 71 % of `coulomb` acts [m/s] or [rad/s], > 0
  JointFriction(double coulomb, double viscous, double transition);
  [[nodiscard]] CoordinateEffort evaluate(double t, double position, double rate) const override;

 private:
  double coulomb_, viscous_, transition_;
};

/// A controller that drives a coordinate to a target speed (theory manual eq. (mechanisms.26)):
///
///     u = kp (target - rate) + I,    dI/dt = ki (target - rate),    cut off at -limit and +limit.
///
/// The integral is exact in the coordinate. At the end of each step I is brought back between the limits, so that it
/// does not wind up while the controller saturates.
class SpeedController final : public CoordinateForce {
 public:
  /// @param target  speed over time [rad/s] or [m/s]
  /// @param kp      [N m s/rad] or [N s/m], >= 0
  /// @param ki      [N m/rad] or [N/m], >= 0
  /// @param limit   largest force or torque, > 0; infinity for none
  SpeedController(std::shared_ptr<const ScalarFunction> target, double kp, double ki, double limit);
  ~SpeedController() override;
  [[nodiscard]] CoordinateEffort evaluate(double t, double position, double rate) const override;
  void accept_step(double t, double position, double rate) override;
  void persist(Archive& archive) override;
  [[nodiscard]] bool is_source() const override { return true; }

 private:
  [[nodiscard]] double integral(double t, double position) const;

  struct Memory;
  std::shared_ptr<const ScalarFunction> target_;
  double kp_, ki_, limit_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace hersey::mbd
