#include "record/recorder.h"

#include <sstream>
#include <utility>

#include "hersey/core/task_pool.h"
#include "hersey/results/reader.h"
#include "record/header_record.h"
#include "series/geometry_record.h"
#include "series/work_record.h"

namespace hersey::run {

std::filesystem::path unfinished_file(const std::filesystem::path& results) {
  std::filesystem::path path = results;
  path += ".unfinished";
  return path;
}

namespace {

/// Number of rows for a fixed step or an interval of output.
std::size_t expected_rows(const model::Model& model) {
  const double interval =
      model.output.interval > 0 ? model.output.interval : model.simulation.step * model.output.every;
  const double rows = interval > 0 ? model.simulation.duration / interval : 0;
  return rows < 1e9 ? static_cast<std::size_t>(std::max(rows, 0.0)) : 0;
}

/// Returns the file to write. Results appear under their own name when everything that is written before the first step
/// is in them, so that they always contain the model; until then the results that they replace remain.
std::filesystem::path new_file(const Options& options, bool resumes) {
  if (!resumes && !options.overwrite && std::filesystem::exists(options.results))
    throw results::FileExists(options.results);
  return unfinished_file(options.results);
}

results::Writer writer_of(const model::Model& model, const Options& options, bool resumes) {
  if (options.results.empty()) return results::Writer(results::InMemory{});
  return results::Writer(
      new_file(options, resumes),
      {.overwrite = true, .rows = expected_rows(model), .writes_beside = TaskPool::shared().threads() > 1});
}

/// Inner nodes of beams, bodies and joints of the mechanism, are not written one by one.
struct Hidden {
  std::vector<bool> bodies, joints;
};

Hidden hidden_parts(const model::Machine& machine) {
  const mbd::MechanismSpec& spec = machine.mechanism->spec();
  Hidden hidden{std::vector<bool>(spec.bodies.size(), false), std::vector<bool>(spec.joints.size(), false)};
  hidden.bodies[0] = true;  // ground
  for (const model::BuiltBeam& beam : machine.beams) {
    for (std::size_t i = 0; i < beam.is_named.size(); ++i)
      hidden.bodies[static_cast<std::size_t>(beam.ids.bodies[i].index)] = !beam.is_named[i];
    for (const mbd::JointId joint : beam.ids.freedoms) hidden.joints[static_cast<std::size_t>(joint.index)] = true;
  }
  return hidden;
}

std::vector<std::size_t> indices_of_shown(const std::vector<bool>& hidden) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < hidden.size(); ++i)
    if (!hidden[i]) indices.push_back(i);
  return indices;
}

}  // namespace

Recorder::Recorder(const model::Model& model, const model::Machine& machine, const solver::State& start,
                   const Options& options, bool resumes)
    : model_(model), machine_(machine), writer_(writer_of(model, options, resumes)), friction_sums_(machine) {
  write_header(model, machine, start, options, writer_);
  declare();
  writer_.flush();
  if (!resumes) writer_.rename(options.results, options.overwrite);
}

void Recorder::declare() {
  const mbd::MechanismSpec& spec = machine_.mechanism->spec();
  const Hidden hidden = hidden_parts(machine_);
  shown_bodies_ = indices_of_shown(hidden.bodies);
  shown_joints_ = indices_of_shown(hidden.joints);
  system_.emplace(model_, writer_);
  bodies_.reserve(shown_bodies_.size());
  joints_.reserve(shown_joints_.size());
  const auto last_of = [](const auto& records) { return records.empty() ? nullptr : &records.back(); };
  for (const std::size_t i : shown_bodies_) bodies_.emplace_back(spec.bodies[i].name, last_of(bodies_), writer_);
  for (const std::size_t i : shown_joints_) joints_.emplace_back(spec.joints[i], last_of(joints_), writer_);
  efforts_.emplace(spec, writer_);
  for (const model::Fmu& fmu : model_.fmus) fmus_.emplace_back(fmu, writer_);
  for (const model::BuiltFlexible& body : machine_.flexibles) flexibles_.emplace_back(body, writer_);
  surface_loads_.emplace(machine_, writer_);
  for (const model::BuiltBeam& beam : machine_.beams) beams_.emplace_back(model_, machine_, beam, writer_);
  for (const model::Contact& contact : model_.contacts) contacts_.emplace_back(contact, writer_);
  for (const model::BuiltRing& ring : machine_.rings) rings_.emplace_back(ring, writer_);
  for (const model::BuiltMesh& mesh : machine_.gear_meshes) meshes_.emplace_back(mesh, writer_);
  for (std::size_t i = 0; i < model_.bearings.size(); ++i) {
    const bearing::FilmForce& film = *machine_.bearings[i].bearing;
    bearings_.emplace_back(BearingPlan{model_, model_.bearings[i], film.fields()}, film, writer_);
  }
  if (!model_.thermal.network.nodes.empty()) thermal_.emplace(model_, writer_);
  if (model_.circuit) circuit_.emplace(*model_.circuit, writer_);
  for (const model::Composite& composite : model_.composites)
    if (GroupRecord::is_in(model_, composite)) groups_.emplace_back(model_, machine_, composite, writer_);
  cycle_maps_.emplace(model_, machine_, writer_);
  if (model_.simulation.cycle) {
    cycles_.emplace(model_, writer_);
    if (model_.simulation.cycle->multipliers > 0) multipliers_.emplace(model_, writer_);
  }
  write_geometry(model_, spec, hidden.joints, writer_);
  if (model_.simulation.analysis == model::Analysis::modes) modes_.emplace(model_, machine_, writer_);
}

void Recorder::write_row(const StepRecord& step, const EnergySummary& energy) {
  const mbd::Observation& observation = step.mechanism;
  system_->append({model_, step, energy});
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].append(observation.bodies[shown_bodies_[i]]);
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i].append(observation.joints[shown_joints_[i]]);
  efforts_->append(observation);
  for (std::size_t i = 0; i < fmus_.size(); ++i) fmus_[i].append(step.fmus[i]);
  for (const FlexibleRecord& body : flexibles_) body.append(observation);
  surface_loads_->append(observation);
  for (const BeamRecord& beam : beams_) beam.append(observation);
  for (std::size_t i = 0; i < contacts_.size(); ++i) contacts_[i].append(step.contacts[i]);
  for (const RingRecord& ring : rings_) ring.append(observation);
  for (std::size_t i = 0; i < meshes_.size(); ++i) meshes_[i].append(step.meshes[i]);
  for (std::size_t i = 0; i < bearings_.size(); ++i) bearings_[i].append(step.bearings[i]);
  if (thermal_) thermal_->append({model_, step.network});
  if (circuit_) circuit_->append(step.circuit);
  for (const GroupRecord& group : groups_) group.append(step);
}

void Recorder::write_fields(const StepRecord& step) {
  for (const BearingRecord& bearing : bearings_) bearing.append_fields(step.mechanism.t);
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
    cycle_maps_->persist(archive);
  }
  {
    const Archive::Group group(archive, "rings");
    friction_sums_.persist(archive);
  }
  if (!archive.restores() || results.empty()) return;
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
  write_work(work, 0, 0, writer_);
  writer_.flush();
}

void Recorder::write_step_errors(const std::string& bearing, const StepErrors& errors) {
  run::write_step_errors(bearing, errors, writer_);
}

void Recorder::finish(results::Status status, const std::string& message, double wall_time, const Work& work,
                      int steps) {
  cycle_maps_->finish();
  write_work(work, wall_time, steps, writer_);
  writer_.finish(status, message);
}

}  // namespace hersey::run
