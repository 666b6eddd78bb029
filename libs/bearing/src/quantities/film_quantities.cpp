#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> film_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"h_min", "h_min", "m", "minimum film thickness",
       "smallest film thickness beside features with depth, edges included"},
      {"h_min_z", "", "m", "axial position of the minimum film thickness"},
      {"h_min_centre", "", "m", "minimum film thickness at mid-width", "smallest film thickness at z = 0"},
      {"h_min_features", "", "m", "minimum thickness over features with depth",
       "smallest thickness over features with depth, that included"},
      {"p_max", "p_max", "Pa", "peak film pressure", "peak film pressure, interpolated"},
      {"p_max_z", "", "m", "axial position of the peak pressure"},
      {"p_max_node", "", "Pa", "largest nodal film pressure"},
      {"force", "F", "N", "film force", "film force on the shell, bearing frame"},
      {"force_pressure", "", "N", "part of the film force from pressure"},
      {"force_shear", "", "N", "part of the film force from shear"},
      {"force_asperity", "", "N", "part of the film force from asperity contact"},
      {"moment", "", "N.m", "film moment", "film moment on the shell about the bearing's origin"},
      {"power_film", "", "W", "friction power, film", "viscous dissipation in the film"},
      {"power_film_other_shear", "", "W", "friction power, film, cavitated film sheared the other way",
       "power_film were the cavitated film sheared as the other choice of `cavitated_shear` has it"},
      {"power_asperity", "", "W", "friction power, asperities", "boundary friction"},
      {"power_stored", "", "W", "rate of stored energy", "rate of the energy in liner, asperities and compressed oil"},
      {"power_oil", "", "W", "power carried out by the oil", "taken along by oil over the edges less what feeds bring"},
      {"power_into_bodies", "", "W", "power into the bodies",
       "film wrench times relative velocity, and on walls that grow (negative: taken)"},
      {"power_error", "", "W", "power not explained by the film's integrals",
       "put in by the bodies less dissipated, stored and carried out"},
      {"flow_left", "", "m^3/s", "flow over the edge z < 0", "oil leaving over the edge z = -L/2, mean of the step"},
      {"flow_right", "", "m^3/s", "flow over the edge z > 0", "oil leaving over the edge z = +L/2, mean of the step"},
      {"flow_leading", "", "m^3/s", "flow out over the leading end",
       "oil leaving over the leading end, mean of the step; negative: it comes in"},
      {"flow_trailing", "", "m^3/s", "flow out over the trailing end",
       "oil leaving over the trailing end, mean of the step"},
      {"flow_supply", "", "m^3/s", "flow through the supply", "oil entering through the supply, mean of the step"},
      {"flow_feature_<name>", "", "m^3/s", "flow through <name>",
       "oil entering through this feature, mean of the step"},
      {"storage_rate", "", "m^3/s", "rate of change of the oil volume",
       "rate of change of the oil volume in the film, mean of the step"},
      {"oil_volume", "", "m^3", "oil in the film"},
      {"mass_balance_error", "", "1", "mass balance error",
       "oil of the step that is neither stored nor has passed, over the largest flow"},
      {"oil_through_flow", "", "m^3", "oil that has passed", "oil that has passed the film since the start"},
      {"oil_unexplained", "", "m^3", "unexplained oil",
       "growth of the oil volume since the start less what has come in"},
      {"cavitated_share", "", "1", "cavitated share of the area"},
      {"film_iterations", "", "1", "film linearisations", "film linearisations in the step"},
      {"exchanges", "", "1", "exchanges of wrenches",
       "wrenches that film and bodies exchanged in the step; 0: it was solved as one system"},
      {"load", "W", "N", "load"},
      {"hersey", "", "1", "Hersey number", "mu N L D/W of a journal, mu |U| L/W of a slider"},
      {"power_put_in", "", "W", "power put in by motion and load"},
      {"asperity_share", "", "1", "share of the load on asperities"},
      {"side_flow", "", "m^3/s", "flow over both sides"},
      {"power_error_share", "", "1", "share of the power not explained by the film's integrals"},
  });
  return table;
}

}  // namespace hersey::bearing
