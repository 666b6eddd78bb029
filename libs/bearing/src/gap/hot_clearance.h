#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/film/film_model.h"
#include "hersey/film/heat_state.h"

namespace hersey::bearing {

/// Radial clearance at temperature where a bearing is tightest along its axis (theory manual, thermal.64).
struct HotClearance {
  double smallest = 0;     ///< mean around, there [m]
  double z = 0;            ///< where along the axis [m]
  bool has_shape = false;  ///< it differs along the axis
};

/// @param growth  of the clearance by the walls' coefficients [m] (thermal.42)
/// @param shell, journal  how far these lie outside their cylinders at the nodes by temperature [m]; empty: nowhere
[[nodiscard]] HotClearance hot_clearance(const film::FilmModel& model, double growth, const Eigen::VectorXd& shell,
                                         const Eigen::VectorXd& journal);

/// Walls that have grown into each other, in words. @param place  where the journal is; empty: left out
[[nodiscard]] std::string seizure_text(const film::FilmModel& model, const HotClearance& hot,
                                       const film::HeatObservables& observed, const std::string& place = {});

}  // namespace hersey::bearing
