#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hersey/core/spelling.h"
#include "interpret/context/interpret.h"
#include "schema/machine_vocabulary.h"
#include "tree/overrides.h"

namespace hersey::model {
namespace {

const Joint* joint_called(const Model& model, const std::string& name) {
  for (const Joint& joint : model.joints) {
    if (joint.name == name) return &joint;
  }
  return nullptr;
}

double initial_value(const Joint& joint, const std::string& coordinate) {
  for (const InitialValue& initial : joint.initial) {
    if (initial.coordinate == coordinate && !initial.value.empty()) return initial.value.front();
  }
  return 0;
}

/// The drive that moves `coordinate` of `joint` at a constant speed; null if there is none.
const Drive* constant_drive(const Model& model, const std::string& joint, const std::string& coordinate) {
  for (const Drive& drive : model.drives) {
    const bool drives_it = drive.joint == joint && drive.coordinate == coordinate;
    const bool is_constant = drive.prescribes == Drive::Prescribes::speed && drive.ramp == 0 &&
                             drive.motion.value != nullptr && drive.motion.is_constant();
    if (drives_it && is_constant) return &drive;
  }
  return nullptr;
}

std::optional<Crank> crank_of(Context& context, const Value& simulation) {
  const Value* value = simulation.find("crank");
  if (value == nullptr || value->broken) return std::nullopt;
  require_name(context, *value, "joints", "joint");
  const Joint* joint = joint_called(context.model, value->text);
  if (joint == nullptr || context.has_fault_in("joints." + value->text) || context.has_fault_in("drives")) {
    return std::nullopt;
  }
  if (joint->type != JointType::revolute) {
    context.fault(*value, "joint '" + joint->name + "', which is not revolute", "a revolute joint");
    return std::nullopt;
  }
  const Drive* drive = constant_drive(context.model, joint->name, "rotation");
  const double speed = drive != nullptr ? drive->motion.value->value({}) : 0;
  if (speed == 0) {
    context.fault(*value, "joint '" + joint->name + "', which no drive rotates at a constant speed",
                  "a joint with a drive such as {joint: " + joint->name + ", coordinate: rotation, speed: 3570 rpm}");
    return std::nullopt;
  }
  return Crank{joint->name, speed, initial_value(*joint, "rotation")};
}

/// A time, or the time the crank takes for an angle.
double seconds_of(Context& context, const Value& value, const std::optional<Crank>& crank) {
  if (value.broken) return 0;
  if (value.unit != "rad") return value.number;
  if (crank) return value.number / std::abs(crank->speed);
  const Value* simulation = context.root.find("simulation");
  if (simulation != nullptr && simulation->find("crank") != nullptr) return 0;  // a crank at fault has been reported
  context.fault(value, "an angle", "a time, or a crank that converts angles to times",
                "add simulation.crank with the name of a driven revolute joint");
  return 0;
}

double seconds_of(Context& context, const Value& parent, const std::string& key, const std::optional<Crank>& crank) {
  const Value* value = parent.find(key);
  return value != nullptr ? seconds_of(context, *value, crank) : 0;
}

std::string in_users_unit(double x, bool is_angle) {
  std::array<char, 48> text{};
  const double degrees = x * 180 / std::numbers::pi;
  std::snprintf(text.data(), text.size(), "%.6g", is_angle ? degrees : x);
  return text.data();
}

/// Range of the first variable of a function during the run, as far as it is prescribed.
std::optional<std::pair<double, double>> range_during_run(const Model& model, const Variable& variable) {
  const Simulation& simulation = model.simulation;
  if (variable.kind == Variable::Kind::time) {
    return std::pair{simulation.start, simulation.start + simulation.duration};
  }
  const Joint* joint = joint_called(model, variable.joint);
  const Drive* drive = constant_drive(model, variable.joint, variable.coordinate);
  if (variable.kind == Variable::Kind::rate || joint == nullptr || drive == nullptr) return std::nullopt;
  const double from = initial_value(*joint, variable.coordinate);
  const double to = from + drive->motion.value->value({}) * simulation.duration;
  return std::pair{std::min(from, to), std::max(from, to)};
}

void check_table_range(Context& context, const Function& function) {
  if (!function.domain || function.variables.empty()) return;
  const Variable& variable = function.variables.front();
  const auto range = range_during_run(context.model, variable);
  if (!range) return;
  const auto [low, high] = *function.domain;
  const double slack = 1e-9 * (high - low);
  if (low - slack <= range->first && range->second <= high + slack) return;
  const bool is_angle = variable.coordinate == "rotation";
  const std::string unit = variable.kind == Variable::Kind::time ? " s" : is_angle ? " deg" : " m";
  const auto text = [&](double from, double to) {
    return in_users_unit(from, is_angle) + " to " + in_users_unit(to, is_angle) + unit;
  };
  context.faults.push_back({function.position, function.path, "a table that covers " + text(low, high),
                            "one that covers the run, " + text(range->first, range->second),
                            "add points, or a period after which it repeats"});
}

}  // namespace

namespace {

/// Refuses films that an analysis cannot have.
void refuse_bearings(Context& context, const Value& value) {
  const Simulation& simulation = context.model.simulation;
  const Value* bearings = context.root.find("bearings");
  if (bearings == nullptr || bearings->members.empty()) return;
  for (const auto& [name, bearing] : bearings->members) {
    const Value* shear = simulation.has_duration() ? bearing.find("shear_force") : nullptr;
    if (shear == nullptr || shear->broken || shear->text != "none") continue;
    context.fault(*shear, "shear that acts on no body, in a motion over time: its energy would come from nowhere",
                  "`full`; or `analysis: steady`");
  }
  if (simulation.analysis == Analysis::dynamics) return;
  if (simulation.analysis == Analysis::kinematics) {
    context.fault(*value.find("analysis"), "a kinematic analysis of a machine with bearings",
                  "ideal joints: a film lets its journal move as forces will", "leave out `bearings`, or use dynamics");
    return;
  }
  if (simulation.has_duration()) return;
  for (const auto& [name, bearing] : bearings->members) {
    const Value* thermal = bearing.find("thermal");
    if (thermal == nullptr || thermal->broken || thermal->text != "film") continue;
    if (!simulation.is_steady_motion()) {
      context.fault_at_key(*thermal, "temperatures of a film in a machine that does not turn", "`model: isothermal`",
                           "use `analysis: steady`, modes with `modes_about: turning` or `end`, or dynamics");
      continue;
    }
    for (const char* wall : {"shell", "journal"}) {
      const Value* of = thermal->has(wall) ? thermal->find(wall) : nullptr;  // flat films have walls of other names
      if (of != nullptr && !of->broken && of->text == "body")
        context.fault(*of, "a wall in a body that conducts, in the steady motion of a machine", "any other wall",
                      "`hersey bearing` solves one bearing with its bodies");
    }
  }
}

void refuse_flexible_bodies(Context& context, const Value& value) {
  const Analysis analysis = context.model.simulation.analysis;
  for (const auto& [name, body] : section(context.root, "bodies")) {
    if (name == "ground") continue;
    const Value* flexible = body.find("flexible");
    if (analysis == Analysis::kinematics && (flexible != nullptr || body.find("beam") != nullptr)) {
      context.fault(*value.find("analysis"), "a kinematic analysis with the flexible body '" + name + "'",
                    "rigid bodies: how others deform depends on forces", "use dynamics, or make the body rigid");
    } else if (analysis == Analysis::modes && flexible != nullptr && meaning_of(*flexible, "form", form_words)) {
      context.fault(*flexible->find("form"), "`form: nodal` of a body whose small motions are sought",
                    "`form: modal`, with as many `modes` as are needed", "");
    }
  }
}

/// The first of the model's parts that an explicit integrator without condensed unknowns cannot advance; empty if there
/// is none.
std::string part_for_implicit_steps(const Context& context) {
  for (const auto& [section_name, part] : {std::pair{"bearings", "bearing"}, std::pair{"contacts", "contact"}})
    for (const auto& [name, value] : section(context.root, section_name)) return part + (" '" + name + "'");
  for (const auto& [name, body] : section(context.root, "bodies"))
    if (body.has("flexible") || body.has("beam")) return "the flexible body '" + name + "'";
  for (const Force& force : context.model.forces)
    if (force.as<PistonRing>() != nullptr) return "piston ring '" + force.name + "'";
  return {};
}

void interpret_integrator(Context& context, const Value& value) {
  Simulation& simulation = context.model.simulation;
  simulation.integrator = meaning_of(value, "integrator", integrator_words);
  if (simulation.integrator == Integrator::generalized_alpha) return;
  const Value& at = *value.find("integrator");
  if (const std::string part = part_for_implicit_steps(context); !part.empty())
    context.fault(at, "the explicit method in a machine with " + part,
                  "rigid bodies with joints, drives, springs, dampers and loads",
                  "use `integrator: generalized_alpha`, which is for every machine");
  if (simulation.analysis == Analysis::kinematics)
    context.fault(at, "an integrator of a kinematic analysis, which integrates nothing", "`analysis: dynamics`",
                  "leave out `integrator`");
}

void interpret_analysis(Context& context, const Value& value) {
  Simulation& simulation = context.model.simulation;
  simulation.analysis = meaning_of(value, "analysis", analysis_words);
  simulation.modes_about = meaning_of(value, "modes_about", modes_about_words);
  if (simulation.has_duration()) {
    if (value.find("duration") == nullptr && value.find("cycle") == nullptr)
      context.fault_at_key(value, "missing key 'duration'", "a time or an angle > 0, such as 0.1 s");
    if (value.find("step") == nullptr)
      context.fault_at_key(value, "missing key 'step'", "a time or an angle > 0, such as 0.1 ms, or {tolerance}");
  }
  refuse_bearings(context, value);
  refuse_flexible_bodies(context, value);
}

void interpret_step(Context& context, const Value& parent) {
  Simulation& simulation = context.model.simulation;
  const Value* value = parent.find("step");
  if (value == nullptr || value->broken) return;
  const Value& content = value->members.front().value;
  if (value->alternative == 0) {
    simulation.step = seconds_of(context, content, simulation.crank);
    return;
  }
  ErrorControl control;
  control.tolerance = number_of(content, "tolerance");
  control.smallest = number_of(content, "smallest");
  control.largest = content.find("largest") != nullptr ? seconds_of(context, *content.find("largest"), simulation.crank)
                                                       : simulation.duration / 50;
  if (control.largest > 0 && control.smallest > control.largest) {
    context.fault(*content.find("smallest"), "a smallest step longer than the largest", "at most the largest step");
  }
  simulation.step = control.largest / 100;
  simulation.error_control = control;
}

/// Angles come again in every cycle.
void interpret_meshes_at(Context& context, const Value& list) {
  if (list.broken) return;
  const Simulation& simulation = context.model.simulation;
  std::vector<double>& times = context.model.output.meshes_at;
  const double end = simulation.duration * (1 + 1e-9);
  for (const Member& member : list.members) {
    const double at = seconds_of(context, member.value, simulation.crank);
    const bool repeats = member.value.unit == "rad" && simulation.cycle && simulation.cycle->period > 0;
    const int most = repeats ? simulation.cycle->most : 1;
    if (simulation.duration > 0 && at > end)
      context.fault(member.value, "a mesh after the end of the run", "a time or an angle during the run");
    for (int k = 0; k < most; ++k) {
      const double t = at + (repeats ? k * simulation.cycle->period : 0);
      if (t <= end) times.push_back(t);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

void interpret_output(Context& context) {
  Output& output = context.model.output;
  const Simulation& simulation = context.model.simulation;
  const Value* out = context.root.find("output");
  if (out == nullptr) return;
  output.position = out->key_position;
  output.every = integer_of(*out, "every");
  output.interval = seconds_of(context, *out, "interval", simulation.crank);
  if (output.interval > 0 && !simulation.error_control && simulation.step > 0) {
    context.fault(*out->find("interval"), "an interval with a fixed step",
                  "an error control, such as step: {tolerance: 1e-4}",
                  "with a fixed step, `every` counts the steps between rows");
  }
  output.fields_every = out->find("fields_every") != nullptr
                            ? seconds_of(context, *out, "fields_every", simulation.crank)
                            : (simulation.cycle ? simulation.cycle->period : simulation.duration) / 100;
  if (const Value* meshes = out->find("meshes_at")) interpret_meshes_at(context, *meshes);
}

// True of films whose surfaces deform, and of bodies whose nodes all move: a film on another grid deforms them
// otherwise, and no film is found between surfaces that those of half the nodes have pushed apart.
bool has_elastic_surfaces(const Model& model) {
  const auto deforms = [](const Bearing& bearing) { return bearing.shell_surface || bearing.journal_surface; };
  const auto is_nodal = [](const Body& body) { return body.flexible && body.flexible->nodal; };
  return std::any_of(model.bearings.begin(), model.bearings.end(), deforms) ||
         std::any_of(model.bodies.begin(), model.bodies.end(), is_nodal);
}

bool wears(const Model& model) {
  return std::any_of(model.bearings.begin(), model.bearings.end(),
                     [](const Bearing& bearing) { return bearing.wear.has_value(); });
}

bool has_controller(const Model& model) {
  return std::any_of(model.forces.begin(), model.forces.end(),
                     [](const Force& force) { return std::holds_alternative<SpeedControl>(force.data); });
}

bool has_ramp(const Model& model) {
  return std::any_of(model.drives.begin(), model.drives.end(), [](const Drive& drive) { return drive.ramp > 0; });
}

// Wear grows from cycle to cycle, and what a controller has stored belongs to the time of its run.
void refuse_shooting(Context& context, const Value& value) {
  if (wears(context.model))
    context.fault(value, "a motion that repeats between surfaces that wear", "surfaces without `wear`",
                  "find the motion without it, or leave `lead_in` out");
  if (has_ramp(context.model))
    context.fault(value, "a motion that repeats of a machine whose drive begins with a `ramp`", "drives without it",
                  "the motion is found, and needs no soft start");
  if (has_controller(context.model))
    context.fault(value, "a motion that repeats of a machine whose controller stores what it integrates",
                  "a `drive` in place of `type: speed_control`", "leave `lead_in` out");
}

void interpret_lead_in(Context& context, const Value& value) {
  Cycle& cycle = *context.model.simulation.cycle;
  cycle.lead_in = meaning_of(value, lead_in_words);
  if (cycle.lead_in == LeadIn::none) return;
  if (cycle.tolerance == 0)
    context.fault(value, "a lead-in to cycles that are all run", "cycles that end the run once they repeat",
                  "give `until_converged` a value above 0");
  if (cycle.lead_in == LeadIn::half_grids && has_elastic_surfaces(context.model))
    context.fault(value, "a lead-in of films on half grids between surfaces that deform", "rigid surfaces of all films",
                  "`lead_in: shooting` keeps the grids");
  if (cycle.lead_in == LeadIn::shooting) refuse_shooting(context, value);
}

bool is_found_by_shooting(const Value& cycle) {
  const Value* lead_in = cycle.find("lead_in");
  return lead_in != nullptr && !lead_in->broken && meaning_of(*lead_in, lead_in_words) == LeadIn::shooting;
}

/// The period, or about where it is to be found.
void interpret_period(Context& context, const Value& value) {
  const Value* period = value.find("period");
  if (period == nullptr || period->broken) return;
  Simulation& simulation = context.model.simulation;
  const Value& content = period->members.front().value;
  simulation.cycle->is_period_found = period->alternative == 1;
  simulation.cycle->period = simulation.cycle->is_period_found ? seconds_of(context, content, "about", simulation.crank)
                                                               : seconds_of(context, content, simulation.crank);
  if (!simulation.cycle->is_period_found) return;
  if (!is_found_by_shooting(value))
    context.fault(*period, "a period to be found in cycles that nobody looks for", "`lead_in: shooting` beside it");
}

/// Cycles that end the run, if its duration does not.
void interpret_cycle(Context& context, const Value& parent) {
  Simulation& simulation = context.model.simulation;
  const Value* value = parent.find("cycle");
  if (value == nullptr || value->broken) return;
  const Value* bearings = context.root.find("bearings");
  if ((bearings == nullptr || bearings->members.empty()) && !is_found_by_shooting(*value))
    context.fault_at_key(*value, "cycles of a machine without bearings", "bearings whose figures repeat",
                         "`lead_in: shooting` finds its periodic motion; or give a `duration` instead");
  simulation.cycle = Cycle{.tolerance = number_of(*value, "until_converged"), .most = integer_of(*value, "most")};
  interpret_period(context, *value);
  if (const Value* lead_in = value->find("lead_in"); lead_in != nullptr && !lead_in->broken)
    interpret_lead_in(context, *lead_in);
  simulation.cycle->multipliers = integer_of(*value, "multipliers");
  if (simulation.cycle->multipliers > 0 && simulation.cycle->lead_in != LeadIn::shooting)
    context.fault(*value->find("multipliers"), "multipliers of a motion that is not looked for",
                  "`lead_in: shooting` beside them");
  const double longest = simulation.cycle->most * simulation.cycle->period;
  simulation.duration = parent.find("duration") != nullptr ? std::min(simulation.duration, longest) : longest;
}

/// Each cycle has to end with a step.
void require_whole_steps(Context& context, const Value& parent) {
  const Simulation& simulation = context.model.simulation;
  if (!simulation.cycle || simulation.error_control || simulation.step <= 0 || simulation.cycle->period <= 0) return;
  const double steps = simulation.cycle->period / simulation.step;
  if (steps > 0.5 && std::abs(steps - std::round(steps)) < 1e-6) return;
  context.fault(*parent.find("cycle")->find("period"), "a cycle of " + in_users_unit(steps, false) + " steps",
                "a whole number of steps", "change the step, or let steps be chosen with step: {tolerance: 1e-4}");
}

InitialDeformation initial_deformation_of(const Model& model, const Value& simulation) {
  if (const Value* value = simulation.find("initial_deformation"); value != nullptr && !value->broken)
    return meaning_of(*value, initial_deformation_words);
  const bool rests = has_elastic_surfaces(model);
  return rests ? InitialDeformation::internal : InitialDeformation::none;
}

}  // namespace

void interpret_simulation(Context& context) {
  Simulation& simulation = context.model.simulation;
  const Value* value = context.root.find("simulation");
  if (value == nullptr) return;
  simulation.position = value->key_position;
  interpret_analysis(context, *value);
  interpret_integrator(context, *value);
  simulation.crank = crank_of(context, *value);
  simulation.start = number_of(*value, "start");
  simulation.duration = seconds_of(context, *value, "duration", simulation.crank);
  interpret_cycle(context, *value);
  interpret_step(context, *value);
  require_whole_steps(context, *value);
  if (simulation.error_control && simulation.cycle && simulation.cycle->lead_in == LeadIn::shooting) {
    context.fault(*value->find("step"), "steps chosen by their error where periods are compared with each other",
                  "a fixed step for `lead_in: shooting`, such as 0.1 ms");
  }
  if (simulation.error_control && simulation.analysis == Analysis::kinematics) {
    context.fault(*value->find("step"), "an error control of a kinematic analysis, which integrates nothing",
                  "the time between its instants, such as 0.1 ms");
  }
  simulation.initial_deformation = initial_deformation_of(context.model, *value);
  simulation.spectral_radius = number_of(*value, "spectral_radius");
  simulation.tolerance = number_of(*value, "tolerance");
  simulation.max_iterations = integer_of(*value, "max_iterations");
  simulation.smallest_step = number_of(*value, "smallest_step");
  if (simulation.step > simulation.duration && simulation.duration > 0) {
    context.fault(*value->find("step"), "a step longer than the run", "a step of at most the duration");
  }
  if (!simulation.error_control && simulation.step > 0 && simulation.smallest_step > simulation.step) {
    context.fault(*value->find("smallest_step"), "a smallest step longer than the step", "at most the step");
  }
  if (const Value* settle = value->find("settle"); settle != nullptr && !settle->broken) {
    simulation.settle = Settle{number_of(*settle, "tolerance"), seconds_of(context, *settle, "over", simulation.crank)};
  }
  if (const Value* checkpoint = value->find("checkpoint"); checkpoint != nullptr && !checkpoint->broken) {
    simulation.checkpoint = {seconds_of(context, *checkpoint, "every", simulation.crank),
                             number_of(*checkpoint, "wall_time")};
  }
  interpret_output(context);
}

namespace {

void require_function_of_crank(Context& context, const Function& function, const std::string& what) {
  const std::optional<Crank>& crank = context.model.simulation.crank;
  for (const Variable& variable : function.variables) {
    if (variable.kind == Variable::Kind::time || (crank && variable.joint == crank->joint)) continue;
    context.faults.push_back({function.position, function.path,
                              what + " that follows '" + variable.joint + "." + variable.coordinate + "'",
                              "a function of time or of the rotation of simulation.crank", ""});
  }
}

}  // namespace

void check_functions_of_crank(Context& context) {
  for (const Bearing& bearing : context.model.bearings)
    for (const Function& pressure : bearing.feature_pressures)
      require_function_of_crank(context, pressure, "a pressure");
  for (const Force& force : context.model.forces) {
    if (const auto* load = force.as<SurfaceLoad>())
      for (const Function& function : load->functions) require_function_of_crank(context, function, "a load on a mesh");
    if (const auto* ring = force.as<PistonRing>(); ring != nullptr && ring->gas)
      require_function_of_crank(context, *ring->gas, "a gas pressure");
  }
}

void check_table_ranges(Context& context) {
  if (context.model.simulation.duration <= 0) return;
  for (const Drive& drive : context.model.drives) check_table_range(context, drive.motion);
  for (const Force& force : context.model.forces)
    for (const auto& followed : functions_of(force)) check_table_range(context, *followed.function);
}

}  // namespace hersey::model
