#include "recorder.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "film_surface_rows.h"
#include "geometry_record.h"
#include "hersey/core/version.h"
#include "hersey/results/reader.h"
#include "hersey/run/assumptions.h"
#include "redundancies.h"
#include "start_changes.h"
#include "work_record.h"

namespace hersey::run {
namespace {

std::vector<std::string> coordinate_names(mbd::JointType type) {
  std::vector<std::string> names;
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(type)) {
    for (int i = 0; i < coordinate.size; ++i) {
      names.push_back(coordinate.size == 1 ? std::string(coordinate.name)
                                           : fmt::format("{}_{}", coordinate.name, "xyz"[i]));
    }
  }
  return names;
}

bool is_rotational(const mbd::JointSpec& joint, int value) {
  for (const mbd::Coordinate& coordinate : mbd::coordinates_of(joint.type)) {
    if (value >= coordinate.offset && value < coordinate.offset + coordinate.size) return coordinate.rotational;
  }
  return false;
}

}  // namespace

std::filesystem::path unfinished_file(const std::filesystem::path& results) {
  std::filesystem::path path = results;
  path += ".unfinished";
  return path;
}

namespace {

/// Of a fixed step or an interval of output.
std::size_t expected_rows(const model::Model& model) {
  const double interval =
      model.output.interval > 0 ? model.output.interval : model.simulation.step * model.output.every;
  const double rows = interval > 0 ? model.simulation.duration / interval : 0;
  return rows < 1e9 ? static_cast<std::size_t>(std::max(rows, 0.0)) : 0;
}

/// The file to write. Results appear under their own name when all that is written before the first step is in them,
/// so that whoever finds them finds the model; until then those that they replace stay.
std::filesystem::path new_file(const Options& options, bool resumes) {
  if (!resumes && !options.overwrite && std::filesystem::exists(options.results))
    throw results::FileExists(options.results);
  return unfinished_file(options.results);
}

}  // namespace

Recorder::Recorder(const model::Model& model, const model::Machine& machine, const solver::State& start,
                   const Options& options, bool resumes)
    : model_(model),
      machine_(machine),
      writer_(new_file(options, resumes), {.overwrite = true, .rows = expected_rows(model)}),
      cycles_(model, machine, writer_) {
  hide_inner_nodes();
  declare_run(start, options);
  declare_machine();
  declare_flexible_bodies();
  declare_surface_loads();
  declare_beams();
  declare_contacts();
  for (const model::Bearing& bearing : model.bearings) bearings_.push_back(declare_bearing(bearing));
  declare_cycles();
  write_geometry(model, machine.mechanism->spec(), hidden_joints_, writer_);
  if (model.simulation.analysis == model::Analysis::modes) declare_modes();
  writer_.flush();
  if (!resumes) writer_.rename(options.results, options.overwrite);
}

void Recorder::declare_run(const solver::State& start, const Options& options) {
  const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  writer_.attribute("/", "hersey_version", version());
  writer_.attribute("/", "title", model_.title);
  writer_.attribute("/", "description", model_.description);
  writer_.attribute("/", "created", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now)));
  for (const model::Parameter& parameter : model_.parameters) {
    writer_.attribute("/parameters", parameter.name, parameter.text);
  }
  std::vector<std::string> study_parameters;
  for (const StudyParameterValue& value : options.study_parameters) {
    writer_.attribute("/parameters", value.name, value.text);
    study_parameters.push_back(value.name);
  }
  if (!study_parameters.empty()) writer_.attribute("/", "study_parameters", study_parameters);
  writer_.text("/model", model_.resolved_text, "model file of this run, overrides noted");
  std::vector<std::pair<std::string, std::string>> texts = assumptions(model_);
  for (auto& text : film_surface_rows(model_, machine_)) texts.push_back(std::move(text));
  for (auto& text : start_rows(model_, *machine_.mechanism, start)) texts.push_back(std::move(text));
  for (auto& text : redundancies(*machine_.mechanism)) texts.push_back(std::move(text));
  writer_.text_table("/assumptions", texts, "what decides the results: name, text");

  time_ = writer_.series("/time", 1, "s", "time");
  if (model_.simulation.crank) {
    crank_angle_ = writer_.series("/crank_angle", 1, "rad", "rotation of joint " + model_.simulation.crank->joint);
  }
  dt_ = writer_.series("/solver/dt", 1, "s", "step length");
  newton_iterations_ = writer_.series("/solver/newton_iterations", 1, "1", "Newton iterations of the step");
  residual_ = writer_.series("/solver/residual", 1, "1", "largest row residual over its tolerance");
  rejected_ = writer_.series("/solver/rejected_steps", 1, "1", "steps rejected since the start of the run");
  drift_ = writer_.series("/solver/constraint_drift", 1, "1",
                          "largest violation of a joint or drive, lengths over the machine's size, angles in rad");
  if (model_.simulation.error_control) {
    error_ = writer_.series("/solver/error", 1, "1", "estimated local error of the step over its tolerance");
  }
  if (integrates()) {
    step_error_ = writer_.series("/solver/step_error", 1, "1",
                                 "estimated local error of the step: angles in rad, lengths over the machine's size, "
                                 "positions of journals over their clearance");
  }
}

