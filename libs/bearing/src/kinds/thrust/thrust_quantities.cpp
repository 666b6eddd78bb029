#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> thrust_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"h_min_r", "", "m", "radius of the minimum film thickness"},
      {"p_max_r", "", "m", "radius of the peak pressure"},
      {"film_thickness_axis", "", "m", "film thickness on the axis",
       "distance of the runner from the stator's plane on the stator's axis"},
      {"runner_speed", "omega", "rad/s", "speed of the runner",
       "angular velocity of the runner about the stator's z-axis"},
      {"runner_tilt", "", "1", "slopes of the runner's axis",
       "slopes of the runner's axis towards x and y, in the stator's frame"},
      {"centre_x", "", "m", "centre of pressure, x"},
      {"thrust_number", "", "1", "load number W h_min^2/(mu omega r_o^4), r_o the outer radius"},
      {"torque_runner", "", "N.m", "friction torque on the runner", "friction torque on the runner about its own axis"},
      {"torque_stator", "", "N.m", "torque on the stator",
       "torque of film and contact on the stator about its own axis"},
      {"flow_inner", "", "m^3/s", "flow out over the inner edges",
       "oil leaving over the inner edges, mean of the step; negative: it comes in"},
      {"flow_outer", "", "m^3/s", "flow out over the outer edges",
       "oil leaving over the outer edges, mean of the step; negative: it comes in"},
      {"pad_load_<name>", "", "N", "load of pad <name>", "axial force of film and contact on this pad"},
      {"pad_centre_r_<name>", "", "m", "radius of the centre of pressure of pad <name>"},
      {"pad_centre_angle_<name>", "", "rad", "angle of the centre of pressure of pad <name>",
       "angle of the centre of pressure from the leading edge of this pad"},
      {"pad_h_min_<name>", "", "m", "minimum film thickness of pad <name>"},
      {"pad_p_max_<name>", "", "Pa", "peak pressure of pad <name>"},
      {"pad_flow_in_<name>", "", "m^3/s", "flow into pad <name> over its leading edge"},
      {"pad_tilt_along_<name>", "", "rad", "tilt of pad <name> along the sense of rotation",
       "positive: the gap is wider at the leading edge"},
      {"pad_tilt_across_<name>", "", "rad", "tilt of pad <name> along the radius",
       "positive: the gap is wider at the outer edge"},
      {"tilting_stiffness_<ij>", "", "N.m", "tilting stiffness <ij>",
       "moment against the slope of the runner's axis towards the first direction, by the slope towards the second"},
      {"tilting_damping_<ij>", "", "N.m.s", "tilting damping <ij>",
       "the same moment by the rate of the slope towards the second direction"},
      {"load_by_tilt_<i>", "", "N", "axial force by tilt <i>",
       "cross stiffness: fall of the load by the slope of the runner's axis in this direction"},
      {"moment_by_distance_<i>", "", "N", "moment <i> by film thickness",
       "cross stiffness: moment against the slope of the runner's axis in this direction, by the distance"},
      {"load_by_tilting_<i>", "", "N.s", "axial force by tilting <i>", "cross damping: the same by the slope's rate"},
      {"moment_by_approach_<i>", "", "N.s", "moment <i> by approach",
       "cross damping: the same moment by the rate of the distance"},
  });
  return table;
}

}  // namespace hersey::bearing
