#include "terminals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "description.h"
#include "icon.h"

namespace hersey::fmu {
namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

/// A terminal under construction.
class Terminal {
 public:
  Terminal(const Variables& variables, std::string name, std::string kind, std::string text)
      : variables_(variables), name_(std::move(name)), kind_(std::move(kind)), text_(std::move(text)) {}

  /// A flow into the machine: an input.
  void add_input(const std::string& member, const std::string& source) {
    add(member, source, 0, Variable::Kind::input, "inflow");
    has_input_ = !members_.empty();
  }
  /// A quantity that answers: an output, a component of it by its label or none.
  void add_output(const std::string& member, const std::string& source, std::size_t column, const char* kind) {
    add(member, source, column, Variable::Kind::output, kind);
  }
  void add_vector(const std::string& member, const std::string& source) {
    for (std::size_t i = 0; i < kAxes.size(); ++i)
      add_output(fmt::format("{}.{}", member, kAxes[i]), source, i, "signal");
  }

  /// Nothing if the importer cannot set any of it.
  [[nodiscard]] std::string xml() const {
    if (!has_input_) return {};
    return fmt::format(
        "    <Terminal name=\"{}\" matchingRule=\"bus\" terminalKind=\"{}\" description=\"{}\">\n{}    </Terminal>\n",
        escaped(name_), kind_, escaped(text_), members_);
  }

 private:
  void add(const std::string& member, const std::string& source, std::size_t column, Variable::Kind kind,
           const char* variable_kind) {
    const auto found = std::ranges::find_if(variables_.list, [&](const Variable& one) {
      return one.kind == kind && one.source == source && one.column == column && one.size == 0;
    });
    if (found == variables_.list.end()) return;
    members_ +=
        fmt::format("      <TerminalMemberVariable variableKind=\"{}\" memberName=\"{}\" variableName=\"{}\"/>\n",
                    variable_kind, member, escaped(found->name));
  }

  const Variables& variables_;
  std::string name_, kind_, text_, members_;
  bool has_input_ = false;
};

std::string terminal_of(const model::Force& force, const model::BodyLoad& load, const Variables& variables) {
  Terminal terminal(
      variables, "forces." + force.name, "org.hersey.load",
      fmt::format("{} on {}, with the motion of the body's own frame", load.is_torque ? "torque" : "force",
                  load.at.frame.empty() ? load.at.body : load.at.body + "." + load.at.frame));
  const std::string effort = load.is_torque ? "t" : "f", inputs = "forces." + force.name;
  for (const char* axis : kAxes) terminal.add_input(effort + "." + axis, inputs + ".components." + axis);
  terminal.add_input(effort, inputs + ".magnitude");
  const std::string body = "bodies." + load.at.body;
  terminal.add_vector("r", body + ".position");
  terminal.add_vector("v", body + ".velocity");
  constexpr std::array<const char*, 4> parts{"w", "x", "y", "z"};
  for (std::size_t i = 0; i < parts.size(); ++i)
    terminal.add_output(fmt::format("orientation.{}", parts[i]), body + ".orientation", i, "signal");
  terminal.add_vector("w", body + ".angular_velocity");
  return terminal.xml();
}

std::string terminal_of(const model::Drive& drive, std::size_t coordinate, const Variables& variables) {
  const bool is_angle = model::is_rotation(drive.coordinate);
  Terminal terminal(variables, "drives." + drive.name, "org.hersey.drive",
                    fmt::format("drive of {}, {}", drive.joint, drive.coordinate));
  const std::string inputs = "drives." + drive.name, joint = "joints." + drive.joint;
  terminal.add_input(is_angle ? "w" : "v", inputs + ".speed");
  terminal.add_input("a", inputs + ".acceleration");
  terminal.add_output(is_angle ? "phi" : "s", joint + ".coordinates", coordinate, "signal");
  terminal.add_output(is_angle ? "tau" : "f", inputs + ".force_or_torque", 0, "signal");
  return terminal.xml();
}

}  // namespace

std::string terminals_xml(const model::Model& model, const Variables& variables) {
  std::string terminals;
  for (const model::Force& force : model.forces)
    if (const auto* load = force.as<model::BodyLoad>()) terminals += terminal_of(force, *load, variables);
  for (const model::Drive& drive : model.drives) {
    std::size_t coordinate = 0;
    for (const Variable& one : variables.list)
      if (one.source == "joints." + drive.joint + ".coordinates" && one.name.ends_with("." + drive.coordinate))
        coordinate = one.column;
    terminals += terminal_of(drive, coordinate, variables);
  }
  for (const model::Bearing& bearing : model.bearings)
    for (const Variable& one : variables.list) {
      if (one.kind != Variable::Kind::input || !one.source.starts_with("bearings." + bearing.name + ".")) continue;
      Terminal terminal(variables, one.source.substr(0, one.source.rfind('.')), "org.hersey.supply", one.text);
      terminal.add_input("p", one.source);
      terminal.add_output("q", "bearings." + bearing.name + ".flow_supply", 0, "signal");
      terminals += terminal.xml();
    }
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiTerminalsAndIcons fmiVersion=\"3.0\">\n"
      "  <GraphicalRepresentation>\n"
      "    <CoordinateSystem x1=\"-100\" y1=\"-100\" x2=\"100\" y2=\"100\" suggestedScalingFactorTo_mm=\"0.1\"/>\n"
      "    <Icon x1=\"-100\" y1=\"-100\" x2=\"100\" y2=\"100\"/>\n"
      "  </GraphicalRepresentation>\n";
  if (!terminals.empty()) xml += "  <Terminals>\n" + terminals + "  </Terminals>\n";
  return xml + "</fmiTerminalsAndIcons>\n";
}

std::string icon() { return {kIcon.begin(), kIcon.end()}; }

}  // namespace hersey::fmu
