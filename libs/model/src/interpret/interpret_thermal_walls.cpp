#include "interpret/interpret.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {

void interpret_thermal_walls(Context& context) {
  Model& model = context.model;
  model.thermal_walls = model.simulation.cycle ? ThermalWalls::cycle_mean : ThermalWalls::transient;
  const Value* thermal = context.root.find("thermal");
  const Value* walls = thermal != nullptr ? thermal->find("walls") : nullptr;
  if (walls != nullptr && !walls->broken) {
    model.thermal_walls = meaning_of(*walls, thermal_walls_words);
    if (model.thermal_walls == ThermalWalls::cycle_mean && !model.simulation.cycle)
      context.fault(*walls, "walls at the mean heat of a cycle, in a machine without cycles",
                    "'transient' or 'frozen', or a `simulation.cycle`");
  }
  if (model.thermal_walls == ThermalWalls::transient) return;
  for (Bearing& bearing : model.bearings)
    if (auto* heat = std::get_if<film::ThermalModel>(&bearing.heat)) heat->walls = film::WallMotion::held;
}

}  // namespace hersey::model
