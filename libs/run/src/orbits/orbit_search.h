#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hersey/core/outcome.h"
#include "orbits/branch_point.h"
#include "orbits/orbit_machine.h"
#include "time_stepping/shooting.h"

namespace hersey::run {

/// An orbit, or why there is none.
struct [[nodiscard]] FoundOrbit : Outcome {
  BranchPoint point;
};

/// Plane across a branch in which its next orbit is sought.
struct AcrossBranch {
  MotionAtValue predicted;    ///< in it
  Eigen::VectorXd direction;  ///< of the branch there, of unit length in `metric`
  BranchMetric metric;
  bool keeps_value = false;  ///< it is the plane of that value
};

/// Finds orbits of a machine whose parameter is free, too. Keeps the machine at the value last wanted.
class OrbitSearch {
 public:
  /// @param model_at, options  outlive this
  OrbitSearch(const std::function<model::Model(double)>& model_at, const BranchOptions& options);

  /// Finds the orbit to which shooting leads from the model's start.
  [[nodiscard]] FoundOrbit first(double value);
  /// Finds the orbit in a plane across the branch by trials, each at the motion and the value that those before it
  /// predict (theory manual, integrator.48).
  /// @param near  trials of orbits beside it
  [[nodiscard]] FoundOrbit next(const AcrossBranch& plane, std::vector<PeriodTrial> near);

  /// Returns a motion near the last orbit at the same phase as that: on the section of a machine whose period is found.
  [[nodiscard]] MotionAtValue onto_section(MotionAtValue at) const;

  [[nodiscard]] const mbd::Mechanism& mechanism() { return machine_->map().mechanism(); }
  [[nodiscard]] const std::vector<ObservedQuantity>& observed() const { return observed_; }
  [[nodiscard]] bool finds_period() const { return finds_period_; }
  /// True if the search was stopped from outside.
  [[nodiscard]] bool is_stopped() const { return options_.stop != nullptr && options_.stop->load(); }

 private:
  OrbitMachine& machine_at(double value, double period);
  [[nodiscard]] Shooting shoot_first(PeriodMap& map) const;
  [[nodiscard]] FoundOrbit search(const AcrossBranch& plane, std::vector<PeriodTrial> near);
  [[nodiscard]] FoundOrbit complete(const MotionAtValue& at, int periods);

  const std::function<model::Model(double)>& model_at_;
  const BranchOptions& options_;
  std::unique_ptr<OrbitMachine> machine_;
  double value_ = 0;  // of its parameter
  bool finds_period_ = false;
  std::vector<ObservedQuantity> observed_;
};

}  // namespace hersey::run
