#include "interpret/composites/composites.h"

#include <algorithm>
#include <string>
#include <utility>

#include "check/check.h"
#include "check/members.h"
#include "hersey/core/contract.h"
#include "hersey/core/units.h"
#include "interpret/composites/composite_kind.h"
#include "interpret/composites/pad_parts.h"
#include "schema/format.h"

namespace hersey::model {
namespace {

std::string text_at(const Node& mapping, const char* key) {
  const Node* node = mapping.find(key);
  return node != nullptr && node->kind == Node::Kind::scalar ? node->text : "";
}

/// The `bearings` of a model alone, as the schema sees them.
Value checked(const Entry& bearing, std::vector<Fault>& faults, std::map<std::string, SourcePosition>& positions) {
  static const TypePtr type = object("a model's bearings", {optional("bearings", bearings_format(), "")});
  Node section{.kind = Node::Kind::mapping, .position = bearing.position};
  section.entries.push_back(bearing);
  Node root{.kind = Node::Kind::mapping, .position = bearing.position};
  root.entries.push_back({"bearings", bearing.position, std::move(section)});
  return check(root, *type, faults, positions);
}

/// Adds the sections of `parts` to those of `root`, which lies at `path`. Names that are taken are faults.
void add_parts(Node& root, Node parts, const CompositeParts& composite, std::vector<Fault>& faults,
               const std::string& path = "") {
  for (Entry& section : parts.entries) {
    Node* own = root.find(section.key);
    if (own == nullptr || own->kind == Node::Kind::null) {
      std::erase_if(root.entries, [&](const Entry& entry) { return entry.key == section.key; });
      root.entries.push_back(std::move(section));
      continue;
    }
    if (own->kind != Node::Kind::mapping) continue;  // a fault of that section
    if (section.key == "thermal") {                  // whose sections are one deeper
      add_parts(*own, std::move(section.value), composite, faults, "thermal.");
      continue;
    }
    for (Entry& part : section.value.entries) {
      if (const Node* taken = own->find(part.key); taken != nullptr) {
        faults.push_back({taken->position, path + section.key + "." + part.key,
                          "a name that a part of bearing '" + composite.name + "' has", "another name", ""});
        continue;
      }
      own->entries.push_back(std::move(part));
    }
  }
}

/// The model of a composite by itself: `parts`, what is around them, and the oils of the file.
Node alone_in(const Node& root, Node parts, const CompositeKind& kind, const CompositeParts& composite) {
  Node tree = parts_tree(kind.alone(composite), composite.position);
  for (const Entry& entry : root.entries)
    if (entry.key == "lubricants" || entry.key == "thermal") tree.entries.push_back(entry);
  if (Node* thermal = tree.find("thermal"))
    std::erase_if(thermal->entries, [](const Entry& entry) { return entry.key == "grooves" || entry.key == "walls"; });
  std::vector<Fault> faults;
  add_parts(tree, std::move(parts), composite, faults);
  HERSEY_REQUIRE(faults.empty(), "names of a bearing by itself are not taken");
  return tree;
}

/// Speed at which a drive rotates the body of the frame `journal` about its joint's axis, as far as it is a number
/// [rad/s]; else 1.
double speed_of(const Node& root, const std::string& journal) {
  const std::string body = journal.substr(0, journal.find('.'));
  const Node *drives = root.find("drives"), *joints = root.find("joints");
  if (drives == nullptr || joints == nullptr) return 1;
  for (const Entry& drive : drives->entries) {
    const Node* joint = joints->find(text_at(drive.value, "joint"));
    const Node* between = joint != nullptr ? joint->find("between") : nullptr;
    if (between == nullptr || between->items.size() != 2) continue;
    const std::string &outboard = between->items[1].text, speed = text_at(drive.value, "speed");
    if (outboard.substr(0, outboard.find('.')) != body || speed.empty()) continue;
    try {
      if (const double number = parse_quantity(speed, "rad/s"); number != 0) return number;
    } catch (const QuantityError&) {  // a fault of the drive
    }
  }
  return 1;
}

/// The kind of a bearing in the tree; null if it is no composite.
const CompositeKind* composite_kind(const Node& bearing) {
  if (bearing.kind != Node::Kind::mapping) return nullptr;
  const std::string tag = text_at(bearing, "kind");
  const std::vector<CompositeKind>& kinds = composite_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const CompositeKind& k) { return k.tag == tag; });
  return found == kinds.end() ? nullptr : &*found;
}

