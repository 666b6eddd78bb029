#include <fmt/format.h>

#include <algorithm>

#include "hersey/core/quantity_formula.h"
#include "hersey/model/read.h"
#include "interpret/read/reader.h"

namespace hersey::model {
namespace {

bool is_plain(const std::string& text) {
  const auto fits = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' || c == '.' ||
           c == '/' || c == '+' || c == '^' || c == '-' || c == ' ';
  };
  if (text.empty() || text.front() == ' ' || text.back() == ' ' || text == "-" || text.starts_with("- ")) return false;
  const bool is_null = text == "null" || text == "Null" || text == "NULL";
  return !is_null && !text.starts_with("---") && std::all_of(text.begin(), text.end(), fits);
}

std::string quoted(const std::string& text) {
  if (is_plain(text)) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// A scalar with its parameters worked out, as far as they make a quantity.
std::string value_text(const Node& node) {
  if (node.formula.empty() || node.is_pasted) return quoted(node.text);
  try {
    const Quantity value = evaluate_formula(node.formula);
    return quoted(fmt::format("{}{}{}", value.number, value.unit.empty() ? "" : " ", value.unit));
  } catch (const QuantityError&) {
    return quoted(node.formula);  // an expression
  }
}

bool is_short(const Node& node) {
  return std::all_of(node.items.begin(), node.items.end(),
                     [](const Node& item) { return item.kind == Node::Kind::scalar; });
}

void write(const Node& node, const std::string& indent, std::string& text);

void write_value(const Node& node, const std::string& indent, std::string& text) {
  if (node.kind == Node::Kind::null) {
    text += "\n";
  } else if (node.kind == Node::Kind::scalar) {
    text += " " + value_text(node) + "\n";
  } else if (node.kind == Node::Kind::sequence && is_short(node)) {
    text += " [";
    for (std::size_t i = 0; i < node.items.size(); ++i) text += (i > 0 ? ", " : "") + value_text(node.items[i]);
    text += "]\n";
  } else if (node.items.empty() && node.entries.empty()) {
    text += " {}\n";
  } else {
    text += "\n";
    write(node, indent + "  ", text);
  }
}

void write(const Node& node, const std::string& indent, std::string& text) {
  for (const Entry& entry : node.entries) {
    text += indent + quoted(entry.key) + ":";
    write_value(entry.value, indent, text);
  }
  for (const Node& item : node.items) {
    text += indent + "-";
    write_value(item, indent, text);
  }
}

}  // namespace

std::string expanded_text(const std::string& path, const std::vector<std::string>& overrides) {
  std::vector<Fault> faults;
  const std::vector<Override> changes = parse_overrides(overrides, faults);
  std::optional<Node> root = parse_yaml(file_text(path), path, faults);
  if (root) name_template_uses(complete_tree(*root, changes, faults).uses, faults);
  if (!faults.empty()) {
    tidy(faults);
    throw InputError(std::move(faults));
  }
  std::erase_if(root->entries, [](const Entry& entry) { return entry.key == "parameters" || entry.key == "study"; });
  std::string text;
  write(*root, "", text);
  return text;
}

}  // namespace hersey::model
