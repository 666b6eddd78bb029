#pragma once

#include <algorithm>

#include "interpret/bearings/kinds/film_reader.h"

namespace hersey::model {

/// Reads what operating points of surfaces that approach each other along a normal have in common: speed, and either a
/// load or a film thickness with a speed of approach. Reports what is missing or excludes another.
/// @param area  on which the load acts [m^2]
/// @return false if something of the point has been reported
template <class Point>
bool read_approach(Context& context, const Value& value, double area, const Bearing& bearing, Point& point) {
  point.position = value.key_position;
  point.speed = number_of(value, "speed");
  point.approach_speed = number_of(value, "approach_speed");
  const Value *load = given(value, "load"), *thickness = given(value, "film_thickness");
  if (thickness != nullptr) point.film_thickness = thickness->number;
  if (load != nullptr) {
    point.load = load->number;
    require_bearable(context, *load, area);
  }
  if (load == nullptr && thickness == nullptr) {
    context.fault_at_key(value, "neither 'load' nor 'film_thickness'", "exactly one of them");
  } else if (load != nullptr && thickness != nullptr) {
    context.fault_at_key(*thickness, "keys 'load' and 'film_thickness' together", "exactly one of them",
                         "with --set, give the other one as 'none'");
  }
  if (context.has_fault_in(value.path)) return false;
  if (load != nullptr && point.approach_speed != 0) {
    context.fault(*value.find("approach_speed"), "a velocity along a film thickness that is sought",
                  "an approach_speed with a film_thickness", "its load is found");
    return false;
  }
  const bool is_smooth = bearing.film.asperities.model == film::AsperityModel::none;
  const bool is_fed = std::any_of(bearing.film.features.begin(), bearing.film.features.end(),
                                  [](const auto& feature) { return feature.is_fed; });
  if (is_smooth && !is_fed && point.speed == 0 && point.approach_speed == 0) {
    context.fault(*value.find("speed"), "a runner at rest, which drags no oil into the gap",
                  "a speed, an approach_speed, a hole or pocket with a pressure, or asperities");
    return false;
  }
  return true;
}

}  // namespace hersey::model