void Recorder::declare_machine() {
  const mbd::MechanismSpec& spec = machine_.mechanism->spec();
  for (std::size_t i = 1; i < spec.bodies.size(); ++i) {
    if (hidden_bodies_[i]) {
      bodies_.emplace_back();
      continue;
    }
    const std::string path = "/bodies/" + spec.bodies[i].name + "/";
    bodies_.push_back({writer_.series(path + "position", 3, "m", "origin in ground"),
                       writer_.series(path + "orientation", 4, "1", "unit quaternion w, x, y, z"),
                       writer_.series(path + "velocity", 3, "m/s", "of the origin, ground axes"),
                       writer_.series(path + "angular_velocity", 3, "rad/s", "ground axes"),
                       writer_.series(path + "acceleration", 3, "m/s^2", "of the origin, ground axes")});
  }
  for (const mbd::JointSpec& joint : spec.joints) {
    if (hidden_joints_[joints_.size()]) {
      joints_.emplace_back();
      continue;
    }
    const std::string path = "/joints/" + joint.name + "/";
    const int n = mbd::degrees_of_freedom(joint.type);
    JointSeries series;
    if (n > 0) {
      const bool mixed = n > 1, rotational = is_rotational(joint, 0);
      const std::string names = path + "coordinate";
      if (mixed) writer_.labels(names, coordinate_names(joint.type), "joint coordinates");
      series.coordinates = writer_.series(path + "coordinates", n, mixed ? "SI" : (rotational ? "rad" : "m"),
                                          "joint coordinates, names in the joint's attribute coordinate_names",
                                          results::Precision::float64, names);
      series.rates = writer_.series(path + "rates", n, mixed ? "SI" : (rotational ? "rad/s" : "m/s"),
                                    "rates of the joint coordinates", results::Precision::float64, names);
      writer_.attribute("/joints/" + joint.name, "coordinate_names", coordinate_names(joint.type));
    }
    series.force = writer_.series(path + "reaction_force", 3, "N", "on the outboard body, inboard frame's axes");
    series.torque = writer_.series(path + "reaction_torque", 3, "N.m", "on the outboard body about the inboard frame");
    joints_.push_back(series);
  }
  for (const mbd::DriveSpec& drive : spec.drives) {
    const std::string path = "/drives/" + drive.name + "/";
    const mbd::JointSpec& joint = spec.joints[static_cast<std::size_t>(drive.coordinate.joint.index)];
    const char* unit = is_rotational(joint, drive.coordinate.value) ? "N.m" : "N";
    drives_.push_back({writer_.series(path + "force_or_torque", 1, unit, "effort on the driven coordinate"),
                       writer_.series(path + "power", 1, "W", "power put into the machine")});
  }
  const auto unit_on = [&](const mbd::CoordinateRef& on) {
    return is_rotational(spec.joints[static_cast<std::size_t>(on.joint.index)], on.value) ? "N.m" : "N";
  };
  for (const mbd::CouplingSpec& coupling : spec.couplings) {
    couplings_.push_back(writer_.series("/couplings/" + coupling.name + "/force_or_torque", 1, unit_on(coupling.output),
                                        "effort on the output coordinate"));
  }
  for (const auto& force : spec.coordinate_forces) {
    const std::string path = "/joint_forces/" + force.name + "/";
    coordinate_forces_.push_back(
        {writer_.series(path + "force_or_torque", 1, unit_on(force.coordinate), "effort on the joint coordinate"),
         writer_.series(path + "power", 1, "W", "power put into the machine")});
  }
  const auto since_start = [&](const std::string& name, const char* what) {
    return writer_.series("/energy/since_start/" + name, 1, "J", what);
  };
  energy_ = {writer_.series("/energy/kinetic", 1, "J", "kinetic energy"),
             writer_.series("/energy/potential", 1, "J", "potential energy of gravity"),
             writer_.series("/energy/springs", 1, "J", "energy stored in springs and contacts"),
             writer_.series("/energy/strain", 1, "J", "strain energy of flexible bodies"),
             since_start("put_in", "put in by drives, motors, loads and pressures"),
             since_start("film_dissipation", "dissipated by shear and flow in the films"),
             since_start("boundary_friction", "dissipated by asperities in the films"),
             since_start("contacts", "lost in contacts"),
             since_start("dampers", "lost in dampers, joint friction and the material of flexible bodies"),
             since_start("oil", "taken along by oil that leaves the films less what feeds bring"),
             since_start("film_storage", "stored in liners, asperities and compressed oil"),
             since_start("unexplained", "put in, and neither lost nor stored nor taken along")};
  power_ = {writer_.series("/power/drives", 1, "W", "put in by drives"),
            writer_.series("/power/loads", 1, "W", "put in by applied forces and torques"),
            writer_.series("/power/gravity", 1, "W", "put in by gravity"),
            writer_.series("/power/springs", 1, "W", "given to the bodies by springs and dampers"),
            writer_.series("/power/contacts", 1, "W", "given to the bodies by contacts"),
            writer_.series("/power/bearings", 1, "W", "given to the bodies by the films (negative: taken)"),
            writer_.series("/power/elastic", 1, "W", "given back by flexible bodies (negative: stored or dissipated)"),
            writer_.series("/power/kinetic_rate", 1, "W", "rate of change of the kinetic energy"),
            writer_.series("/power/balance_error", 1, "W",
                           "sum of all powers less the kinetic rate: residual of the equations of motion"),
            writer_.series("/power/unexplained", 1, "W",
                           "the same with what the films take by integrals of their own in place of bearings"),
            writer_.series("/power/film_friction", 1, "W", "viscous dissipation in all films"),
            writer_.series("/power/asperity_friction", 1, "W", "boundary friction in all films")};
}

