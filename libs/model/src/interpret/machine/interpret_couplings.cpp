#include <map>

#include "hersey/core/spelling.h"
#include "interpret/context/interpret.h"

namespace hersey::model {
namespace {

/// A coordinate written `joint.coordinate`.
struct Found {
  CoordinateName name;
  bool rotational = false;
  bool valid = false;
};

Found coordinate_called(Context& context, const Value& parent, const std::string& key) {
  const Value* value = parent.find(key);
  if (value == nullptr || value->broken) return {};
  std::vector<std::string> names;
  for (const std::string& joint : names_in(context.root, "joints")) {
    const auto coordinates = coordinates_of_joint(context.root, joint);
    if (!coordinates) continue;
    for (const JointCoordinate& coordinate : *coordinates) {
      const std::string name = joint + "." + coordinate.name;
      if (name == value->text) return {{joint, coordinate.name}, coordinate.rotational, true};
      names.push_back(name);
    }
  }
  context.fault(*value, "unknown coordinate '" + value->text + "'",
                names.empty() ? "a joint coordinate, but the model has none" : one_of(names),
                did_you_mean(value->text, names));
  return {};
}

std::string kind_of(bool rotational) { return rotational ? "a rotation" : "a translation"; }

void require_kind(Context& context, const Value& parent, const std::string& key, const Found& found, bool rotational) {
  if (!found.valid || found.rotational == rotational) return;
  context.fault(*parent.find(key), "'" + parent.find(key)->text + "', " + kind_of(found.rotational),
                kind_of(rotational));
}

CoordinateCoupling coupling_of(Context& context, const std::string& name, const Value& value) {
  CoordinateCoupling coupling{name, {}, {}, value.key_position};
  const Found output = coordinate_called(context, value, "output");
  coupling.output = output.name;
  const auto add = [&](const Value& parent, double factor) {
    const Found input = coordinate_called(context, parent, "input");
    if (input.valid && output.valid && input.name.joint == output.name.joint &&
        input.name.coordinate == output.name.coordinate)
      context.fault(*parent.find("input"), "a coordinate coupled to itself", "another coordinate than the output");
    coupling.terms.push_back({input.name, factor, {}});
    return input;
  };
  if (value.text == "gear") {
    const Found input = add(value, number_of(value, "ratio"));
    if (output.valid) require_kind(context, value, "input", input, output.rotational);
  } else if (value.text == "rack") {
    require_kind(context, value, "input", add(value, number_of(value, "radius")), true);
    require_kind(context, value, "output", output, false);
  } else if (value.text == "linear") {
    for (const auto& [index, term] : section(value, "inputs")) {
      const Found input = add(term, number_of(term, "factor"));
      if (output.valid) require_kind(context, term, "input", input, output.rotational);
    }
  } else if (value.text == "relation") {
    const Found input = add(value, 0);
    const Value* function = value.find("function");
    if (function != nullptr && input.valid && output.valid)
      coupling.terms.back().function =
          function_of(context, *function, output.rotational ? "rad" : "m", {"input", input.rotational ? "rad" : "m"});
  }
  return coupling;
}

}  // namespace

void interpret_couplings(Context& context) {
  std::map<std::string, std::string> prescribed_by;  // joint.coordinate -> what holds it
  for (const Drive& drive : context.model.drives)
    prescribed_by.try_emplace(drive.joint + "." + drive.coordinate, "drive '" + drive.name + "'");
  for (const auto& [name, value] : section(context.root, "couplings")) {
    CoordinateCoupling coupling = coupling_of(context, name, value);
    const std::string output = coupling.output.joint + "." + coupling.output.coordinate;
    const auto [first, is_new] = prescribed_by.try_emplace(output, "coupling '" + name + "'");
    if (!is_new && !coupling.output.joint.empty()) {
      context.fault_at_key(value, "a coupling of " + output + ", which " + first->second + " holds already",
                           "an output that nothing else holds", "couple the driven coordinate as the input instead");
    }
    context.model.couplings.push_back(std::move(coupling));
  }
}

}  // namespace hersey::model
