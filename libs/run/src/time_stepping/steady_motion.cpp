#include "hersey/run/steady_motion.h"

#include <algorithm>

#include "hersey/model/build.h"
#include "hersey/solver/equilibrium.h"
#include "observation/observe_step.h"
#include "start/start.h"
#include "time_stepping/steady_heat.h"

namespace hersey::run {

SteadyMotion find_steady_motion(const model::Model& model, const std::vector<std::string>& released,
                                int max_iterations) {
  model::Machine machine = model::build(model);
  solver::State state = starting_state(model, machine);
  mbd::Mechanism& mechanism = *machine.mechanism;
  SteadyMotion motion;
  const solver::EquilibriumSummary found =
      find_warm_steady_motion(machine, state, {.max_iterations = max_iterations, .steady_motion = true});
  motion.iterations = found.iterations;
  motion.message = found.message;
  if (!found.solved()) return motion;
  StepRecord record = observe_step(machine, state, force_kinds(machine));
  motion.bearings = std::move(record.bearings);
  motion.joints = std::move(record.mechanism.joints);
  motion.network = std::move(record.network);
  for (const model::BuiltBearing& bearing : machine.bearings) motion.fields.push_back(bearing.bearing->fields());
  std::vector<solver::Equations::Index> free;
  for (solver::Equations::Index row = 0; row < mechanism.nv(); ++row) {
    motion.coordinates.push_back(mechanism.name_of_row(row));
    if (std::find(released.begin(), released.end(), motion.coordinates.back()) != released.end()) free.push_back(row);
  }
  motion.small_motions = solver::linearise(mechanism, state, 0, free);
  motion.message = motion.small_motions.message;
  motion.set_solved(motion.small_motions.solved());
  return motion;
}

}  // namespace hersey::run
