#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> plane_slider_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"h_min_y", "", "m", "position along the sliding direction of the minimum film thickness"},
      {"p_max_y", "", "m", "position along the sliding direction of the peak pressure"},
      {"film_thickness_middle", "", "m", "distance of the runner from the middle of the pad's face"},
      {"slope", "", "1", "slopes of the runner",
       "slopes of the runner along and across the sliding direction, in the pad's frame"},
      {"sliding_speed", "U", "m/s", "sliding speed", "speed of the runner along the pad's y-axis"},
      {"rupture_y", "", "m", "the film ruptures at mid-width at y",
       "where the film at mid-width ruptures; NaN where it is whole"},
      {"reformation_y", "", "m", "the film re-forms at mid-width at y", "where it re-forms; NaN where it is whole"},
      {"approach_speed", "", "m/s", "speed of approach"},
      {"tilt_along", "", "1", "slope along the sliding direction"},
      {"tilt_across", "", "1", "slope across the sliding direction"},
      {"centre_y", "", "m", "centre of pressure, y"},
      {"centre_z", "", "m", "centre of pressure, z"},
      {"load_number", "", "1", "load number W h_min^2/(6 mu |U| L B^2), B along and L across the sliding direction"},
      {"friction_runner", "", "1", "friction coefficient, runner"},
      {"force_runner", "", "N", "friction force on the runner, against y"},
      {"force_pad", "", "N", "force on the pad along its face"},
      {"stiffness", "", "N/m", "stiffness against approach"},
      {"stiffness_along", "", "N.m", "stiffness against tilt along, moment about the pad's middle"},
      {"stiffness_across", "", "N.m", "stiffness against tilt across"},
      {"stiffness_coupling", "", "N", "load by tilt along"},
      {"damping", "", "N.s/m", "damping of approach"},
      {"damping_along", "", "N.m.s", "damping of tilt along"},
      {"damping_across", "", "N.m.s", "damping of tilt across"},
  });
  return table;
}

}  // namespace hersey::bearing
