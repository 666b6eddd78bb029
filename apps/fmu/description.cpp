#include "description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "hersey/core/version.h"

namespace hersey::fmu {
namespace {

using Exponents = std::array<int, 8>;

constexpr std::array<const char*, 8> kBases{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};

const std::map<std::string, Exponents>& known_units() {
  static const std::map<std::string, Exponents> units{
      {"1", {}},
      {"kg", {1}},
      {"m", {0, 1}},
      {"s", {0, 0, 1}},
      {"K", {0, 0, 0, 0, 1}},
      {"rad", {0, 0, 0, 0, 0, 0, 0, 1}},
      {"Hz", {0, 0, -1}},
      {"N", {1, 1, -2}},
      {"Pa", {1, -1, -2}},
      {"J", {1, 2, -2}},
      {"W", {1, 2, -3}},
  };
  return units;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&')
      xml += "&amp;";
    else if (c == '<')
      xml += "&lt;";
    else if (c == '>')
      xml += "&gt;";
    else if (c == '"')
      xml += "&quot;";
    else if (c == '\n' || c == '\t')
      xml += ' ';
    else if (code >= 0x20)
      xml += c;
  }
  return xml;
}

namespace {

// Pure numbers have no unit, nor have columns that measure several things.
bool is_named(const std::string& unit) { return !unit.empty() && unit != "1" && unit != "SI"; }

std::string unit_definitions(const Variables& variables) {
  std::set<std::string> units{"s"};
  for (const Variable& variable : variables.list) units.insert(variable.unit);
  std::erase_if(units, [](const std::string& unit) { return !is_named(unit); });
  std::string xml = "  <UnitDefinitions>\n";
  for (const std::string& unit : units) {
    const std::optional<fmi::Unit> defined = definition_of(unit);
    xml += defined ? fmt::format("    <Unit name=\"{}\"><BaseUnit{}/></Unit>\n", escaped(unit),
                                 base_unit_attributes(*defined))
                   : fmt::format("    <Unit name=\"{}\"/>\n", escaped(unit));
  }
  return xml + "  </UnitDefinitions>\n";
}

std::string role_of(const Variable& variable) {
  switch (variable.kind) {
    case Variable::Kind::parameter:
      return R"(causality="parameter" variability="fixed" initial="exact")";
    case Variable::Kind::input:
      return R"(causality="input" variability="continuous")";
    case Variable::Kind::output:
      break;
  }
  return R"(causality="output" variability="continuous" initial="calculated")";
}

std::string values_of(const Variable& variable) {
  std::string text;
  if (is_named(variable.unit)) text += fmt::format(" unit=\"{}\"", escaped(variable.unit));
  if (variable.kind != Variable::Kind::output)
    text += fmt::format(" start=\"{}\"", std::isfinite(variable.start) ? variable.start : 0.0);
  return text;
}

std::string variables_2(const Variables& variables) {
  std::string xml =
      "    <ScalarVariable name=\"time\" valueReference=\"0\" description=\"time\" causality=\"independent\" "
      "variability=\"continuous\"><Real unit=\"s\"/></ScalarVariable>\n";
  for (std::size_t i = 0; i < variables.list.size(); ++i) {
    const Variable& one = variables.list[i];
    xml += fmt::format(
        "    <ScalarVariable name=\"{}\" valueReference=\"{}\" description=\"{}\" {}><Real{}/>"
        "</ScalarVariable>\n",
        escaped(one.name), i + 1, escaped(one.text), role_of(one), values_of(one));
  }
  return xml;
}

std::string variables_3(const Variables& variables) {
  std::string xml =
      "    <Float64 name=\"time\" valueReference=\"0\" description=\"time\" causality=\"independent\" "
      "variability=\"continuous\" unit=\"s\"/>\n";
  for (std::size_t i = 0; i < variables.list.size(); ++i) {
    const Variable& one = variables.list[i];
    const bool is_output = one.kind == Variable::Kind::output;
    xml += fmt::format("    <Float64 name=\"{}\" valueReference=\"{}\" description=\"{}\" {}{}{}", escaped(one.name),
                       i + 1, escaped(one.text), role_of(one), is_output ? " intermediateUpdate=\"true\"" : "",
                       values_of(one));
    xml += one.size > 0 ? fmt::format("><Dimension start=\"{}\"/></Float64>\n", one.size) : "/>\n";
  }
  return xml;
}

/// One line for each output. FMI 2 counts variables from 1, time is the first. At a communication point outputs are
/// those of the last step: they depend on no input there, which acts from the next step on. What they begin with may
/// depend on every parameter, which is what leaving the list out says.
std::string unknowns(const Variables& variables, const char* line) {
  std::string xml;
  for (std::size_t i = 0; i < variables.list.size(); ++i)
    if (variables.list[i].kind == Variable::Kind::output) xml += fmt::format(fmt::runtime(line), i + 1, i + 2);
  return xml;
}

constexpr const char* kLogCategories =
    "  <LogCategories>\n"
    "    <Category name=\"logStatusError\" description=\"Why a call failed\"/>\n"
    "    <Category name=\"logStatusDiscard\" description=\"Why a step ended early\"/>\n"
    "    <Category name=\"logAll\" description=\"Every communication step\"/>\n"
    "  </LogCategories>\n";

}  // namespace

std::optional<fmi::Unit> definition_of(const std::string& unit) {
  fmi::Unit defined{.name = unit, .is_defined = true};
  if (unit == "degC") {
    defined.powers = known_units().at("K");
    defined.offset = 273.15;
    return defined;
  }
  int sign = 1;
  for (std::size_t at = 0; at <= unit.size();) {
    const std::size_t end = std::min(unit.find_first_of("./", at), unit.size());
    std::string factor = unit.substr(at, end - at);
    int power = 1;
    if (const std::size_t hat = factor.find('^'); hat != std::string::npos) {
      const std::string digits = factor.substr(hat + 1);
      const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), power);
      if (read.ec != std::errc() || read.ptr != digits.data() + digits.size()) return std::nullopt;
      factor.resize(hat);
    }
    const auto known = known_units().find(factor);
    if (known == known_units().end()) return std::nullopt;
    for (std::size_t i = 0; i < kBases.size(); ++i) defined.powers[i] += sign * power * known->second[i];
    if (end == unit.size()) return defined;
    sign = unit[end] == '/' ? -1 : 1;
    at = end + 1;
  }
  return std::nullopt;
}

