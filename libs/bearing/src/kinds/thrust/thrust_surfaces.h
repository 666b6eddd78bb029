#pragma once

#include <Eigen/Dense>
#include <array>

#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"
#include "kinds/thrust/thrust_kinematics.h"

namespace hersey::bearing {

using ThrustParameters = Eigen::Matrix<double, kThrustParameterCount, 1>;

/// The gap between the pads of a rigid stator and a rigid runner (theory manual, thrust.4). One object per bearing and
/// thread; no allocation after the first call.
class ThrustSurfaces {
 public:
  /// @param opening  of the gap by the pads' shapes at the nodes [m], shape (grid.size())
  ThrustSurfaces(const film::FilmModel& model, Eigen::VectorXd opening);

  /// Writes gap, rate and speeds at these parameters into `motion`.
  /// @param growth,growth_rate  by which the surfaces move apart everywhere [m, m/s]
  void evaluate(const ThrustParameters& parameters, double growth, double growth_rate, film::SurfaceMotion& motion);
  /// Change of the surfaces with a unit of one ThrustParameter.
  [[nodiscard]] const film::MotionDirection& direction(Eigen::Index parameter) const {
    return directions_[static_cast<std::size_t>(parameter)];
  }
  /// Smallest gap at a node at the parameters last evaluated [m].
  [[nodiscard]] double smallest_gap() const { return smallest_gap_; }

 private:
  double R_ = 1;             // mean radius [m]
  Eigen::VectorXd x_, y_;    // of every node [m]
  Eigen::VectorXd opening_;  // of the pads' shapes [m]
  std::array<film::MotionDirection, kThrustParameterCount> directions_;
  double smallest_gap_ = 0;
};

}  // namespace hersey::bearing
