#include "tree/substitution.h"

#include <fmt/format.h>

#include <set>

#include "hersey/core/quantity_formula.h"
#include "hersey/core/spelling.h"

namespace hersey::model {
namespace {

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

// A parameter derived from others is replaced by its value.
void work_out(Node& value) {
  try {
    const Quantity result = evaluate_formula(value.formula);
    value.formula = fmt::format("{}{}{}", result.number, result.unit.empty() ? "" : " ", result.unit);
  } catch (const QuantityError&) {
    // A word, an expression of time, a vector; or a fault, which is reported where it is used.
  }
}

void note_origin(Node& node, const std::string& name, const SourcePosition& position) {
  node.text_offset = -1;
  if (!node.origin.empty()) node.origin += ", ";
  node.origin += "parameter " + name;
  node.origin += position.line > 0 ? " in line " + std::to_string(position.line) : " set by " + position.file;
}

std::string path_of(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

}  // namespace

void Scope::define(const std::string& name, Node value) {
  if (!value.formula.empty()) work_out(value);
  parameters_[name] = std::move(value);
}

const Node* Scope::find(const std::string& name) const {
  const auto found = parameters_.find(name);
  if (found != parameters_.end()) return &found->second;
  return outer_ != nullptr ? outer_->find(name) : nullptr;
}

std::vector<std::string> Scope::names() const {
  std::set<std::string> names;
  for (const Scope* scope = this; scope != nullptr; scope = scope->outer_) {
    for (const auto& [name, value] : scope->parameters_) names.insert(name);
  }
  return {names.begin(), names.end()};
}

void Substitution::visit(Node& node, const std::string& path, const Scope& scope) {
  if (node.kind == Node::Kind::scalar) substitute(node, path, scope);
  for (std::size_t i = 0; i < node.items.size(); ++i) visit(node.items[i], path + "." + std::to_string(i), scope);
  for (Entry& entry : node.entries) visit(entry.value, path_of(path, entry.key), scope);
}

std::string Substitution::in_key(const std::string& key, const SourcePosition& position, const std::string& path,
                                 const Scope& scope) {
  Node node{.kind = Node::Kind::scalar, .position = position, .text = key};
  substitute(node, path, scope);
  return node.text;
}

// As text every parameter is pasted as it is; as formula it is put in parentheses, so that signs and operators around
// it keep their meaning in arithmetic. The type that the key expects decides between them.
void Substitution::substitute(Node& node, const std::string& path, const Scope& scope) {
  const std::string given = node.text;
  if (node.reported || given.find("${") == std::string::npos) return;
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
    const Node* parameter = scope.find(name);
    if (parameter == nullptr) {
      report_unknown(node, path, name, scope);
      return;
    }
    if (parameter->reported) {
      node.reported = true;
      return;
    }
    note_origin(node, name, parameter->position);
    pieces.add(*parameter);
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

void Substitution::report_unknown(Node& node, const std::string& path, const std::string& name, const Scope& scope) {
  node.reported = true;
  const std::vector<std::string> names = scope.names();
  const std::string expected =
      names.empty() ? "a parameter, but the model has none" : "one of the parameters " + one_of(names);
  faults_.push_back({node.position, path, "unknown parameter '" + name + "'", expected, did_you_mean(name, names)});
}

void define_parameters(Node& root, Substitution& substitution, Scope& scope) {
  Node* parameters = root.find("parameters");
  if (parameters == nullptr) return;
  for (Entry& entry : parameters->entries) {
    substitution.visit(entry.value, "parameters." + entry.key, scope);
    Node& value = entry.value;
    scope.define(entry.key, value);
    value = *scope.find(entry.key);
  }
}

void substitute_parameters(Node& root, Substitution& substitution, const Scope& scope) {
  for (Entry& entry : root.entries) {
    const bool is_apart = entry.key == "parameters" || entry.key == "templates" || entry.key == "study";
    if (!is_apart) substitution.visit(entry.value, entry.key, scope);
  }
}

}  // namespace hersey::model
