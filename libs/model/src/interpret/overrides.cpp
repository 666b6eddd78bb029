#include "interpret/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "hersey/core/quantity_formula.h"
#include "hersey/core/spelling.h"

namespace hersey::model {
namespace {

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts{""};
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<std::string> keys_of(const Node& node) {
  std::vector<std::string> keys;
  for (const Entry& entry : node.entries) keys.push_back(entry.key);
  return keys;
}

/// The value of `key` in `node`, made if need be; null where a list has no such item.
Node* step_into(Node& node, const std::string& key, const SourcePosition& position) {
  if (node.kind == Node::Kind::sequence) {
    std::size_t index = node.items.size();
    std::from_chars(key.data(), key.data() + key.size(), index);
    return index < node.items.size() ? &node.items[index] : nullptr;
  }
  if (node.kind != Node::Kind::mapping) {
    node = Node{.kind = Node::Kind::mapping, .position = position};
  }
  if (Node* found = node.find(key)) return found;
  node.entries.push_back({key, position, Node{.position = position}});
  return &node.entries.back().value;
}

void apply_along_path(Node& root, const Override& change, std::vector<Fault>& faults) {
  Node* node = &root;
  for (const std::string& key : split_path(change.name)) {
    node = step_into(*node, key, change.position);
    if (node == nullptr) {
      faults.push_back({change.position, change.name, "no item '" + key + "'", "the number of an item, from 0", ""});
      return;
    }
  }
  *node = change.value;
}

constexpr std::size_t kLongest = 65536;       // characters of a value: ten parameters of each other are a gigabyte
constexpr std::size_t kMostInAll = 16000000;  // of all values with parameters: a thousand of the longest

/// A scalar's text while parameters are put into it.
class Pieces {
 public:
  explicit Pieces(const std::string& given)
      : is_alone_(given.starts_with("${") && given.find('}') + 1 == given.size()) {}

  void add(const std::string& own) {
    if (own.empty()) return;
    const bool follows = parameters_ > 0 && was_parameter_;
    is_pasted_ = is_pasted_ && own.find_first_of("+-*/^()") == std::string::npos && !(follows && is_digit(own.front()));
    text_ += own;
    formula_ += own;
    was_parameter_ = false;
  }

  void add(const Node& parameter) {
    // A digit beside a parameter would become one of its digits.
    is_pasted_ = is_pasted_ && (text_.empty() || !is_digit(text_.back()) || !begins_number(parameter.text));
    alone_ = parameter.formula;
    alone_is_pasted_ = parameter.is_pasted;
    text_ += parameter.text;
    formula_ += "(" + (parameter.formula.empty() ? parameter.text : parameter.formula) + ")";
    was_parameter_ = true;
    ++parameters_;
  }

  [[nodiscard]] std::size_t length() const { return formula_.size(); }

  void put_into(Node& node) const {
    node.text = text_;
    if (parameters_ == 0) return;
    node.formula = is_alone_ ? alone_ : formula_;
    node.is_pasted = is_alone_ ? alone_is_pasted_ : is_pasted_;
  }

 private:
  static bool is_digit(char c) { return ('0' <= c && c <= '9') || c == '.'; }
  static bool begins_number(const std::string& text) {
    return !text.empty() && (is_digit(text.front()) || text.front() == '+' || text.front() == '-');
  }

  std::string text_, formula_, alone_;
  bool is_alone_ = false, is_pasted_ = true, alone_is_pasted_ = false, was_parameter_ = false;
  int parameters_ = 0;
};

/// One pass over a document that replaces ${name}.
class Substitution {
 public:
  explicit Substitution(std::vector<Fault>& faults) : faults_(faults) {}

  void define(const std::string& name, Node& value) {
    if (!value.formula.empty()) work_out(value);
    parameters_[name] = value;
  }

  void visit(Node& node, const std::string& path) {
    if (node.kind == Node::Kind::scalar) substitute(node, path);
    for (std::size_t i = 0; i < node.items.size(); ++i) visit(node.items[i], path + "." + std::to_string(i));
    for (Entry& entry : node.entries) visit(entry.value, path.empty() ? entry.key : path + "." + entry.key);
  }

 private:
  // A parameter derived from others stands for its value.
  static void work_out(Node& value) {
    try {
      const Quantity result = evaluate_formula(value.formula);
      value.formula = fmt::format("{}{}{}", result.number, result.unit.empty() ? "" : " ", result.unit);
    } catch (const QuantityError&) {
      // A word, an expression of time, a vector; or a fault, which is told where it is used.
    }
  }

  // As text every parameter is pasted in place; as formula it stands in parentheses, so that signs and operators around
  // it mean what they mean in arithmetic. Which of both counts depends on what the key expects.
  void substitute(Node& node, const std::string& path) {
    const std::string given = node.text;
    if (given.find("${") == std::string::npos) return;
    Pieces pieces(given);
    for (std::size_t at = 0; at < given.size();) {
      const auto start = given.find("${", at);
      pieces.add(given.substr(at, start - at));
      if (start == std::string::npos) break;
      const auto end = given.find('}', start);
      if (end == std::string::npos) {
        faults_.push_back({node.position, path, "'" + given + "'", "a closing } after ${", ""});
        node.reported = true;
        return;
      }
      const std::string name = given.substr(start + 2, end - start - 2);
      const auto parameter = parameters_.find(name);
      if (parameter == parameters_.end()) {
        report_unknown(node, path, name);
        return;
      }
      note_origin(node, name, parameter->second.position);
      pieces.add(parameter->second);
      if (pieces.length() > kLongest) {
        faults_.push_back({node.position, path, "a value that parameters make longer than 65536 characters",
                           "parameters that do not multiply each other", ""});
        node.reported = true;
        return;
      }
      at = end + 1;
    }
    if (const bool was_within = in_all_ <= kMostInAll; (in_all_ += pieces.length()) > kMostInAll) {
      if (was_within)
        faults_.push_back({node.position, path, "values that parameters make longer than 16 MB in all",
                           "parameters of fewer characters", ""});
      node.reported = true;
      return;
    }
    pieces.put_into(node);
  }

