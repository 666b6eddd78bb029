#pragma once

#include "hersey/core/archive.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/run/summary.h"
#include "observation/step_record.h"

namespace hersey::run {

/// Balance of the energy put into a machine since the start of a run. Each part is a separate integral (theory manual,
/// bearing.6); none uses the forces of the equations of motion.
class EnergyBalance {
 public:
  /// @param spec  of the machine's mechanism, which outlives this
  explicit EnergyBalance(const mbd::MechanismSpec& spec) : spec_(spec) {}

  /// The start, then every accepted step. Powers are integrated by the trapezoidal rule.
  void take(const StepRecord& step);
  /// The instant of the last step, after a jump of what acts on the machine: powers are those behind it from here on.
  /// Where speeds jump, an impulse of the drives has put in what bodies and springs have gained.
  void go_on_from(const StepRecord& step);
  [[nodiscard]] const EnergySummary& sums() const { return sums_; }
  void persist(Archive& archive);

 private:
  /// Powers of an instant [W] and energy stored in bodies and springs [J].
  struct Instant {
    double put_in = 0, films = 0, boundary_friction = 0, oil = 0, film_storage = 0, contacts = 0, dampers = 0;
    double kinetic = 0, potential = 0, springs = 0, strain = 0;
    [[nodiscard]] double stored() const { return kinetic + potential + springs + strain; }
  };
  [[nodiscard]] Instant instant_of(const StepRecord& step) const;

  const mbd::MechanismSpec& spec_;
  EnergySummary sums_;
  Instant last_;
  Instant start_;
  double brought_by_oil_ = 0;  ///< largest value since the start [J]
  bool is_begun_ = false;
};

}  // namespace hersey::run
