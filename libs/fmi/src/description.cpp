#include "hersey/fmi/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "xml_elements.h"

namespace hersey::fmi {
namespace {

constexpr std::array<const char*, 8> kBases{"kg", "m", "s", "A", "K", "mol", "cd", "rad"};

double number_in(const Element& element, const std::string& key, double otherwise) {
  const std::string text = element.attribute(key);
  if (text.empty()) return otherwise;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number))
    throw FmuError(
        fmt::format("modelDescription.xml has '{}' as {} of {}, which is no number", text, key, element.name));
  return number;
}

template <class Integer>
Integer integer_in(const Element& element, const std::string& key) {
  const std::string text = element.attribute(key);
  Integer number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw FmuError(
        fmt::format("modelDescription.xml has '{}' as {} of {}, which is no whole number", text, key, element.name));
  return number;
}

bool is_true(const std::string& text) { return text == "true" || text == "1"; }
bool is_true(const Element& element, const std::string& key) { return is_true(element.attribute(key)); }

std::map<std::string, Unit> units_of(const Element& root) {
  std::map<std::string, Unit> units;
  const Element* definitions = root.child("UnitDefinitions");
  if (definitions == nullptr) return units;
  for (const Element& element : definitions->children) {
    Unit unit{.name = element.attribute("name")};
    if (const Element* base = element.child("BaseUnit")) {
      unit.is_defined = true;
      for (std::size_t i = 0; i < kBases.size(); ++i)
        if (!base->attribute(kBases[i]).empty()) unit.powers[i] = integer_in<int>(*base, kBases[i]);
      unit.factor = number_in(*base, "factor", 1);
      unit.offset = number_in(*base, "offset", 0);
    }
    units[unit.name] = unit;
  }
  return units;
}

/// What a variable has of its declared type where it does not say it itself.
struct DeclaredType {
  std::string unit, relative;  ///< as written
};

std::map<std::string, DeclaredType> declared_types(const Element& root) {
  std::map<std::string, DeclaredType> types;
  const Element* definitions = root.child("TypeDefinitions");
  if (definitions == nullptr) return types;
  for (const Element& type : definitions->children) {
    const Element* inner = type.child("Real");  // FMI 2
    const Element& real = inner != nullptr ? *inner : type;
    types[type.attribute("name")] = {real.attribute("unit"), real.attribute("relativeQuantity")};
  }
  return types;
}

VariableType type_called(const std::string& name) {
  if (name == "Real" || name == "Float64") return VariableType::real;
  if (name == "Integer" || name == "Enumeration" || name == "Int32" || name == "Int64") return VariableType::integer;
  if (name == "Boolean") return VariableType::boolean;
  return name == "String" ? VariableType::text : VariableType::other;
}

Causality causality_called(const std::string& name) {
  if (name == "parameter" || name == "structuralParameter") return Causality::parameter;
  if (name == "input") return Causality::input;
  return name == "output" ? Causality::output : Causality::other;
}

class VariableReader {
 public:
  VariableReader(const Element& root, int version)
      : units_(units_of(root)), types_(declared_types(root)), version_(version) {}

