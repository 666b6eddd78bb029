#include "time_stepping/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"

namespace hersey::run {
namespace {

/// "forces.load.force.0" is the component x.
std::string name_of(const std::string& path) {
  const std::array<const char*, 3> axes{"x", "y", "z"};
  const std::size_t dot = path.rfind('.');
  const std::string last = path.substr(dot + 1);
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (last == std::to_string(i)) return path.substr(0, dot + 1) + axes[i];
  return path;
}

/// True if something is a function of the crank angle at its constant speed, independent of the machine's state.
bool counts_on_crank(const model::Model& model) {
  if (model.simulation.cycle) return true;
  const auto counts = [](const model::Function& function) {
    return std::any_of(function.variables.begin(), function.variables.end(),
                       [](const model::Variable& variable) { return variable.kind != model::Variable::Kind::time; });
  };
  for (const model::Force& force : model.forces) {
    if (const auto* load = force.as<model::SurfaceLoad>();
        load != nullptr && std::any_of(load->functions.begin(), load->functions.end(), counts))
      return true;
    if (const auto* ring = force.as<model::PistonRing>(); ring != nullptr && ring->gas && counts(*ring->gas))
      return true;
  }
  for (const model::Bearing& bearing : model.bearings)
    if (std::any_of(bearing.feature_pressures.begin(), bearing.feature_pressures.end(), counts)) return true;
  return false;
}

/// False of a pump of constant flow without a limit.
bool has_supply_pressure(const film::SurfaceFeature& feature) {
  return !feature.restrictor || feature.restrictor->has_supply_pressure();
}

}  // namespace

Inputs::Inputs(model::Model& model) : plan_(model.simulation) {
  for (model::Drive& drive : model.drives) {
    if (drive.prescribes == model::Drive::Prescribes::position) continue;  // a jump of it is no motion
    if (drive.motion.signal) continue;
    const bool is_speed = drive.prescribes == model::Drive::Prescribes::speed;
    std::string unit = model::speed_unit(drive.coordinate);
    if (!is_speed) unit += "^2";
    add(drive.motion, unit, fmt::format("{} of drive {}", is_speed ? "speed" : "acceleration", drive.name),
        is_speed ? Jump::of_speed : Jump::of_force);
    const bool is_crank = plan_.crank && plan_.crank->joint == drive.joint;
    if (is_crank && counts_on_crank(model))
      inputs_.back().refusal =
          "cycles, or pressures over the crank angle, count on the crank's constant speed: give them over time, or "
          "leave the speed as it is";
  }
  for (model::Force& force : model.forces)
    for (const auto& followed : functions_of(force))
      if (!followed.function->signal) add(*followed.function, followed.unit, followed.text, Jump::of_force);
  for (model::Bearing& bearing : model.bearings)
    for (std::size_t f = 0; f < bearing.feature_pressures.size(); ++f)
      if (bearing.film.features[f].is_fed && has_supply_pressure(bearing.film.features[f]) &&
          !model::node_of_feature(bearing, f))
        add(bearing.feature_pressures[f], "Pa",
            fmt::format("pressure of {} in bearing {}", bearing.film.features[f].name, bearing.name), Jump::none);
  for (const Input& input : inputs_) infos_.push_back(input.info);
}

void Inputs::add(model::Function& function, const std::string& unit, const std::string& text, Jump jump) {
  Input input;
  input.function = std::make_shared<SettableFunction>(function.value);
  input.variables = function.variables;
  input.jump = jump;
  input.info = {.name = name_of(function.path), .unit = unit, .text = text};
  input.info.start = value_of(input, plan_, plan_.start);
  function.value = input.function;
  inputs_.push_back(std::move(input));
}

double Inputs::value_of(const Input& input, const model::Simulation& plan, double t) {
  std::vector<double> x;
  for (const model::Variable& variable : input.variables) {
    const bool is_crank = plan.crank && plan.crank->joint == variable.joint;
    if (variable.kind == model::Variable::Kind::time)
      x.push_back(t);
    else if (is_crank && variable.kind == model::Variable::Kind::coordinate)
      x.push_back(plan.crank->initial_angle + plan.crank->speed * (t - plan.start));
    else if (is_crank && variable.kind == model::Variable::Kind::rate)
      x.push_back(plan.crank->speed);
    else if (!input.function->is_set())
      return std::numeric_limits<double>::quiet_NaN();
  }
  return input.function->value(x);
}

Inputs::Input& Inputs::find(const std::string& name) {
  const auto found =
      std::find_if(inputs_.begin(), inputs_.end(), [&](const Input& input) { return input.info.name == name; });
  if (found != inputs_.end()) return *found;
  std::vector<std::string> names;
  for (const Input& input : inputs_) names.push_back(input.info.name);
  throw InputError(Fault{{},
                         "",
                         "no input '" + name + "'",
                         names.empty() ? "a model with inputs, which this one has not" : one_of(names),
                         did_you_mean(name, names)});
}

void Inputs::persist(Archive& archive) {
  for (Input& input : inputs_) {
    const Archive::Group group(archive, input.info.name);
    bool is_set = input.function->is_set();
    double value = is_set ? input.function->value({}) : 0;
    archive.io("is_set", is_set), archive.io("value", value);
    if (!archive.restores()) continue;
    if (is_set)
      input.function->set(value);
    else
      input.function->release();
  }
}

}  // namespace hersey::run