  static void note_origin(Node& node, const std::string& name, const SourcePosition& position) {
    node.text_offset = -1;
    if (!node.origin.empty()) node.origin += ", ";
    node.origin += "parameter " + name;
    node.origin += position.line > 0 ? " in line " + std::to_string(position.line) : " set by " + position.file;
  }

  void report_unknown(Node& node, const std::string& path, const std::string& name) {
    node.reported = true;
    std::vector<std::string> names;
    for (const auto& [known, value] : parameters_) names.push_back(known);
    const std::string expected =
        names.empty() ? "a parameter, but the model has none" : "one of the parameters " + one_of(names);
    faults_.push_back({node.position, path, "unknown parameter '" + name + "'", expected, did_you_mean(name, names)});
  }

  std::vector<Fault>& faults_;
  std::map<std::string, Node> parameters_;
  std::size_t in_all_ = 0;  // characters of values that have been put together
};

std::optional<Override> parse_override(const std::string& text, const SourcePosition& place,
                                       std::vector<Fault>& faults) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    faults.push_back({place, "", "'" + text + "'", "name=value, such as load=500N", ""});
    return std::nullopt;
  }
  Override change{text.substr(0, equals), {}, place};
  std::vector<Fault> in_value;
  change.value = parse_yaml(text.substr(equals + 1), place.file, in_value).value_or(Node{});
  change.value.reported = !in_value.empty();
  for (Fault& fault : in_value) faults.push_back({place, change.name, fault.found, fault.expected, fault.suggestion});
  move_to(change.value, place);
  return change;
}

const Node* variants_of(const Node& root) {
  const Node* study = root.find("study");
  return study == nullptr ? nullptr : study->find("variants");
}

// The overrides of the variant that `choice` names; those that are no overrides are told with the study.
std::vector<Override> overrides_of_variant(const Node& variants, const Override& choice, std::vector<Fault>& faults) {
  std::vector<Override> overrides;
  const Node* chosen = variants.find(choice.value.text);
  if (chosen == nullptr) {
    const std::vector<std::string> names = keys_of(variants);
    faults.push_back({choice.position, kVariant, "unknown variant '" + choice.value.text + "'", one_of(names),
                      did_you_mean(choice.value.text, names)});
    return overrides;
  }
  for (const Node& item : chosen->items) {
    std::optional<Override> change = parse_override(item.text, item.position, faults);
    if (change) overrides.push_back(std::move(*change));
  }
  return overrides;
}

}  // namespace

std::vector<Override> parse_overrides(const std::vector<std::string>& texts, std::vector<Fault>& faults) {
  std::vector<Override> overrides;
  for (const std::string& text : texts) {
    std::optional<Override> change = parse_override(text, {"--set", 0, 0}, faults);
    if (change) overrides.push_back(std::move(*change));
  }
  return overrides;
}

bool is_parameter(const Node& root, const std::string& name) {
  const Node* parameters = root.find("parameters");
  return parameters != nullptr && parameters->find(name) != nullptr;
}

void apply_overrides(Node& root, const std::vector<Override>& overrides, const std::vector<std::string>& top_keys,
                     std::vector<Fault>& faults) {
  for (const Override& change : overrides) {
    if (is_parameter(root, change.name)) {
      *root.find("parameters")->find(change.name) = change.value;
      continue;
    }
    const Node* variants = change.name == kVariant ? variants_of(root) : nullptr;
    if (variants != nullptr) {
      apply_overrides(root, overrides_of_variant(*variants, change, faults), top_keys, faults);
      continue;
    }
    const std::string first = split_path(change.name).front();
    if (std::find(top_keys.begin(), top_keys.end(), first) != top_keys.end()) {
      apply_along_path(root, change, faults);
      continue;
    }
    std::vector<std::string> names = root.find("parameters") != nullptr ? keys_of(*root.find("parameters")) : top_keys;
    const std::string parameters = root.find("parameters") != nullptr ? "a parameter (" + one_of(names) + ") or " : "";
    names.insert(names.end(), top_keys.begin(), top_keys.end());
    faults.push_back({change.position, "", "unknown name '" + change.name + "'",
                      parameters + "a key path such as simulation.duration", did_you_mean(first, names)});
  }
}

void substitute_parameters(Node& root, std::vector<Fault>& faults) {
  Substitution substitution(faults);
  if (Node* parameters = root.find("parameters")) {
    for (Entry& entry : parameters->entries) {
      substitution.visit(entry.value, "parameters." + entry.key);
      substitution.define(entry.key, entry.value);
    }
  }
  for (Entry& entry : root.entries) {
    if (entry.key != "parameters" && entry.key != "study") substitution.visit(entry.value, entry.key);
  }
}

}  // namespace hersey::model
