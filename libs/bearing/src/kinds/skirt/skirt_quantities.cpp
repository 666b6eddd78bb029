#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> skirt_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"skirt_speed", "V", "m/s", "speed of the skirt", "along its axis, positive towards the crown"},
      {"offset_top", "e_t", "m", "offset at the skirt's top",
       "how far the skirt's axis is off that of the liner towards the thrust side, at the end next to the crown"},
      {"offset_bottom", "e_b", "m", "offset at the skirt's bottom", "the same at the other end"},
      {"velocity_top", "", "m/s", "velocity of the offset at the top"},
      {"velocity_bottom", "", "m/s", "velocity of the offset at the bottom"},
      {"skirt_tilt", "", "1", "slope of the skirt's axis",
       "slope of the skirt's axis against that of the liner, towards the thrust side and along the pin"},
      {"skirt_slope", "", "1", "slope of the skirt's axis towards the thrust side",
       "positive where the skirt's top is nearer to the thrust side than its bottom"},
      {"side_force", "F_s", "N", "side force",
       "that presses the skirt towards the thrust side: what that side bears, less the other, with shear"},
      {"side_force_<side>", "", "N", "force of film and contact on the <side> side"},
      {"centre_<side>", "", "m", "place of that force along the axis, <side> side",
       "above the middle of the skirt's length; NaN where nothing bears"},
      {"h_min_<side>", "", "m", "minimum film thickness of the <side> side"},
      {"p_max_<side>", "", "Pa", "peak pressure of the <side> side"},
      {"skirt_friction", "", "N", "friction force on the skirt",
       "along the liner's axis, positive towards the crown: shear, contact, and pressure on the slopes of the shape"},
      {"skirt_shear", "", "N", "shear force on the skirt",
       "of the oil alone, along the axis, positive towards the crown"},
      {"skirt_friction_power", "", "W", "friction power of the skirt", "of film and contact together"},
      {"skirt_moment", "", "N.m", "moment of the side forces",
       "about the middle of the skirt's length, positive where it pushes the skirt's top away from the thrust side"},
      {"friction_skirt", "", "1", "friction coefficient, skirt", "friction force over side force"},
      {"flow_top", "", "m^3/s", "flow out at the top"},
      {"flow_bottom", "", "m^3/s", "flow out at the bottom"},
      {"starved_share", "", "1", "starved share of the area",
       "from the edge that leads to the first full film behind it, where too little oil comes in"},
      {"flow_scraped", "", "m^3/s", "oil scraped off",
       "of the layer on the liner: what finds no room at the edge that leads"},
      {"stiffness_side", "k", "N/m", "stiffness against side motion"},
      {"stiffness_tilt", "", "N.m", "stiffness against tilt, moment about the middle by slope"},
      {"stiffness_side_by_tilt", "", "N", "side force by slope"},
      {"damping_side", "b", "N.s/m", "damping of side motion"},
      {"damping_tilt", "", "N.m.s", "damping of tilt"},
      {"damping_side_by_tilt", "", "N.s", "side force by rate of the slope"},
  });
  return table;
}

}  // namespace hersey::bearing
