#pragma once

#include <memory>

#include "hersey/core/scalar_function.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// Linear spring and damper along the line between two frame origins (theory manual eq. (mechanisms.23)):
/// pulls B towards A with  f = stiffness (l - free_length) + damping dl/dt + tension(l).
///
/// At zero distance the direction is undefined: a spring of free length 0 passes smoothly through it without its
/// damper; any other reports a domain error.
class SpringDamper final : public TwoBodyForce {
 public:
  /// @param stiffness    [N/m], >= 0
  /// @param damping      [N s/m], >= 0
  /// @param free_length  [m], >= 0
  /// @param tension      further pull as a function of the length alone [N]; null for none. Its energy is its integral
  ///                     from the length at the first step's start, so that a singularity at length 0 has no effect.
  SpringDamper(double stiffness, double damping, double free_length,
               std::shared_ptr<const ScalarFunction> tension = nullptr);

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] double lost_power(const RelativeMotion& motion) const override;
  [[nodiscard]] std::string domain_error() const override;
  void begin_step(const RelativeMotion& start, double dt) override;
  void accept_step(const RelativeMotion& end) override;
  void persist(Archive& archive) override;

 private:
  [[nodiscard]] double energy_of_tension(double length) const;

  double stiffness_, damping_, free_length_;
  std::shared_ptr<const ScalarFunction> tension_;
  bool collapsed_ = false;
  /// Length at the end of the last step, and the energy of `tension_` there; negative before the first step.
  double reached_ = -1, energy_ = 0;
};

}  // namespace hersey::mbd
