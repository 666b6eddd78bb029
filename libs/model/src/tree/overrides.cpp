#include "tree/overrides.h"

#include <algorithm>
#include <charconv>
#include <optional>

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

std::string joined(const std::vector<std::string>& parts, std::size_t first, std::size_t end) {
  std::string key = parts[first];
  for (std::size_t k = first + 1; k < end; ++k) key += "." + parts[k];
  return key;
}

/// Where the key of `node` ends that begins with a part of a path: names may have dots themselves, those of variables
/// of FMUs above all. The longest one that the text has counts.
std::size_t end_of_key(const Node& node, const std::vector<std::string>& parts, std::size_t first) {
  for (std::size_t end = parts.size(); end > first + 1; --end)
    if (node.kind == Node::Kind::mapping && node.find(joined(parts, first, end)) != nullptr) return end;
  const bool is_variable =
      first == 3 && parts[0] == "fmus" && (parts[2] == "inputs" || parts[2] == "parameters") && !node.find(parts[3]);
  return is_variable ? parts.size() : first + 1;
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
  const std::vector<std::string> parts = split_path(change.name);
  for (std::size_t first = 0; first < parts.size();) {
    const std::size_t end = end_of_key(*node, parts, first);
    const std::string key = joined(parts, first, end);
    node = step_into(*node, key, change.position);
    first = end;
    if (node == nullptr) {
      faults.push_back({change.position, change.name, "no item '" + key + "'", "the number of an item, from 0", ""});
      return;
    }
  }
  *node = change.value;
}

std::optional<Override> parse_override(const std::string& text, const SourcePosition& location,
                                       std::vector<Fault>& faults) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    faults.push_back({location, "", "'" + text + "'", "name=value, such as load=500N", ""});
    return std::nullopt;
  }
  Override change{text.substr(0, equals), {}, location};
  std::vector<Fault> in_value;
  change.value = parse_yaml(text.substr(equals + 1), location.file, in_value).value_or(Node{});
  change.value.reported = !in_value.empty();
  for (Fault& fault : in_value)
    faults.push_back({location, change.name, fault.found, fault.expected, fault.suggestion});
  move_to(change.value, location);
  return change;
}

const Node* variants_of(const Node& root) {
  const Node* study = root.find("study");
  return study == nullptr ? nullptr : study->find("variants");
}

bool goes_before_templates(const Node& root, const std::string& name) {
  if (is_parameter(root, name)) return true;
  const std::vector<std::string> keys = split_path(name);
  return keys.front() == "parameters" || keys.front() == "templates" ||
         std::find(keys.begin(), keys.end(), "use") != keys.end();
}

// The overrides of the variant that `choice` names; invalid ones are reported with the study.
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

OrderedOverrides in_order(const Node& root, const std::vector<Override>& overrides, std::vector<Fault>& faults) {
  OrderedOverrides ordered;
  const Node* variants = variants_of(root);
  for (const Override& change : overrides) {
    const bool is_variant = variants != nullptr && change.name == kVariant && !is_parameter(root, kVariant);
    if (!is_variant) {
      (goes_before_templates(root, change.name) ? ordered.before_templates : ordered.after_templates).push_back(change);
      continue;
    }
    for (Override& one : overrides_of_variant(*variants, change, faults)) {
      const bool is_before = goes_before_templates(root, one.name);
      (is_before ? ordered.before_templates : ordered.after_templates).push_back(std::move(one));
    }
  }
  return ordered;
}

void apply_overrides(Node& root, const std::vector<Override>& overrides, const std::vector<std::string>& top_keys,
                     std::vector<Fault>& faults) {
  for (const Override& change : overrides) {
    if (is_parameter(root, change.name)) {
      *root.find("parameters")->find(change.name) = change.value;
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

}  // namespace hersey::model
