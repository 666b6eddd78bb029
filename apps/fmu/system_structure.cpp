#include "system_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "description.h"
#include "hersey/core/input_error.h"

namespace hersey::fmu {
namespace {

/// Functions of the model that follow outputs of FMUs.
std::vector<const model::Function*> followers(const model::Model& model) {
  std::vector<const model::Function*> found;
  for (const model::Drive& drive : model.drives)
    if (drive.motion.signal) found.push_back(&drive.motion);
  for (const model::Force& force : model.forces)
    for (const auto& followed : functions_of(force))
      if (followed.function->signal) found.push_back(followed.function);
  return found;
}

class SystemWriter {
 public:
  SystemWriter(const model::Model& model, const Variables& machine)
      : model_(model), machine_(machine), machine_name_(machine_name(model)) {}

  std::string text() {
    for (const model::Fmu& fmu : model_.fmus) {
      for (const model::FmuInput& input : fmu.inputs) add_input(fmu, input);
      for (const model::FmuParameter& parameter : fmu.parameters) add_parameter(fmu, parameter);
    }
    for (const model::Function* function : followers(model_)) add_follower(*function);
    std::string components = component(machine_name_);
    for (const model::Fmu& fmu : model_.fmus) components += component(fmu.name);
    const double start = model_.simulation.start;
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<ssd:SystemStructureDescription xmlns:ssd=\"http://ssp-standard.org/SSP1/SystemStructureDescription\" "
        "xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\" "
        "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\" version=\"1.0\" name=\"{0}\">\n"
        "  <ssd:System name=\"{0}\">\n    <ssd:Elements>\n{1}    </ssd:Elements>\n{2}  </ssd:System>\n{3}"
        "  <ssd:DefaultExperiment startTime=\"{4}\" stopTime=\"{5}\"/>\n</ssd:SystemStructureDescription>\n",
        escaped(model_.title.empty() ? machine_name_ : model_.title), components, connections(), units(), start,
        start + model_.simulation.duration);
  }

 private:
  /// A component: its connectors in their order, and start values.
  struct Part {
    std::vector<std::string> names;
    std::string connectors, values;
  };

  void connect(const std::string& element, const std::string& name, const char* kind, const std::string& unit) {
    Part& part = parts_[element];
    if (std::find(part.names.begin(), part.names.end(), name) != part.names.end()) return;
    part.names.push_back(name);
    part.connectors += fmt::format("          <ssd:Connector name=\"{}\" kind=\"{}\"><ssc:Real{}/></ssd:Connector>\n",
                                   escaped(name), kind, unit_attribute(unit));
  }

  /// The attribute, and the unit among those to be defined; only of units whose base units are known.
  std::string unit_attribute(const std::string& unit) {
    if (unit.empty() || !definitions_.contains(unit)) return {};
    used_.insert(unit);
    return fmt::format(" unit=\"{}\"", escaped(unit));
  }

  /// Notes how a unit of the machine is made of base units.
  const std::string& known(const std::string& unit) {
    if (unit == "1") return unit;
    if (const std::optional<fmi::Unit> defined = definition_of(unit)) definitions_[unit] = *defined;
    return unit;
  }
  std::string known(const fmi::Variable& variable) {
    if (!variable.unit || !variable.unit->is_defined) return {};
    definitions_[variable.unit->name] = *variable.unit;
    return variable.unit->name;
  }

  [[noreturn]] void refuse(const SourcePosition& at, const std::string& path, const std::string& found,
                           const std::string& expected) const {
    throw InputError(Fault{at, path, found, expected, ""});
  }

  const Variable& of_machine(Variable::Kind kind, const std::vector<std::string>& names, const SourcePosition& at,
                             const std::string& path) const {
    for (const Variable& variable : machine_.list)
      for (const std::string& name : names)
        if (variable.kind == kind &&
            (variable.name == name || (kind == Variable::Kind::input && variable.source == name)))
          return variable;
    refuse(at, path, "what the machine's FMU has no variable for",
           "a quantity that it has, or an output of an FMU that the model follows");
  }

  /// Connects the output of another FMU, "fmus.other.torque", with an input; false if the quantity is none.
  bool connect_fmus(const model::Fmu& fmu, const model::FmuInput& input) {
    for (const model::Fmu& other : model_.fmus)
      for (const model::FmuOutputVariable& output : other.outputs) {
        if (input.quantity != "fmus." + other.name + "." + output.variable.name) continue;
        connect(other.name, output.variable.name, "output", known(output.variable));
        link(other.name, output.variable.name, fmu.name, input.variable.name, 1);
        return true;
      }
    return false;
  }

  void add_input(const model::Fmu& fmu, const model::FmuInput& input) {
    const std::string name = input.variable.name;
    connect(fmu.name, name, "input", known(input.variable));
    if (!input.function && connect_fmus(fmu, input)) return;
    if (!input.function || input.is_coordinate) {
      std::vector<std::string> names{input.quantity};
      if (input.is_coordinate) {
        const model::Variable& on = input.function->variables.front();
        const std::string row =
            fmt::format("joints.{}.{}", on.joint, on.kind == model::Variable::Kind::rate ? "rates" : "coordinates");
        names = {row + "." + on.coordinate, row};
      }
      const Variable& output = of_machine(Variable::Kind::output, names, input.position, input.path);
      connect(machine_name_, output.name, "output", known(output.unit));
      link(machine_name_, output.name, fmu.name, name, 1);
      return;
    }
    if (!input.function->is_constant())
      refuse(input.position, input.path, "a function of time or an expression",
             "a quantity, a joint coordinate or a constant: connections of SSP have no functions");
    add_value(fmu.name, input.variable, "Real",
              fmt::format("{}", model::from_si(input.variable, input.function->value->value({}))));
  }

