#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> squeeze_film_damper_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"whirl_speed", "", "rad/s", "whirl speed",
       "angular velocity of the orbit, or angular frequency of small motions"},
      {"orbit_ratio", "", "1", "orbit radius over the radial clearance"},
      {"force_radial", "", "N", "force of the film on the journal, radially outwards"},
      {"force_tangential", "", "N", "force of the film on the journal, along its orbital motion"},
      {"orbit_stiffness", "", "N/m", "stiffness of the orbit, minus radial force over radius"},
      {"orbit_damping", "", "N.s/m", "damping of the orbit, minus tangential force over speed"},
      {"K_orbit", "K", "1", "K = k c^3/(mu |whirl speed| R L^3)", "stiffness of the orbit, made dimensionless"},
      {"C_orbit", "C", "1", "C = b c^3/(mu R L^3)", "damping of the orbit, made dimensionless"},
      {"added_mass_<ij>", "M", "kg", "added mass of the oil, <ij>",
       "force of the oil's inertia per acceleration, x and y of the axes of the position, <ij>"},
      {"squeeze_reynolds", "", "1", "squeeze Reynolds number rho |whirl speed| c^2/mu"},
  });
  return table;
}

}  // namespace hersey::bearing