// Cycles are no instants: a group called fields counts its rows by itself.
void Recorder::declare_cycles() {
  if (!model_.simulation.cycle) return;
  cycle_end_ = writer_.series("/cycles/fields/time", 1, "s", "end of the cycle");
  cycle_change_ = writer_.series("/cycles/fields/change", 1, "1",
                                 "largest difference from the cycle before of a bearing's smallest film thickness, "
                                 "peak pressure and mean friction loss, over the larger");
  writer_.attribute("/cycles", "period", model_.simulation.cycle->period);
  writer_.attribute("/cycles", "tolerance", model_.simulation.cycle->tolerance);
}

void Recorder::write_cycle(double t, double change) const {
  cycle_end_.append(t);
  cycle_change_.append(change);
}

void Recorder::write_row(const StepRecord& step, const EnergySummary& energy) {
  const mbd::Observation& seen = step.mechanism;
  time_.append(seen.t);
  if (const auto& crank = model_.simulation.crank) {
    crank_angle_.append(crank->initial_angle + crank->speed * (seen.t - model_.simulation.start));
  }
  dt_.append(step.dt);
  newton_iterations_.append(step.newton_iterations);
  residual_.append(step.newton_residual);
  rejected_.append(step.rejected_steps);
  drift_.append(step.constraint_drift);
  if (model_.simulation.error_control) error_.append(step.error);
  if (integrates()) step_error_.append(step.step_error);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (hidden_bodies_[i + 1]) continue;
    const mbd::FrameMotion& motion = seen.bodies[i + 1];
    const Eigen::Quaterniond R(motion.X_WF.R);
    bodies_[i].position.append(motion.X_WF.r);
    bodies_[i].orientation.append({R.w(), R.x(), R.y(), R.z()});
    bodies_[i].velocity.append(motion.v);
    bodies_[i].angular_velocity.append(motion.omega);
    bodies_[i].acceleration.append(motion.a);
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (hidden_joints_[i]) continue;
    const mbd::JointObservation& joint = seen.joints[i];
    if (joint.position.size() > 0) {
      joints_[i].coordinates.append({joint.position.data(), static_cast<std::size_t>(joint.position.size())});
      joints_[i].rates.append({joint.rate.data(), static_cast<std::size_t>(joint.rate.size())});
    }
    joints_[i].force.append(joint.force);
    joints_[i].torque.append(joint.torque);
  }
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    drives_[i].effort.append(seen.drive_efforts[i]);
    drives_[i].power.append(seen.drive_powers[i]);
  }
  for (std::size_t i = 0; i < couplings_.size(); ++i) couplings_[i].append(seen.coupling_efforts[i]);
  for (std::size_t i = 0; i < coordinate_forces_.size(); ++i) {
    coordinate_forces_[i].effort.append(seen.coordinate_force_efforts[i]);
    coordinate_forces_[i].power.append(seen.coordinate_force_powers[i]);
  }
  write_contacts(step.contacts);
  energy_.kinetic.append(seen.kinetic_energy);
  energy_.potential.append(seen.potential_energy);
  energy_.springs.append(seen.spring_energy);
  energy_.put_in.append(energy.put_in);
  energy_.films.append(energy.films);
  energy_.boundary_friction.append(energy.boundary_friction);
  energy_.contacts.append(energy.contacts);
  energy_.dampers.append(energy.dampers);
  energy_.oil.append(energy.oil);
  energy_.film_storage.append(energy.film_storage);
  energy_.unexplained.append(energy.unexplained());
  write_flexible_bodies(seen);
  write_surface_loads(seen);
  write_beams(seen);

  const PowerBalance& power = step.power;
  power_.drives.append(power.drives);
  power_.loads.append(power.loads);
  power_.gravity.append(power.gravity);
  power_.springs.append(power.springs);
  power_.contacts.append(power.contacts);
  power_.bearings.append(power.bearings);
  power_.elastic.append(power.elastic);
  power_.kinetic_rate.append(power.kinetic_rate);
  power_.balance_error.append(power.error());
  power_.unexplained.append(power.unexplained());
  double film_friction = 0, asperity_friction = 0;
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    write_bearing(bearings_[i], step.bearings[i]);
    write_around(i);
    film_friction += step.bearings[i].film.power_film;
    asperity_friction += step.bearings[i].film.power_asperity;
  }
  power_.film_friction.append(film_friction);
  power_.asperity_friction.append(asperity_friction);
}

