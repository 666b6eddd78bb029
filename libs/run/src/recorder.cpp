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
#include "work_record.h"

namespace hersey::run {
namespace {

// Attitude: from the load on the journal (the shell's film force turned round) to the line of centres, 0..pi.
double attitude(const bearing::BearingObservation& seen) {
  const Eigen::Vector2d load = seen.wrench_on_shell.tail<3>().head<2>();
  const double cross = load.x() * seen.e.y() - load.y() * seen.e.x();
  return std::abs(std::atan2(cross, load.dot(seen.e)));
}

std::vector<double> angles(const film::Grid& grid) {
  std::vector<double> phi(static_cast<std::size_t>(grid.n_phi));
  for (int i = 0; i < grid.n_phi; ++i) phi[static_cast<std::size_t>(i)] = grid.phi(i);
  return phi;
}

std::vector<double> heights(const film::FilmModel& film) {
  std::vector<double> z(static_cast<std::size_t>(film.grid.n_z));
  for (int j = 0; j < film.grid.n_z; ++j) {
    z[static_cast<std::size_t>(j)] = film.L * film.grid.z_over_L(j);
  }
  return z;
}

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
  path += ".resuming";
  return path;
}

Recorder::Recorder(const model::Model& model, const model::Machine& machine, const Options& options, bool resumes)
    : model_(model),
      machine_(machine),
      writer_(resumes ? unfinished_file(options.results) : options.results,
              {.overwrite = resumes || options.overwrite}),
      cycles_(model, machine, writer_) {
  hide_inner_nodes();
  declare_run(options);
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
}

void Recorder::declare_run(const Options& options) {
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
      series.coordinates = writer_.series(path + "coordinates", n, mixed ? "SI" : (rotational ? "rad" : "m"),
                                          "joint coordinates, names in the joint's attribute coordinate_names");
      series.rates = writer_.series(path + "rates", n, mixed ? "SI" : (rotational ? "rad/s" : "m/s"),
                                    "rates of the joint coordinates");
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
  energy_ = {writer_.series("/energy/kinetic", 1, "J", "kinetic energy"),
             writer_.series("/energy/potential", 1, "J", "potential energy of gravity"),
             writer_.series("/energy/springs", 1, "J", "energy stored in springs and contacts"),
             writer_.series("/energy/strain", 1, "J", "strain energy of flexible bodies")};
  power_ = {writer_.series("/power/drives", 1, "W", "put in by drives"),
            writer_.series("/power/loads", 1, "W", "put in by applied forces and torques"),
            writer_.series("/power/gravity", 1, "W", "put in by gravity"),
            writer_.series("/power/springs", 1, "W", "given to the bodies by springs and dampers"),
            writer_.series("/power/contacts", 1, "W", "given to the bodies by contacts"),
            writer_.series("/power/bearings", 1, "W", "given to the bodies by the films (negative: taken)"),
            writer_.series("/power/elastic", 1, "W", "given back by flexible bodies (negative: stored or dissipated)"),
            writer_.series("/power/kinetic_rate", 1, "W", "rate of change of the kinetic energy"),
            writer_.series("/power/balance_error", 1, "W", "sum of all powers less the kinetic rate"),
            writer_.series("/power/film_friction", 1, "W", "viscous dissipation in all films"),
            writer_.series("/power/asperity_friction", 1, "W", "boundary friction in all films")};
}

Recorder::BearingSeries Recorder::declare_bearing(const model::Bearing& bearing) {
  const std::string group = "/bearings/" + bearing.name, path = group + "/";
  const film::FilmModel& film = bearing.film;
  writer_.attribute(group, "radius", film.R);
  writer_.attribute(group, "width", film.L);
  writer_.attribute(group, "radial_clearance", film.c);
  writer_.attribute(group, "n_phi", film.grid.n_phi);
  writer_.attribute(group, "n_z", film.grid.n_z);
  for (const auto& [name, text] : assumptions(model_)) {
    if (name.starts_with(bearing.name + ": ")) writer_.attribute(group, name.substr(bearing.name.size() + 2), text);
  }
  const auto series = [&](const char* name, const char* unit, const char* description, int columns = 1) {
    return writer_.series(path + name, columns, unit, description);
  };
  BearingSeries s;
  s.eccentricity = series("eccentricity", "m", "journal axis from bore axis at z = 0, bearing frame", 2);
  s.ratio = series("eccentricity_ratio", "1", "eccentricity over radial clearance");
  s.attitude = series("attitude", "rad", "angle between load and line of centres");
  s.tilt = series("tilt", "1", "slope of the journal's axis in the bearing frame", 2);
  s.h_min = series("h_min", "m", "smallest film thickness on the surface, edges included");
  s.h_min_phi = series("h_min_phi", "rad", "where: bearing angle");
  s.h_min_z = series("h_min_z", "m", "where: axial");
  s.h_min_centre = series("h_min_centre", "m", "smallest film thickness at z = 0");
  s.p_max = series("p_max", "Pa", "peak film pressure, interpolated");
  s.p_max_phi = series("p_max_phi", "rad", "where: bearing angle");
  s.p_max_z = series("p_max_z", "m", "where: axial");
  s.p_max_node = series("p_max_node", "Pa", "largest nodal film pressure");
  s.force = series("force", "N", "film force on the shell, bearing frame", 3);
  s.force_pressure = series("force_pressure", "N", "its part from film pressure", 3);
  s.force_shear = series("force_shear", "N", "its part from shear", 3);
  s.force_asperity = series("force_asperity", "N", "its part from asperity contact", 3);
  s.moment = series("moment", "N.m", "film moment on the shell about the bearing's origin", 3);
  s.speed = series("speed", "rad/s", "journal's angular velocity relative to the shell");
  s.torque_journal = series("torque_journal", "N.m", "friction torque on the journal about its own axis");
  s.torque_shell = series("torque_shell", "N.m", "friction torque on the shell about its own axis");
  s.power_film = series("power_film", "W", "viscous dissipation in the film");
  s.power_asperity = series("power_asperity", "W", "boundary friction");
  s.power_into_bodies = series("power_into_bodies", "W", "film wrench times relative velocity (negative: taken)");
  s.flow_left = series("flow_left", "m^3/s", "oil leaving over the edge z = -L/2");
  s.flow_right = series("flow_right", "m^3/s", "oil leaving over the edge z = +L/2");
  s.flow_supply = series("flow_supply", "m^3/s", "oil entering through the supply");
  for (const film::SurfaceFeature& feature : film.features) {
    s.flow_features.push_back(
        series(("flow_feature_" + feature.name).c_str(), "m^3/s", "oil entering through this feature"));
  }
  s.storage_rate = series("storage_rate", "m^3/s", "rate of change of the oil volume in the film");
  s.oil_volume = series("oil_volume", "m^3", "oil volume in the film");
  s.mass_balance_error = series("mass_balance_error", "1", "|supply - edges - storage| over the largest flow");
  s.cavitated_share = series("cavitated_share", "1", "share of the area that is cavitated");
  s.film_iterations = series("film_iterations", "1", "film linearisations in the step");
  if (bearing.coupling.scheme == model::CouplingScheme::partitioned)
    s.exchanges = series("exchanges", "1", "wrenches that film and bodies exchanged in the step");
  const auto around = [&](const char* name, const char* unit, const char* description) {
    return writer_.series(path + name, film.grid.n_phi, unit, description, results::Precision::float32);
  };
  s.h_min_around = around("h_min_around", "m", "smallest film thickness over the width at each angle of fields/phi");
  s.p_max_around = around("p_max_around", "Pa", "largest film pressure over the width at each angle of fields/phi");
  declare_fields(bearing, s);
  return s;
}

void Recorder::declare_fields(const model::Bearing& bearing, BearingSeries& s) {
  const std::string path = "/bearings/" + bearing.name + "/fields/";
  const film::Grid& grid = bearing.film.grid;
  writer_.constant(path + "phi", angles(grid), "rad", "bearing angle of the nodes");
  writer_.constant(path + "z", heights(bearing.film), "m", "axial position of the nodes");
  const std::array<int, 2> shape{grid.n_phi, grid.n_z};
  s.field_time = writer_.series(path + "time", 1, "s", "time of the fields");
  s.pressure = writer_.field(path + "pressure", shape, "Pa", "film pressure");
  s.thickness = writer_.field(path + "thickness", shape, "m", "film thickness");
  s.fill = writer_.field(path + "fill", shape, "1", "fill fraction");
  s.asperity_pressure = writer_.field(path + "asperity_pressure", shape, "Pa", "asperity contact pressure");
  const film::FilmFields start = machine_.bearings[bearings_.size()].bearing->fields();
  const auto displacement = [&](const char* name, const char* whose) {
    return writer_.field(path + name, shape, "m", fmt::format("radial displacement of the {}, outward", whose));
  };
  if (start.d_shell.size() > 0) s.shell_displacement = displacement("shell_displacement", "shell's surface");
  if (start.d_journal.size() > 0) s.journal_displacement = displacement("journal_displacement", "journal's surface");
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

void Recorder::write_row(const StepRecord& step) {
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
    if (!joint.position.empty()) {
      joints_[i].coordinates.append(joint.position);
      joints_[i].rates.append(joint.rate);
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
  double film_friction = 0, asperity_friction = 0;
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    write_bearing(bearings_[i], step.bearings[i], model_.bearings[i].film.c);
    write_around(i);
    film_friction += step.bearings[i].film.power_film;
    asperity_friction += step.bearings[i].film.power_asperity;
  }
  power_.film_friction.append(film_friction);
  power_.asperity_friction.append(asperity_friction);
}

void Recorder::declare_modes() {
  // Modes are no instants: a group called fields counts its rows by itself.
  const std::string path = "/modes/fields/";
  const auto series = [&](const char* name, const char* unit, const char* description, int columns = 1) {
    return writer_.series(path + name, columns, unit, description);
  };
  const auto nv = static_cast<int>(machine_.mechanism->nv());
  modes_ = {.frequency = series("frequency", "Hz", "natural frequency |s|/(2 pi), one row per mode"),
            .damped_frequency = series("damped_frequency", "Hz", "frequency of the damped motion, Im s/(2 pi)"),
            .damping_ratio = series("damping_ratio", "1", "-Re s/|s|; negative: the motion grows"),
            .real = series("eigenvalue_real", "1/s", "real part of the eigenvalue s"),
            .imaginary = series("eigenvalue_imaginary", "1/s", "imaginary part of the eigenvalue s"),
            .shape_real = series("shape_real", "1", "mode shape, real part: increments of the coordinates", nv),
            .shape_imaginary = series("shape_imaginary", "1", "mode shape, imaginary part", nv),
            .body_real = series("body_real", "1", "mode shape, real part: small rotation and displacement of each body",
                                6 * static_cast<int>(bodies_.size())),
            .body_imaginary =
                series("body_imaginary", "1", "the same, imaginary part", 6 * static_cast<int>(bodies_.size()))};
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(nv));
  for (int k = 0; k < nv; ++k) names.push_back(machine_.mechanism->name_of_row(k));
  writer_.attribute("/modes", "coordinates", names);
  const std::vector<mbd::BodySpec>& all = machine_.mechanism->spec().bodies;
  std::vector<std::string> bodies;
  bodies.reserve(all.size());
  for (std::size_t i = 1; i < all.size(); ++i) bodies.push_back(all[i].name);
  writer_.attribute("/modes", "bodies", bodies);
  declare_flexible_modes();
  declare_beam_modes();
}

// Rotation and displacement of every body for small increments of the coordinates: what a velocity would give.
Eigen::VectorXd Recorder::body_increments(const solver::State& state, const Eigen::VectorXd& shape) const {
  solver::State moving = state;
  moving.v = shape;
  const std::vector<mbd::FrameId>& frames = machine_.mechanism->spec().body_frames;
  Eigen::VectorXd all(6 * static_cast<Eigen::Index>(bodies_.size()));
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const mbd::FrameMotion motion = machine_.mechanism->frame_motion(moving, frames[i + 1]);
    all.segment<6>(6 * static_cast<Eigen::Index>(i)) << motion.omega, motion.v;
  }
  return all;
}

