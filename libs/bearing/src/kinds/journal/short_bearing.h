#pragma once

#include <Eigen/Dense>

#include "hersey/bearing/operating_point.h"
#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// Where Ocvirk's short bearing (half film) of the same size carries the load of `point` [m].
[[nodiscard]] Eigen::Vector2d ocvirk_position(const film::FilmModel& model, const OperatingPoint& point);

/// One temperature of the oil at which power and side flow of such a bearing agree with oil that comes at T_supply
/// (theory manual, thermal.30) [K].
[[nodiscard]] double likely_temperature(const film::FilmModel& model, double T_supply, const OperatingPoint& point);

}  // namespace hersey::bearing