/// Expands one composite; returns what it puts into the machine, nothing if it is in none or at fault.
std::optional<Node> expand(const Node& root, const Entry& bearing, Composites& composites, std::vector<Fault>& faults) {
  const CompositeKind& kind = *composite_kind(bearing.value);
  const std::size_t faults_before = faults.size();
  const Value all = checked(bearing, faults, composites.positions);
  if (faults.size() > faults_before) return std::nullopt;
  const Value& value = all.find("bearings")->members.front().value;
  CompositeParts parts{.name = bearing.key,
                       .kind = std::string(kind.tag),
                       .position = bearing.position,
                       .fixed_key = kind.fixed,
                       .alone = {}};
  CompositeParts again = parts;
  kind.read_point(value, parts, faults);
  const std::string fixed = text_at(bearing.value, kind.fixed.c_str()),
                    moving = text_at(bearing.value, kind.moving.c_str());
  if (fixed.empty() != moving.empty())
    faults.push_back({bearing.position, value.path,
                      fixed.empty() ? "a " + kind.moving + " without '" + kind.fixed + "'"
                                    : "a " + kind.fixed + " without '" + kind.moving + "'",
                      "both frames, or neither in a model of bearings alone", ""});
  std::optional<Node> own = kind.parts(bearing.value, value, "ground", kind.body, parts, faults);
  if (!own || faults.size() > faults_before) return std::nullopt;
  parts.alone = alone_in(root, std::move(*own), kind, parts);
  std::optional<Node> in_machine;
  if (!fixed.empty()) {
    again.speed = speed_of(root, moving);
    in_machine = kind.parts(bearing.value, value, fixed, moving, again, faults);
    parts.is_in_machine = true;
  }
  composites.parts.push_back(std::move(parts));
  return in_machine;
}

}  // namespace

Composites expand_composites(Node& root, std::vector<Fault>& faults) {
  Composites composites;
  Node* bearings = root.kind == Node::Kind::mapping ? root.find("bearings") : nullptr;
  if (bearings == nullptr || bearings->kind != Node::Kind::mapping) return composites;
  std::vector<Entry> found;
  std::erase_if(bearings->entries, [&](const Entry& entry) {
    const bool is_ours = composite_kind(entry.value) != nullptr;
    if (is_ours) found.push_back(entry);
    return is_ours;
  });
  for (const Entry& entry : found) {
    std::optional<Node> parts = expand(root, entry, composites, faults);
    if (parts) add_parts(root, std::move(*parts), composites.parts.back(), faults);
  }
  return composites;
}

void name_composites(const std::vector<CompositeParts>& composites, std::vector<Fault>& faults) {
  for (Fault& fault : faults) {
    for (const CompositeParts& composite : composites) {
      if (fault.path.starts_with("joints." + composite.name + "_carrier"))
        fault.path = "bearings." + composite.name + "." + composite.fixed_key;
      for (std::size_t k = 0; k < composite.pads.size(); ++k) {
        const std::string path = "bearings." + composite.pads[k], whole = "bearings." + composite.name;
        if (fault.path != path && !fault.path.starts_with(path + ".")) continue;
        const std::string rest = fault.path.substr(path.size());
        const std::string section = composite.sections.empty() ? "" : composite.sections[k];
        const bool is_of_section =
            std::any_of(composite.own_keys.begin(), composite.own_keys.end(),
                        [&](const std::string& key) { return (section + rest).starts_with(key); });
        fault.path = whole + (is_of_section ? "." + section : "") + rest;
      }
    }
  }
}

}  // namespace hersey::model
