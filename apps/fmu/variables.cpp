#include "variables.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "hersey/core/quantity_formula.h"
#include "hersey/core/units.h"

namespace hersey::fmu {
namespace {

using Json = nlohmann::json;

bool is_identifier(const std::string& word) {
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) return false;
  return std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// A part of a structured name: an identifier, or in quotes what is none.
std::string name_part(const std::string& word) {
  if (is_identifier(word)) return word;
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

std::string structured(const std::string& dotted) {
  std::string name;
  for (std::size_t from = 0; from <= dotted.size();) {
    const std::size_t dot = std::min(dotted.find('.', from), dotted.size());
    if (!name.empty()) name += '.';
    name += name_part(dotted.substr(from, dot - from));
    from = dot + 1;
  }
  return name;
}

/// The number of a text in SI, and its unit; none where it is no number.
std::optional<std::pair<double, std::string>> number_of(const std::string& text) {
  Quantity quantity;
  try {
    quantity = evaluate_formula(text);
    if (quantity.unit.empty()) return std::pair{quantity.number, std::string("1")};
  } catch (const QuantityError&) {
    return std::nullopt;  // a word, a function, several numbers
  }
  for (const Dimension& dimension : dimensions()) {
    try {
      return std::pair{convert_to_si(quantity, dimension.si_unit), dimension.si_unit};
    } catch (const QuantityError&) {
      continue;  // another dimension
    }
  }
  return std::nullopt;
}

class ParameterCollector {
 public:
  explicit ParameterCollector(const std::vector<run::InputInfo>& inputs) {
    for (const run::InputInfo& input : inputs) taken_.insert(input.name);
  }

  void visit(const YAML::Node& node, const std::string& path) {
    if (path == "hersey" || path == "simulation" || path == "output" || path == "study" || path == "title" ||
        path == "description" || taken_.contains(path))
      return;
    if (node.IsMap())
      for (const auto& entry : node) {
        const auto key = entry.first.as<std::string>();
        // What a path cannot reach.
        if (key.find('.') == std::string::npos) visit(entry.second, path.empty() ? key : path + "." + key);
      }
    if (!node.IsScalar() || node.Scalar().find("${") != std::string::npos) return;
    if (const auto number = number_of(node.Scalar())) add(path, *number);
  }

  std::vector<Variable> take() { return std::move(found_); }

 private:
  void add(const std::string& path, const std::pair<double, std::string>& number) {
    const bool is_named = path.starts_with("parameters.");
    found_.push_back({.kind = Variable::Kind::parameter,
                      .name = structured(path),
                      .unit = number.second,
                      .text = is_named ? "parameter of the model" : "key of the model file",
                      .source = is_named ? path.substr(11) : path,
                      .start = number.first});
  }

  std::set<std::string> taken_;
  std::vector<Variable> found_;
};

std::string kind_text(Variable::Kind kind) {
  if (kind == Variable::Kind::parameter) return "parameter";
  return kind == Variable::Kind::input ? "input" : "output";
}

Variable::Kind kind_of(const std::string& text) {
  if (text == "parameter") return Variable::Kind::parameter;
  return text == "input" ? Variable::Kind::input : Variable::Kind::output;
}

void add_output(const run::OutputInfo& output, std::vector<Variable>& list) {
  Variable variable{.kind = Variable::Kind::output,
                    .name = structured(output.name),
                    .unit = output.unit,
                    .text = output.text,
                    .source = output.name};
  if (output.shape.empty()) {
    list.push_back(std::move(variable));
    return;
  }
  const std::string name = variable.name;
  for (std::size_t i = 0; i < output.components.size(); ++i) {
    const std::string& component = output.components[i];
    const bool is_number = !component.empty() && std::isdigit(static_cast<unsigned char>(component[0])) != 0;
    variable.column = i;
    variable.name = is_number ? fmt::format("{}[{}]", name, i + 1) : name + "." + name_part(component);
    list.push_back(variable);
  }
}

bool is_numbered(const run::OutputInfo& output) {
  return !output.components.empty() && std::ranges::all_of(output.components, [](const std::string& component) {
    return !component.empty() && std::isdigit(static_cast<unsigned char>(component[0])) != 0;
  });
}

Variable array_of(const run::OutputInfo& output) {
  return {.kind = Variable::Kind::output,
          .name = structured(output.name),
          .unit = output.unit,
          .text = output.text,
          .source = output.name,
          .size = output.components.size()};
}

}  // namespace

std::vector<Variable> parameters_of(const std::string& text, const std::vector<run::InputInfo>& inputs) {
  ParameterCollector collector(inputs);
  collector.visit(YAML::Load(text), "");
  return collector.take();
}

std::vector<Variable> variables_of(const std::string& text, run::Simulation& simulation, int version) {
  std::vector<Variable> all = parameters_of(text, simulation.inputs());
  for (const run::InputInfo& input : simulation.inputs())
    all.push_back({.kind = Variable::Kind::input,
                   .name = structured(input.name),
                   .unit = input.unit,
                   .text = input.text,
                   .source = input.name,
                   .start = input.start});
  for (const run::OutputInfo& output : simulation.outputs())
    if (output.name != "time") add_output(output, all);
  if (version == 3)
    for (const run::OutputInfo& output : simulation.outputs())
      if (is_numbered(output)) all.push_back(array_of(output));
  // What is read keeps its name; what is given beside it says so.
  std::set<std::string> outputs;
  for (const Variable& variable : all)
    if (variable.kind == Variable::Kind::output) outputs.insert(variable.name);
  for (Variable& variable : all)
    if (variable.kind != Variable::Kind::output && outputs.contains(variable.name)) variable.name += ".given";
  return all;
}

std::string to_json(const Variables& variables) {
  Json list = Json::array();
  for (const Variable& variable : variables.list) {
    Json entry{{"kind", kind_text(variable.kind)},
               {"name", variable.name},
               {"unit", variable.unit},
               {"source", variable.source},
               {"column", variable.column}};
    if (std::isfinite(variable.start)) entry["start"] = variable.start;
    if (variable.size > 0) entry["size"] = variable.size;
    list.push_back(std::move(entry));
  }
  return Json{{"token", variables.token}, {"overrides", variables.overrides}, {"variables", std::move(list)}}.dump(1);
}

Variables from_json(const std::string& text) {
  const Json json = Json::parse(text);
  Variables variables;
  variables.token = json.at("token").get<std::string>();
  variables.overrides = json.at("overrides").get<std::vector<std::string>>();
  for (const Json& entry : json.at("variables"))
    variables.list.push_back({.kind = kind_of(entry.at("kind").get<std::string>()),
                              .name = entry.at("name").get<std::string>(),
                              .unit = entry.at("unit").get<std::string>(),
                              .text = "",
                              .source = entry.at("source").get<std::string>(),
                              .column = entry.at("column").get<std::size_t>(),
                              .size = entry.value("size", std::size_t{0}),
                              .start = entry.value("start", 0.0)});
  return variables;
}

}  // namespace hersey::fmu
