#pragma once

#include <Eigen/Dense>
#include <array>

#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"
#include "kinds/plane_slider/slider_kinematics.h"

namespace hersey::bearing {

using SliderParameters = Eigen::Matrix<double, kSliderParameterCount, 1>;

/// The gap between a rigid pad and a rigid runner (theory manual, slider.4). One object per bearing and thread; no
/// allocation after the first call.
class SliderSurfaces {
 public:
  /// @param opening  of the gap by the pad's shapes at the nodes [m], shape (grid.size())
  SliderSurfaces(const film::FilmModel& model, Eigen::VectorXd opening);

  /// Writes gap, rate and speeds at these parameters into `motion`.
  /// @param growth,growth_rate  by which the surfaces move apart everywhere [m, m/s]
  void evaluate(const SliderParameters& parameters, double growth, double growth_rate, film::SurfaceMotion& motion);
  /// Change of the surfaces with a unit of one SliderParameter.
  [[nodiscard]] const film::MotionDirection& direction(Eigen::Index parameter) const {
    return directions_[static_cast<std::size_t>(parameter)];
  }
  /// Smallest gap at a node at the parameters last evaluated [m]; exact for a plane pad, whose corners are nodes.
  [[nodiscard]] double smallest_gap() const { return smallest_gap_; }

 private:
  Eigen::VectorXd y_, z_;    // of every node [m]
  Eigen::VectorXd opening_;  // of the pad's shapes [m]
  std::array<film::MotionDirection, kSliderParameterCount> directions_;
  double smallest_gap_ = 0;
};

}  // namespace hersey::bearing
