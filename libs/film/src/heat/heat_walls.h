#pragma once

#include <vector>

#include "gap/grid_geometry.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// A ring's conductances (theory manual, thermal.12), or those of what lies behind a flat film (thermal.72), line by
/// line.
struct RingConductances {
  double inside = 0;             ///< resistance from the bore to the ring's middle, per area of the bore [m^2 K/W]
  std::vector<double> around;    ///< to the next angle [W/K]
  std::vector<double> outside;   ///< to the surroundings [W/K]
  std::vector<double> capacity;  ///< [J/K]
};

/// Returns the conductances of the ring around the film of `model`, or behind it.
[[nodiscard]] RingConductances conductances(const FilmModel& model, const GridGeometry& geometry, const RingWall& ring);

/// True if the temperatures of a shell are solved with those of the film, angle by angle.
[[nodiscard]] bool has_own_temperatures(const ShellWall& shell);
/// Conduction of a shell in a body; null: it is in none.
[[nodiscard]] const WallConduction* conduction_of(const ShellWall& shell);

/// Conduction of a journal in a body; null: it is in none.
[[nodiscard]] const JournalConduction* conduction_of(const JournalWall& journal);
/// True if a journal's temperature is solved with those of the film, or settles with them over cycles.
[[nodiscard]] bool has_own_temperature(const JournalWall& journal);

/// True if heat passes between the film and a shell.
[[nodiscard]] bool conducts(const ShellWall& shell);
/// True if heat passes between the film and a journal.
[[nodiscard]] bool conducts(const JournalWall& journal);

}  // namespace hersey::film