  [[nodiscard]] Variable read(const Element& element) const {
    // FMI 2 has the type as an element inside, FMI 3 as the element itself.
    if (version_ == 2 && element.children.empty())
      throw FmuError(fmt::format("modelDescription.xml has a variable '{}' without a type", element.attribute("name")));
    const Element* typed = &element;
    if (version_ == 2) {
      const auto is_type = [](const Element& child) { return type_called(child.name) != VariableType::other; };
      const auto found = std::find_if(element.children.begin(), element.children.end(), is_type);
      typed = found != element.children.end() ? &*found : &element.children.front();
    }
    Variable variable{.name = element.attribute("name"),
                      .reference = integer_in<unsigned>(element, "valueReference"),
                      .type = type_called(typed->name),
                      .type_name = typed->name,
                      .causality = causality_called(element.attribute("causality")),
                      .causality_name = element.attribute("causality"),
                      .is_array = element.child("Dimension") != nullptr,
                      .is_constant = element.attribute("variability") == "constant",
                      .start = typed->attribute("start")};
    if (variable.causality_name.empty()) variable.causality_name = "local";
    std::string unit = typed->attribute("unit"), relative = typed->attribute("relativeQuantity");
    if (const auto declared = types_.find(typed->attribute("declaredType")); declared != types_.end()) {
      if (unit.empty()) unit = declared->second.unit;
      if (relative.empty()) relative = declared->second.relative;
    }
    variable.is_relative = is_true(relative);
    if (unit.empty()) return variable;
    const auto known = units_.find(unit);
    variable.unit = known != units_.end() ? known->second : Unit{.name = unit};
    if (variable.is_relative) variable.unit->offset = 0;
    return variable;
  }

 private:
  std::map<std::string, Unit> units_;
  std::map<std::string, DeclaredType> types_;
  int version_;
};

int version_of(const std::string& text) {
  if (text.starts_with("2.")) return 2;
  if (text.starts_with("3.")) return 3;
  throw FmuError(fmt::format("it is of FMI '{}': versions 2.0 and 3.0 are read", text));
}

/// What identifies the FMU when it is instantiated.
const char* token_key(int version) { return version == 2 ? "guid" : "instantiationToken"; }

}  // namespace

std::string Unit::base_units() const {
  std::string text;
  for (std::size_t i = 0; i < kBases.size(); ++i) {
    if (powers[i] == 0) continue;
    if (!text.empty()) text += '.';
    text += kBases[i];
    if (powers[i] != 1) text += std::to_string(powers[i]);
  }
  return text.empty() ? "1" : text;
}

const Variable* Description::find(const std::string& name) const {
  const auto found =
      std::find_if(variables.begin(), variables.end(), [&](const Variable& variable) { return variable.name == name; });
  return found == variables.end() ? nullptr : &*found;
}

std::vector<std::string> Description::names(Causality causality) const {
  std::vector<std::string> found;
  for (const Variable& variable : variables)
    if (variable.causality == causality && !variable.is_array) found.push_back(variable.name);
  return found;
}

Description read_description(const std::string& xml) {
  const Element root = read_xml(xml);
  if (root.name != "fmiModelDescription")
    throw FmuError(fmt::format("modelDescription.xml begins with <{}>, not with <fmiModelDescription>", root.name));
  Description found;
  found.version = version_of(root.attribute("fmiVersion"));
  const Element* means = root.child("CoSimulation");
  if (means == nullptr)
    throw FmuError("it is made for model exchange: an FMU for co-simulation brings its own solver and is needed here");
  found.model_name = root.attribute("modelName");
  found.token = root.attribute(token_key(found.version));
  found.model_identifier = means->attribute("modelIdentifier");
  // Names of files: what is no C identifier is none of the standard's, and might lead elsewhere.
  const auto is_sign = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const bool is_named = !found.model_identifier.empty() &&
                        std::all_of(found.model_identifier.begin(), found.model_identifier.end(), is_sign);
  if (!is_named)
    throw FmuError(fmt::format("modelDescription.xml has '{}' as modelIdentifier, which is no name of a library",
                               found.model_identifier));
  const std::string state = found.version == 2 ? "FMUstate" : "FMUState";
  found.saves_state = is_true(*means, "canGetAndSet" + state) && is_true(*means, "canSerialize" + state);
  if (found.version == 3) found.fixed_internal_step = number_in(*means, "fixedInternalStepSize", 0);
  const VariableReader reader(root, found.version);
  if (const Element* variables = root.child("ModelVariables"))
    for (const Element& element : variables->children) found.variables.push_back(reader.read(element));
  return found;
}

}  // namespace hersey::fmi