  void add_parameter(const model::Fmu& fmu, const model::FmuParameter& parameter) {
    const fmi::VariableType type = parameter.variable.type;
    if (const auto* text = std::get_if<std::string>(&parameter.value))
      return add_value(fmu.name, parameter.variable, "String", *text);
    const double value = std::get<double>(parameter.value);
    if (type == fmi::VariableType::boolean)
      add_value(fmu.name, parameter.variable, "Boolean", value != 0 ? "true" : "false");
    else
      add_value(fmu.name, parameter.variable, type == fmi::VariableType::integer ? "Integer" : "Real",
                fmt::format("{}", value));
  }

  void add_value(const std::string& element, const fmi::Variable& variable, const char* type,
                 const std::string& value) {
    const std::string unit = std::string_view(type) == "Real" ? unit_attribute(known(variable)) : "";
    parts_[element].values +=
        fmt::format("                  <ssv:Parameter name=\"{}\"><ssv:{} value=\"{}\"{}/></ssv:Parameter>\n",
                    escaped(variable.name), type, escaped(value), unit);
  }

  void add_follower(const model::Function& function) {
    const model::FmuSignal& signal = *function.signal;
    const model::Fmu& fmu = model_.fmus[signal.fmu];
    const model::FmuOutputVariable& output = fmu.outputs[signal.output];
    // Inputs are named by components, not by their numbers.
    std::vector<std::string> names{function.path};
    for (const auto& [number, axis] : {std::pair{".0", ".x"}, {".1", ".y"}, {".2", ".z"}})
      if (function.path.ends_with(number)) names.push_back(function.path.substr(0, function.path.size() - 2) + axis);
    const Variable& input = of_machine(Variable::Kind::input, names, function.position, function.path);
    connect(fmu.name, output.variable.name, "output", known(output.variable));
    connect(machine_name_, input.name, "input", known(input.unit));
    link(fmu.name, output.variable.name, machine_name_, input.name, signal.scale);
  }

  void link(const std::string& from, const std::string& output, const std::string& to, const std::string& input,
            double scale) {
    const std::string head = fmt::format(
        "      <ssd:Connection startElement=\"{}\" startConnector=\"{}\" endElement=\"{}\" "
        "endConnector=\"{}\"",
        escaped(from), escaped(output), escaped(to), escaped(input));
    connections_ +=
        head +
        (scale == 1 ? "/>\n" : fmt::format("><ssc:LinearTransformation factor=\"{}\"/></ssd:Connection>\n", scale));
  }

  std::string component(const std::string& name) {
    const Part& part = parts_[name];
    std::string text = fmt::format(
        "      <ssd:Component name=\"{0}\" type=\"application/x-fmu-sharedlibrary\" source=\"resources/{0}.fmu\" "
        "implementation=\"CoSimulation\">\n",
        escaped(name));
    if (!part.connectors.empty())
      text += "        <ssd:Connectors>\n" + part.connectors + "        </ssd:Connectors>\n";
    if (!part.values.empty())
      text += fmt::format(
          "        <ssd:ParameterBindings>\n          <ssd:ParameterBinding>\n            <ssd:ParameterValues>\n"
          "              <ssv:ParameterSet version=\"1.0\" name=\"{}\">\n                <ssv:Parameters>\n{}"
          "                </ssv:Parameters>\n{}              </ssv:ParameterSet>\n            </ssd:ParameterValues>\n"
          "          </ssd:ParameterBinding>\n        </ssd:ParameterBindings>\n",
          escaped(name), part.values, unit_definitions("ssv", "                "));
    return text + "      </ssd:Component>\n";
  }

  [[nodiscard]] std::string connections() const {
    if (connections_.empty()) return {};
    return "    <ssd:Connections>\n" + connections_ + "    </ssd:Connections>\n";
  }

  [[nodiscard]] std::string units() const { return unit_definitions("ssd", "  "); }

  /// A parameter set has its own.
  [[nodiscard]] std::string unit_definitions(const char* prefix, const std::string& indent) const {
    if (used_.empty()) return {};
    std::string text = fmt::format("{}<{}:Units>\n", indent, prefix);
    for (const std::string& name : used_)
      text += fmt::format("{}  <ssc:Unit name=\"{}\"><ssc:BaseUnit{}/></ssc:Unit>\n", indent, escaped(name),
                          base_unit_attributes(definitions_.at(name)));
    return text + fmt::format("{}</{}:Units>\n", indent, prefix);
  }

  const model::Model& model_;
  const Variables& machine_;
  std::string machine_name_;
  std::map<std::string, Part> parts_;
  std::string connections_;
  std::map<std::string, fmi::Unit> definitions_;
  std::set<std::string> used_;
};

}  // namespace

std::vector<std::string> changes_to_machine(const model::Model& model) {
  std::vector<std::string> changes{"fmus={}"};
  for (const model::Function* function : followers(model)) changes.push_back(function->path + "=0");
  return changes;
}

std::vector<std::string> lost_holds(const model::Model& model) {
  std::vector<std::string> lost;
  for (const model::Function* function : followers(model))
    if (function->signal->hold != model::FmuHold::constant)
      lost.push_back(fmt::format("{}.hold: {}", function->path,
                                 function->signal->hold == model::FmuHold::ramp ? "ramp" : "extrapolated"));
  return lost;
}

std::string machine_name(const model::Model& model) {
  std::string name = "machine";
  const auto is_taken = [&] {
    return std::any_of(model.fmus.begin(), model.fmus.end(), [&](const model::Fmu& fmu) { return fmu.name == name; });
  };
  while (is_taken()) name += "_";
  return name;
}

std::string system_structure_xml(const model::Model& model, const Variables& machine) {
  return SystemWriter(model, machine).text();
}

}  // namespace hersey::fmu
