#include "observation/observe_step.h"

#include "hersey/core/task_pool.h"
#include "hersey/mbd/mechanism.h"

namespace hersey::run {
namespace {

// Transforms an observation from the axes of the first body to those of ground.
mbd::ContactObservation in_ground(mbd::ContactObservation observation, const Pose& X_WA) {
  observation.force = X_WA.R * observation.force;
  observation.friction = X_WA.R * observation.friction;
  observation.position = X_WA * observation.position;
  return observation;
}

}  // namespace

std::vector<ForceKind> force_kinds(const model::Machine& machine) {
  std::vector<ForceKind> kinds(machine.mechanism->spec().forces.size(), ForceKind::spring);
  const auto mark = [&](const auto& built, ForceKind kind) {
    kinds[static_cast<std::size_t>(built.force.index)] = kind;
  };
  for (const model::BuiltContact& contact : machine.contacts) mark(contact, ForceKind::contact);
  for (const model::BuiltBearing& bearing : machine.bearings) mark(bearing, ForceKind::bearing);
  return kinds;
}

StepRecord observe_step(const model::Machine& machine, const solver::State& state,
                        const std::vector<ForceKind>& kinds) {
  mbd::Mechanism& mechanism = *machine.mechanism;
  StepRecord record;
  record.mechanism = mechanism.observe(state);
  record.constraint_drift = record.mechanism.constraint_drift;
  for (const model::BuiltBearing& bearing : machine.bearings)
    record.journal_motions.push_back(mechanism.relative_motion(state, bearing.force));
  record.bearings.resize(machine.bearings.size());
  TaskPool::shared().run(machine.bearings.size(), [&](std::size_t i) {
    record.bearings[i] = machine.bearings[i].bearing->observe(record.journal_motions[i]);
  });
  for (const model::BuiltContact& contact : machine.contacts) {
    const mbd::RelativeMotion motion = mechanism.relative_motion(state, contact.force);
    const Pose& X_WA = record.mechanism.bodies[static_cast<std::size_t>(contact.first.index)].X_WF;
    record.contacts.push_back(in_ground(contact.contact->observe(motion), X_WA));
  }
  for (const model::BuiltMesh& mesh : machine.gear_meshes)
    record.meshes.push_back(mesh.mesh->load(mechanism.relative_motion(state, mesh.force)));
  if (machine.network) record.network = machine.network->observables();
  if (machine.circuit) record.circuit = machine.circuit->observation();
  record.power = power_balance(mechanism.spec(), record.mechanism, kinds);
  for (const bearing::BearingObservation& bearing : record.bearings)
    record.power.films -= bearing.film.power_taken() + bearing.power_of_growth;
  return record;
}

}  // namespace hersey::run
