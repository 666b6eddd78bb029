#include "interpret/context/interpret.h"

#include <algorithm>

#include "hersey/core/spelling.h"
#include "hersey/mbd/joint.h"
#include "schema/bearing_keys.h"

namespace hersey::model {

namespace {

/// A fault of a file that `at` names: the file and the line in it become part of what was found.
Fault at_value(const Value& at, const Fault& fault) {
  std::string location = fault.position.file;
  if (fault.position.line > 0) location += ":" + std::to_string(fault.position.line);
  return {at.position, at.path, location.empty() ? fault.found : location + ": " + fault.found, fault.expected,
          fault.suggestion};
}

}  // namespace

void Context::fault(const Value& at, std::string found, std::string expected, std::string suggestion) {
  faults.push_back({at.position, at.path, std::move(found), std::move(expected), std::move(suggestion)});
}

void Context::fault_at_key(const Value& at, std::string found, std::string expected, std::string suggestion) {
  faults.push_back({at.key_position, at.path, std::move(found), std::move(expected), std::move(suggestion)});
}

void Context::faults_in_file(const Value& at, const std::vector<Fault>& faults_of_file) {
  for (const Fault& fault : faults_of_file) faults.push_back(at_value(at, fault));
}

void Context::warnings_in_file(const Value& at, const std::vector<Fault>& warnings_of_file) {
  for (const Fault& warning : warnings_of_file) model.warnings.push_back(at_value(at, warning));
}

bool Context::has_fault_in(const std::string& path) const {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const Fault& fault) { return fault.path == path || fault.path.starts_with(path + "."); });
}

Vector3 direction_of(Context& context, const Value& parent, const std::string& key) {
  const Value* value = parent.find(key);
  if (value == nullptr || value->broken) return Vector3::UnitZ();
  if (value->text == "x") return Vector3::UnitX();
  if (value->text == "y") return Vector3::UnitY();
  if (value->text == "z") return Vector3::UnitZ();
  const Vector3 direction = vector_of(parent, key);
  if (direction.norm() > 0) return direction.normalized();
  context.fault(*value, "a direction of length 0", value->type->expectation());
  return Vector3::UnitZ();
}

FrameName frame_of(Context& context, const Value& reference) {
  const auto dot = reference.text.find('.');
  FrameName name{reference.text.substr(0, dot), "", reference.position};
  if (dot != std::string::npos) name.frame = reference.text.substr(dot + 1);
  const Value* given = context.root.find("bodies");
  if (reference.broken || given == nullptr) return name;
  const Value* body = given->find(name.body);
  if (body == nullptr && name.body != "ground") {
    std::vector<std::string> bodies = names_in(context.root, "bodies");
    if (given->find("ground") == nullptr) bodies.insert(bodies.begin(), "ground");
    context.fault(reference, "unknown body '" + name.body + "'", one_of(bodies), did_you_mean(name.body, bodies));
    return name;
  }
  if (name.frame.empty()) return name;
  std::vector<std::string> frames = body != nullptr ? names_in(*body, "frames") : std::vector<std::string>{};
  for (const Body& read : context.model.bodies)  // a reduced body brings its frames along
    if (read.flexible && read.flexible->reduced && read.name == name.body) {
      frames.clear();
      for (const Frame& frame : read.frames) frames.push_back(frame.name);
    }
  if (std::find(frames.begin(), frames.end(), name.frame) == frames.end()) {
    const std::string found = "unknown frame '" + name.frame + "' of body '" + name.body + "'";
    const std::string expected = frames.empty() ? "'" + name.body + "' alone, for it has no frames" : one_of(frames);
    context.fault(reference, found, expected, did_you_mean(name.frame, frames));
  }
  return name;
}

void require_name(Context& context, const Value& reference, const std::string& key, const std::string& what) {
  if (reference.broken) return;
  const std::vector<std::string> names = names_in(context.root, key);
  if (std::find(names.begin(), names.end(), reference.text) != names.end()) return;
  context.fault(reference, "unknown " + what + " '" + reference.text + "'",
                names.empty() ? "a " + what + ", but the model has none" : one_of(names),
                did_you_mean(reference.text, names));
}

void check_completeness(Context& context) {
  const auto has = [&](const char* key) { return context.root.find(key) != nullptr; };
  const bool has_machine = has("bodies") || has("simulation") || has("joints") || has("drives") || has("forces") ||
                           has("contacts") || !has("bearings");
  if (!has_machine || context.root.broken) return;
  const auto require = [&](const Value& parent, const std::string& key) {
    if (parent.broken || parent.find(key) != nullptr) return;
    for (const Key* known : all_keys(*parent.type))
      if (known->name == key)
        return context.fault_at_key(parent, "missing key '" + key + "'", known->type->expectation());
  };
  require(context.root, "bodies");
  require(context.root, "simulation");
  for (const auto& [name, bearing] : section(context.root, "bearings")) {
    for (const BearingKindFormat& kind : bearing_kind_formats()) {
      if (kind.tag != bearing.text) continue;
      require(bearing, kind.surfaces.fixed);
      require(bearing, kind.surfaces.moving);
    }
    const Value* thermal = bearing.find("thermal");
    if (thermal != nullptr && !thermal->broken && thermal->text == "global") {
      context.fault_at_key(*thermal, "one effective temperature by a balance of heat, in a machine",
                           "`model: film`, or `isothermal` with a temperature",
                           "the balance is one of steady bearings, by themselves");
    }
  }
}

std::optional<std::vector<JointCoordinate>> coordinates_of_joint(const Value& root, const std::string& name) {
  for (const auto& [joint_name, joint] : section(root, "joints")) {
    if (joint_name != name) continue;
    const auto type = mbd::joint_type_of(joint.text);
    if (!type) return std::nullopt;
    std::vector<JointCoordinate> coordinates;
    for (const mbd::Coordinate& coordinate : mbd::coordinates_of(*type)) {
      if (coordinate.size == 1) coordinates.push_back({std::string(coordinate.name), coordinate.rotational});
    }
    return coordinates;
  }
  return std::nullopt;
}

std::optional<JointCoordinate> coordinate_of(Context& context, const Value& parent) {
  const Value* joint = parent.find("joint");
  const Value* coordinate = parent.find("coordinate");
  if (joint != nullptr) require_name(context, *joint, "joints", "joint");
  if (joint == nullptr || coordinate == nullptr || coordinate->broken) return std::nullopt;
  const auto coordinates = coordinates_of_joint(context.root, joint->text);
  if (!coordinates) return std::nullopt;
  std::vector<std::string> names;
  for (const JointCoordinate& candidate : *coordinates) {
    if (candidate.name == coordinate->text) return candidate;
    names.push_back(candidate.name);
  }
  const std::string found = "unknown coordinate '" + coordinate->text + "' of joint '" + joint->text + "'";
  const std::string expected = names.empty() ? "a joint with scalar coordinates" : one_of(names);
  context.fault(*coordinate, found, expected, did_you_mean(coordinate->text, names));
  return std::nullopt;
}

}  // namespace hersey::model