std::string base_unit_attributes(const fmi::Unit& unit) {
  std::string text;
  for (std::size_t i = 0; i < kBases.size(); ++i)
    if (unit.powers[i] != 0) text += fmt::format(" {}=\"{}\"", kBases[i], unit.powers[i]);
  if (unit.factor != 1) text += fmt::format(" factor=\"{}\"", unit.factor);
  if (unit.offset != 0) text += fmt::format(" offset=\"{}\"", unit.offset);
  return text;
}

std::string description_xml(const model::Model& model, const Variables& variables, int version) {
  const model::Simulation& plan = model.simulation;
  const std::string title = escaped(model.title.empty() ? "hersey model" : model.title);
  const std::string experiment =
      fmt::format("  <DefaultExperiment startTime=\"{}\" stopTime=\"{}\" stepSize=\"{}\"/>\n", plan.start,
                  plan.start + plan.duration, plan.step);
  const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const std::string about = fmt::format(
      "modelName=\"{}\" description=\"{}\" generationTool=\"hersey {}\" "
      "variableNamingConvention=\"structured\"",
      title, escaped(model.description), hersey::version());
  if (version == 2)
    return head + fmt::format("<fmiModelDescription fmiVersion=\"2.0\" guid=\"{}\" {}>\n", variables.token, about) +
           fmt::format(
               "  <CoSimulation modelIdentifier=\"{}\" needsExecutionTool=\"false\" "
               "canHandleVariableCommunicationStepSize=\"true\" canInterpolateInputs=\"false\" "
               "maxOutputDerivativeOrder=\"0\" canRunAsynchronuously=\"false\" "
               "canBeInstantiatedOnlyOncePerProcess=\"false\" canNotUseMemoryManagementFunctions=\"true\" "
               "canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" "
               "providesDirectionalDerivative=\"{}\"/>\n",
               kModelIdentifier, run::why_no_derivatives(model).empty()) +
           unit_definitions(variables) + kLogCategories + experiment + "  <ModelVariables>\n" + variables_2(variables) +
           "  </ModelVariables>\n  <ModelStructure>\n    <Outputs>\n" +
           unknowns(variables, "      <Unknown index=\"{1}\" dependencies=\"\"/>\n") +
           "    </Outputs>\n    <InitialUnknowns>\n" + unknowns(variables, "      <Unknown index=\"{1}\"/>\n") +
           "    </InitialUnknowns>\n  </ModelStructure>\n</fmiModelDescription>\n";
  return head +
         fmt::format("<fmiModelDescription fmiVersion=\"3.0\" instantiationToken=\"{}\" {}>\n", variables.token,
                     about) +
         fmt::format(
             "  <CoSimulation modelIdentifier=\"{0}\" needsExecutionTool=\"false\" "
             "canBeInstantiatedOnlyOncePerProcess=\"false\" canGetAndSetFMUState=\"true\" "
             "canSerializeFMUState=\"true\" providesDirectionalDerivatives=\"{1}\" "
             "providesAdjointDerivatives=\"{1}\" canHandleVariableCommunicationStepSize=\"true\" "
             "providesIntermediateUpdate=\"true\" mightReturnEarlyFromDoStep=\"true\" "
             "canReturnEarlyAfterIntermediateUpdate=\"true\" hasEventMode=\"false\"/>\n",
             kModelIdentifier, run::why_no_derivatives(model).empty()) +
         unit_definitions(variables) + kLogCategories + experiment + "  <ModelVariables>\n" + variables_3(variables) +
         "  </ModelVariables>\n  <ModelStructure>\n" +
         unknowns(variables, "    <Output valueReference=\"{0}\" dependencies=\"\"/>\n") +
         unknowns(variables, "    <InitialUnknown valueReference=\"{0}\"/>\n") +
         "  </ModelStructure>\n</fmiModelDescription>\n";
}

