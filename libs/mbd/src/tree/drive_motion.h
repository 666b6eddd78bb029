#pragma once

#include <memory>

#include "hersey/core/archive.h"
#include "hersey/core/scalar_function.h"
#include "hersey/core/settable_function.h"
#include "hersey/mbd/mechanism_spec.h"

namespace hersey::mbd {

/// A drive's prescribed coordinate as a function of time (theory manual eq. (mechanisms.20)), with its derivatives.
class DriveMotion {
 public:
  /// @param initial       the coordinate at t = 0, where a speed starts counting
  /// @param initial_rate  its rate there, where an acceleration starts
  DriveMotion(const DriveSpec& spec, double initial, double initial_rate = 0);

  /// Position at t. A constant speed gives exactly initial + omega t; any other speed or acceleration is integrated
  /// adaptively from the last anchor, to 1e-12 relative.
  [[nodiscard]] double position(double t) const;
  [[nodiscard]] double velocity(double t) const;
  [[nodiscard]] double acceleration(double t) const;

  /// Moves the anchor of the integration to t: the cost of `position` grows with the distance from it.
  void anchor(double t);

  /// The anchor.
  void persist(Archive& archive);

 private:
  [[nodiscard]] double value(double t) const;
  [[nodiscard]] double slope(double t) const;
  [[nodiscard]] bool counts_from_start() const;

  DriveSpec::Kind kind_;
  std::shared_ptr<const ScalarFunction> function_;
  bool constant_ = false;
  const SettableFunction* settable_;  ///< `function_`, where it is an input; else null
  double initial_;
  double anchor_time_ = 0;
  double anchor_position_ = 0;
  double anchor_rate_ = 0;
};

}  // namespace hersey::mbd