void Recorder::write_modes(const solver::State& state, const solver::Modes& found) {
  for (const solver::Mode& mode : found.modes) {
    modes_.frequency.append(mode.frequency);
    modes_.damped_frequency.append(mode.damped_frequency);
    modes_.damping_ratio.append(mode.damping_ratio);
    modes_.real.append(mode.s.real());
    modes_.imaginary.append(mode.s.imag());
    modes_.shape_real.append(Eigen::VectorXd(mode.shape.real()));
    modes_.shape_imaginary.append(Eigen::VectorXd(mode.shape.imag()));
    modes_.body_real.append(body_increments(state, mode.shape.real()));
    modes_.body_imaginary.append(body_increments(state, mode.shape.imag()));
    write_flexible_mode(state, mode.shape);
    write_beam_mode(state, mode.shape);
  }
  writer_.attribute("/modes", "stable", found.stable ? 1 : 0);
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

void Recorder::write_bearing(const BearingSeries& s, const bearing::BearingObservation& seen, double clearance) const {
  const film::FilmObservables& film = seen.film;
  s.eccentricity.append(seen.e);
  s.ratio.append(seen.e.norm() / clearance);
  s.attitude.append(attitude(seen));
  s.tilt.append(seen.tilt);
  s.h_min.append(film.h_min);
  s.h_min_phi.append(film.h_min_phi);
  s.h_min_z.append(film.h_min_z);
  s.h_min_centre.append(film.h_min_centre);
  s.p_max.append(film.p_max);
  s.p_max_phi.append(film.p_max_phi);
  s.p_max_z.append(film.p_max_z);
  s.p_max_node.append(film.p_max_node);
  s.force.append(Vector3(seen.wrench_on_shell.tail<3>()));
  s.force_pressure.append(film.force_pressure);
  s.force_shear.append(film.force_shear);
  s.force_asperity.append(film.force_asperity);
  s.moment.append(Vector3(seen.wrench_on_shell.head<3>()));
  s.speed.append(seen.speed);
  s.torque_journal.append(film.torque_journal);
  s.torque_shell.append(film.torque_shell);
  s.power_film.append(film.power_film);
  s.power_asperity.append(film.power_asperity);
  s.power_into_bodies.append(seen.power_into_bodies);
  s.flow_left.append(film.flow_left);
  s.flow_right.append(film.flow_right);
  s.flow_supply.append(film.flow_supply);
  for (std::size_t f = 0; f < s.flow_features.size(); ++f) {
    s.flow_features[f].append(film.flow_features[static_cast<Eigen::Index>(f)]);
  }
  s.storage_rate.append(film.storage_rate);
  s.oil_volume.append(film.oil_volume);
  s.mass_balance_error.append(film.mass_balance_error);
  s.cavitated_share.append(film.cavitated_share);
  s.film_iterations.append(seen.film_iterations);
  if (s.exchanges) s.exchanges->append(seen.exchanges);
}

// Over the width at each angle: index i n_z + j of a field is angle i, height j.
void Recorder::write_around(std::size_t bearing) const {
  const film::FilmFields fields = machine_.bearings[bearing].bearing->fields();
  const film::Grid& grid = model_.bearings[bearing].film.grid;
  using Map = Eigen::Map<const Eigen::MatrixXd>;
  const Eigen::VectorXd h = Map(fields.h.data(), grid.n_z, grid.n_phi).colwise().minCoeff();
  const Eigen::VectorXd p = Map(fields.p.data(), grid.n_z, grid.n_phi).colwise().maxCoeff();
  bearings_[bearing].h_min_around.append(h);
  bearings_[bearing].p_max_around.append(p);
}

void Recorder::write_fields(const StepRecord& step) {
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    const film::FilmFields fields = machine_.bearings[i].bearing->fields();
    bearings_[i].field_time.append(step.mechanism.t);
    bearings_[i].pressure.append(fields.p);
    bearings_[i].thickness.append(fields.h);
    bearings_[i].fill.append(fields.theta);
    bearings_[i].asperity_pressure.append(fields.p_asperity);
    if (bearings_[i].shell_displacement) bearings_[i].shell_displacement->append(fields.d_shell);
    if (bearings_[i].journal_displacement) bearings_[i].journal_displacement->append(fields.d_journal);
  }
}

}  // namespace hersey::run