void Recorder::persist(Archive& archive, const std::filesystem::path& results) {
  std::string names;
  std::vector<std::size_t> counts;
  if (!archive.restores()) {
    for (const auto& [name, count] : writer_.rows()) {
      names += name + "\n";
      counts.push_back(count);
    }
  }
  archive.io("series", names);
  archive.io("rows", counts);
  {
    const Archive::Group group(archive, "cycles");
    cycles_.persist(archive);
  }
  if (!archive.restores()) return;
  std::vector<std::pair<std::string, std::size_t>> rows;
  std::istringstream lines(names);
  std::string name;
  for (const std::size_t count : counts) {
    std::getline(lines, name);
    rows.emplace_back(name, count);
  }
  {
    const results::Reader before(results);
    writer_.copy_rows(before, rows);
    if (const auto created = before.text_attribute("/", "created")) writer_.attribute("/", "created", *created);
  }
  writer_.rename(results);
}

void Recorder::write_step_errors(const std::string& bearing, const StepErrors& errors) {
  const std::string group = "/step_errors/" + bearing;
  writer_.attribute(group, "moft", errors.moft);
  writer_.attribute(group, "pofp", errors.pofp);
  writer_.attribute(group, "max_force", errors.max_force);
  writer_.attribute(group, "mean_power", errors.mean_power);
  writer_.attribute(group, "mean_flow", errors.mean_flow);
}

void Recorder::declare_cost(const Work& work) {
  write_cost(0, work, 0);
  writer_.flush();
}

void Recorder::write_cost(double wall_time, const Work& work, int steps) {
  writer_.attribute("/", "wall_time", wall_time);
  write_work(work, steps, writer_);
}

void Recorder::finish(results::Status status, const std::string& message, double wall_time, const Work& work,
                      int steps) {
  cycles_.finish();
  write_cost(wall_time, work, steps);
  writer_.finish(status, message);
}

}  // namespace hersey::run
