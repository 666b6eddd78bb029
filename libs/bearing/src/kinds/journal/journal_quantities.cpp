#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> journal_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"h_min_phi", "", "rad", "angle of the minimum film thickness"},
      {"p_max_phi", "", "rad", "angle of the peak pressure"},
      {"eccentricity", "e", "m", "eccentricity", "journal axis from bore axis at z = 0, bearing frame"},
      {"eccentricity_ratio", "epsilon", "1", "eccentricity ratio",
       "eccentricity over radial clearance (at temperature)"},
      {"clearance", "c", "m", "radial clearance at temperature (hot)",
       "radial clearance at the temperatures of the walls"},
      {"attitude", "", "rad", "attitude angle", "angle between load and line of centres"},
      {"tilt", "", "1", "slope of the journal's axis", "slope of the journal's axis in the bearing frame"},
      {"speed", "omega", "rad/s", "relative speed of the journal", "journal's angular velocity relative to the shell"},
      {"torque_journal", "", "N.m", "friction torque on the journal",
       "friction torque on the journal about its own axis"},
      {"torque_shell", "", "N.m", "friction torque on the shell", "friction torque on the shell about its own axis"},
      {"rupture_angle", "", "rad", "the film ruptures at mid-width at",
       "where the film at mid-width ruptures; NaN where it is whole"},
      {"reformation_angle", "", "rad", "the film re-forms at mid-width at", "where it re-forms; NaN where it is whole"},
      {"h_min_around", "", "m", "minimum film thickness around",
       "smallest film thickness over the width at each angle of fields/phi"},
      {"p_max_around", "", "Pa", "peak pressure around",
       "largest film pressure over the width at each angle of fields/phi"},
      {"journal_speed", "", "rad/s", "journal speed"},
      {"shell_speed", "", "rad/s", "shell speed"},
      {"load_angle", "", "rad", "direction of the load"},
      {"eccentricity_angle", "", "rad", "direction of the eccentricity"},
      {"clearance_cold", "", "m", "radial clearance as given, cold"},
      {"clearance_hot", "", "m", "radial clearance at temperature, hot", "clearance of a steady solution"},
      {"radial_velocity", "", "m/s", "velocity along the eccentricity"},
      {"h_min_angle", "", "rad", "angle of the minimum film thickness", "h_min_phi of a steady solution"},
      {"p_max_angle", "", "rad", "angle of the peak pressure", "p_max_phi of a steady solution"},
      {"moment_x", "", "N.m", "moment on the shell, x"},
      {"moment_y", "", "N.m", "moment on the shell, y"},
      {"deformation_shell", "", "m", "largest displacement of the shell, outward"},
      {"deformation_journal", "", "m", "largest displacement of the journal, outward"},
      {"tilt_x", "", "1", "slope of the journal against the shell under load, x"},
      {"tilt_y", "", "1", "slope of the journal against the shell under load, y"},
      {"shell_turn", "", "rad", "rotation of the bearing's axes under load"},
      {"sommerfeld_S", "S", "1", "Sommerfeld number S = mu N (R/c)^2 L D/W"},
      {"sommerfeld_So", "So", "1", "Sommerfeld number So = W (c/R)^2/(L D mu omega)"},
      {"sommerfeld_squeeze", "", "1", "Sommerfeld number of squeeze W (c/R)^2/(L D mu d(eps)/dt)"},
      {"friction_journal", "", "1", "friction coefficient, journal"},
      {"friction_shell", "", "1", "friction coefficient, shell"},
      {"torque_journal_other_shear", "", "N.m", "torque on the journal, cavitated film sheared the other way"},
      {"load_on_shear", "", "1", "share of the load on the net force of shear"},
      {"film_ratio", "", "1", "film ratio h_min/sigma"},
      {"arc_load_share_<name>", "", "1", "part of the load on arc <name>", "its force along the load over the load"},
      {"arc_h_min_<name>", "", "m", "minimum film thickness of arc <name>"},
      {"arc_p_max_<name>", "", "Pa", "peak pressure of arc <name>"},
      {"arc_flow_in_<name>", "", "m^3/s", "flow into arc <name> over its ends"},
      {"critical_mass", "", "kg", "critical mass of a rigid rotor"},
      {"whirl_ratio", "", "1", "whirl frequency ratio"},
      {"stability_number", "", "1", "omega sqrt(c/g) at the threshold"},
      {"threshold_speed", "", "rad/s", "threshold speed under the load's own weight"},
      {"stiffness_<ij>", "k", "N/m", "stiffness, bearing axes, <ij>"},
      {"damping_<ij>", "b", "N.s/m", "damping, bearing axes, <ij>"},
      {"K_<ij>", "K", "1", "K = k c/W, x along the load, <ij>"},
      {"C_<ij>", "C", "1", "C = b c omega/W, x along the load, <ij>"},
  });
  return table;
}

}  // namespace hersey::bearing