std::string documentation_html(const model::Model& model, const Variables& variables, int version) {
  const std::string title = escaped(model.title.empty() ? "hersey model" : model.title);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title></head><body>\n<h1>{0}</h1>\n"
      "<p>{1}</p>\n<p>A machine with oil-film bearings, exported by hersey {2} for co-simulation by FMI {3}.0. Its "
      "model is "
      "<code>resources/model.yaml</code>. All numbers are SI. With steps of {4} s, or multiples, the numbers are those "
      "of "
      "<code>hersey run</code>; any other step is taken, too. Parameters are set before the end of the initialisation, "
      "inputs at any time; an input that is not set is as the model has it.</p>\n"
      "<p><a href=\"licenses/license.txt\">Licence</a>; those of libraries beside it are in the same folder.</p>\n"
      "<table>\n<tr><th>name</th><th>kind</th><th>unit</th><th>start</th><th>meaning</th></tr>\n",
      title, escaped(model.description), hersey::version(), version, model.simulation.step);
  for (const Variable& one : variables.list) {
    const bool is_output = one.kind == Variable::Kind::output;
    const char* kind = is_output ? "output" : one.kind == Variable::Kind::input ? "input" : "parameter";
    html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(one.name), kind,
                        is_named(one.unit) ? escaped(one.unit) : "",
                        is_output || !std::isfinite(one.start) ? "" : fmt::format("{}", one.start), escaped(one.text));
  }
  return html + "</table>\n</body></html>\n";
}

}  // namespace hersey::fmu
