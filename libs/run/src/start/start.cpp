#include "start/start.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/run/named_part.h"
#include "hersey/solver/initialise.h"
#include "hersey/solver/kinematics.h"
#include "hersey/solver/static_deformation.h"
#include "start/facing_surfaces.h"
#include "start/rolling_wheels.h"
#include "start/start_changes.h"

namespace hersey::run {
namespace {

/// Of forces, which messages name without a word for them: "at the start, t = 0 s: mesh: its teeth ...".
std::string path_of_force(const model::Model& model, const std::string& message) {
  for (const model::Force& force : model.forces)
    if (message.find(": " + force.name + ": ") != std::string::npos) return "forces." + force.name;
  return {};
}

Fault fault_at(const model::Model& model, const std::string& row, std::string found, std::string expected,
               std::string suggestion) {
  std::string path = path_of_force(model, row);
  if (path.empty()) path = path_of_named_part(row);
  SourcePosition position = path.empty() ? SourcePosition{model.file, 0, 0} : model.position_of(path);
  return {std::move(position), path, std::move(found), std::move(expected), std::move(suggestion)};
}

std::vector<Fault> faults_of_open_loop(const model::Model& model, const solver::InitialiseSummary& summary) {
  return {fault_at(model, summary.open.front().name,
                   "a mechanism that cannot be assembled: at its closest, " + gaps_text(summary.open),
                   "initial values and lengths with which every loop closes",
                   "check the frames and `initial` values along the loop, and the drives in it")};
}

std::vector<Fault> faults_of(const model::Model& model, const solver::InitialiseSummary& summary) {
  using Status = solver::InitialiseStatus;
  std::vector<Fault> faults;
  for (const std::string& row : summary.redundant) {
    faults.push_back(
        fault_at(model, row,
                 "singular mechanism: " + row +
                     " constrains a motion that other drives or joints prescribe already, or the loops start in a "
                     "singular position",
                 "constraints that are independent",
                 "remove one of the drives, or start the loops away from positions where their rods align"));
  }
  for (const std::string& row : summary.undetermined) {
    faults.push_back(fault_at(model, row, "singular mechanism: nothing determines the motion of " + row,
                              "mass, inertia, a joint, a drive, a damper or a film for every coordinate",
                              "give the bodies behind it mass and inertia, or hold it with a drive"));
  }
  if (!faults.empty()) return faults;
  if (summary.status == Status::domain_error && path_of_named_part(summary.message).starts_with("contacts.")) {
    return {fault_at(model, summary.message, summary.message, "shapes apart or just touching at the start",
                     "move the joints' `initial` values or the shapes; of a half-space or mesh, see that its normals "
                     "point out of the solid")};
  }
  if (summary.status == Status::domain_error && summary.message.find("are not numbers") != std::string::npos) {
    return {fault_at(model, summary.message, summary.message, "loads, springs and inertias that are numbers together",
                     "see that values and factors are in the units meant")};
  }
  if (summary.status == Status::domain_error && summary.message.find("do not face each other") != std::string::npos) {
    return {fault_at(model, summary.message, summary.message, "frames whose z-axes are those of bore and journal",
                     "turn the frame of the shell or of the journal, or the bodies by the joints' `initial` values")};
  }
  if (summary.status == Status::domain_error && summary.message.find("table of coefficients") != std::string::npos) {
    return {fault_at(model, summary.message, summary.message, "a shaft at a speed of the table",
                     "write a row for that speed, or the housing's frame first in `between`")};
  }
  if (summary.status == Status::domain_error && summary.message.find(": its wheels are") != std::string::npos) {
    return {fault_at(model, summary.message, summary.message, "wheels whose teeth reach each other",
                     "place the frames of `between` on the wheels' axes, at the centre distance of the gears")};
  }
  if (summary.status == Status::domain_error && summary.message.find(": its teeth deflect") != std::string::npos) {
    return {fault_at(model, summary.message, summary.message, "teeth that stay with the ones they mesh with",
                     "see that `stiffness`, `transmission_error` and torques are in the units meant")};
  }
  if (summary.status == Status::domain_error && summary.message.find(": the axes of its wheels") != std::string::npos) {
    return {fault_at(model, summary.message, summary.message, "parallel shafts",
                     "turn the frames of `between`, or the bodies by the joints' `initial` values")};
  }
  if (summary.status == Status::domain_error && path_of_named_part(summary.message).starts_with("circuit")) {
    return {fault_at(
        model, summary.message, summary.message, "pumps that turn forwards, and a way out for all oil that comes in",
        "a negative `ratio` turns a pump the other way than its joint; a relief valve takes what is too much")};
  }
  if (summary.status == Status::domain_error && path_of_named_part(summary.message).starts_with("bodies.")) {
    return {fault_at(model, summary.message, summary.message,
                     "a body whose motion at the start its material can follow",
                     "see that speeds, loads and stiffness are in the units meant, or start from rest and let a drive "
                     "speed up")};
  }
  if (summary.status == Status::domain_error) {
    return {fault_at(model, summary.message, summary.message,
                     "surfaces apart at the start: a journal inside its shell, a runner off its pads",
                     "move the bodies' frames or the joints' `initial` values, or enlarge `radial_clearance`")};
  }
  return faults_of_open_loop(model, summary);
}

}  // namespace

namespace {

// In a kinematic analysis nothing moves the coordinates that no drive prescribes.
void require_prescribed_motion(const model::Model& model, model::Machine& machine, const solver::State& start) {
  const std::vector<std::string> loose = solver::free_coordinates(*machine.mechanism, start);
  if (loose.empty()) return;
  throw InputError(Fault{
      model.position_of("simulation.analysis"), "simulation.analysis",
      fmt::format("kinematics of a mechanism with coordinates that nothing prescribes: {}", fmt::join(loose, ", ")),
      "drives for as many coordinates as the mechanism has freedoms", "add a drive, or use `analysis: dynamics`"});
}

// At spectral radius 1 generalized-alpha damps nothing, and multipliers oscillate with growing amplitude. Steps chosen
// by their error end on the constraints, so that no such oscillation persists.
void require_damped_multipliers(const model::Model& model, const mbd::Mechanism& mechanism) {
  if (model.simulation.analysis != model::Analysis::dynamics || mechanism.nlambda() == 0) return;
  if (model.simulation.spectral_radius < 1 || model.simulation.error_control) return;
  throw InputError(Fault{model.position_of("simulation.spectral_radius"), "simulation.spectral_radius",
                         "1 in a mechanism with drives, couplings or closed loops", "a value below 1",
                         "0.95 dissipates little; at 1 the multipliers of equal steps grow without bound, those of "
                         "`step: {tolerance}` do not"});
}

// True unless the analysis looks at the machine at rest.
bool keeps_speeds(const model::Simulation& plan) {
  return plan.analysis != model::Analysis::equilibrium &&
         (plan.analysis != model::Analysis::modes || plan.modes_about != model::ModesAbout::equilibrium);
}

// Deformable bodies start in equilibrium with the forces on them, if this is requested.
void deform(const model::Model& model, model::Machine& machine, solver::InitialiseOptions options,
            solver::State& state) {
  using model::InitialDeformation;
  const model::Simulation& plan = model.simulation;
  if (plan.analysis != model::Analysis::dynamics || plan.initial_deformation == InitialDeformation::none) return;
  if (plan.initial_deformation == InitialDeformation::internal) {
    options.fixed.insert(options.fixed.end(), options.stiff.begin(), options.stiff.end());
    options.stiff = machine.mechanism->internal_coordinates();
  }
  if (options.stiff.empty()) return;
  const solver::StaticDeformationSummary summary = solver::settle_deformations(*machine.mechanism, state, options);
  if (summary.solved()) return;
  throw InputError(Fault{model.position_of("simulation"), "simulation.initial_deformation",
                         "a start in which the deformation that the forces hold cannot be found: " + summary.message,
                         "forces that the bodies can carry at the start",
                         "start nearer to the motion that follows, or undeformed with initial_deformation: none"});
}

/// Lets gears mesh without force where the joints stand once the mechanism is assembled.
void mesh_gears(model::Machine& machine, const solver::State& start, const solver::InitialiseOptions& options) {
  if (machine.gear_meshes.empty()) return;
  solver::State assembled = start;
  if (!solver::assemble_positions(*machine.mechanism, assembled, options).solved()) return;  // `initialise` says why
  for (const model::BuiltMesh& mesh : machine.gear_meshes)
    mesh.mesh->mesh_here(machine.mechanism->relative_motion(assembled, mesh.force));
}

/// Gives the wheels that no drive rotates the speeds at which they roll, and what is tied to them speeds that fit.
void let_wheels_roll(const model::Model& model, model::Machine& machine, solver::InitialiseOptions options,
                     solver::State& state) {
  options.fixed_rates =
      model.simulation.is_steady_motion() ? roll_wheels(machine, state) : roll_wheels(machine, state, kRoundedSpeed);
  if (options.fixed_rates.empty()) return;
  const solver::InitialiseSummary summary = solver::initialise(*machine.mechanism, state, options);
  if (!summary.solved()) throw InputError(faults_of(model, summary));
}

}  // namespace

solver::State starting_state(const model::Model& model, model::Machine& machine) {
  require_damped_multipliers(model, *machine.mechanism);
  solver::State state = machine.mechanism->initial_state();
  state.t = model.simulation.start;
  machine.mechanism->count_revolutions(state);
  solver::InitialiseOptions options;
  options.fixed = machine.mechanism->given_coordinates();
  options.fixed_rates = machine.mechanism->given_rates();
  options.stiff = machine.mechanism->elastic_coordinates();
  options.balances_massless = !model.simulation.is_steady_motion();
  mesh_gears(machine, state, options);
  const solver::InitialiseSummary summary = solver::initialise(*machine.mechanism, state, options);
  if (!summary.solved()) throw InputError(faults_of(model, summary));
  require_given_start(model, *machine.mechanism, state, summary);
  if (keeps_speeds(model.simulation)) let_wheels_roll(model, machine, options, state);
  if (keeps_speeds(model.simulation)) require_rolling_wheels(model, machine, state);
  require_clearance(model, machine, state);
  deform(model, machine, options, state);
  if (model.simulation.analysis == model::Analysis::kinematics) require_prescribed_motion(model, machine, state);
  return state;
}

}  // namespace hersey::run
