#include "hersey/model/written.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "hersey/core/quantity_formula.h"
#include "hersey/core/spelling.h"
#include "hersey/core/units.h"
#include "interpret/read/reader.h"
#include "tree/overrides.h"

namespace hersey::model {
namespace {

using Json = nlohmann::ordered_json;

/// A quantity computed from parameters is written as its value, which reads without them: "-500 N" for "-(500 N)".
std::string worked_out(const Node& node) {
  if (node.formula.find('(') != std::string::npos) {
    try {
      const Quantity value = evaluate_formula(node.formula);
      return fmt::format("{}{}{}", value.number, value.unit.empty() ? "" : " ", value.unit);
    } catch (const QuantityError&) {
      // A word, an expression of time, several numbers: as it is written.
    }
  }
  return written(node);
}

Json json_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::scalar:
      return worked_out(node);
    case Node::Kind::sequence: {
      Json list = Json::array();
      for (const Node& item : node.items) list.push_back(json_of(item));
      return list;
    }
    case Node::Kind::mapping: {
      Json mapping = Json::object();
      for (const Entry& entry : node.entries) mapping[entry.key] = json_of(entry.value);
      return mapping;
    }
    case Node::Kind::null:
      return nullptr;
  }
  return nullptr;
}

const Node* item_called(const Node& node, const std::string& key) {
  if (node.kind != Node::Kind::sequence) return node.find(key);
  std::size_t index = node.items.size();
  std::from_chars(key.data(), key.data() + key.size(), index);
  return index < node.items.size() ? &node.items[index] : nullptr;
}

// Reports that there is no value at `path`: the last existing node is `node`, which has no `key`.
[[noreturn]] void refuse(const Node& node, const std::string& path, const std::string& key) {
  std::vector<std::string> keys;
  for (const Entry& entry : node.entries) keys.push_back(entry.key);
  const std::string expected = keys.empty() ? "a key path of the model" : one_of(keys);
  throw InputError(Fault{node.position, path, "no '" + key + "' in the model", expected, did_you_mean(key, keys)});
}

}  // namespace

std::string written_json(const std::string& text, const std::string& file, const std::vector<std::string>& overrides,
                         const std::string& path) {
  std::vector<Fault> faults;
  const std::vector<Override> changes = parse_overrides(overrides, faults);
  const Node root = [&] {
    std::optional<Node> tree = parse_yaml(text, file, faults);
    if (!tree) return Node{};
    name_template_uses(complete_tree(*tree, changes, faults).uses, faults);
    return std::move(*tree);
  }();
  if (!faults.empty()) throw InputError(std::move(faults));
  const Node* node = &root;
  for (std::size_t from = 0; from < path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    const std::string key = path.substr(from, dot - from);
    const Node* next = item_called(*node, key);
    if (next == nullptr) refuse(*node, path, key);
    node = next;
    from = dot + 1;
  }
  return json_of(*node).dump();
}

}  // namespace hersey::model
