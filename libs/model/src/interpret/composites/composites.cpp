#include "interpret/composites/composites.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "check/check.h"
#include "check/members.h"
#include "hersey/core/contract.h"
#include "interpret/composites/tilting_pads.h"
#include "schema/format.h"

namespace hersey::model {
namespace {

constexpr const char* kind_of_pads = "tilting_pad";

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

/// Operating point of a bearing of pads; reports what is wrong with it.
std::optional<JournalPoint> point_of(const Value& bearing, double& whirl_ratio, std::vector<Fault>& faults) {
  const Value* value = bearing.find("operating_point");
  if (value == nullptr || value->broken) return std::nullopt;
  const auto given = [&](const char* key) {
    const Value* found = value->find(key);
    return found != nullptr && !found->broken && found->text.empty() ? found : nullptr;
  };
  JournalPoint point;
  point.position = value->key_position;
  point.journal_speed = number_of(*value, "journal_speed");
  point.load_angle = number_of(*value, "load_angle");
  point.eccentricity_angle = number_of(*value, "eccentricity_angle");
  whirl_ratio = number_of(*value, "whirl_ratio");
  const Value *load = given("load"), *ratio = given("eccentricity_ratio");
  if (load != nullptr) point.load = load->number;
  if (ratio != nullptr) point.eccentricity_ratio = ratio->number;
  const auto report = [&](const Value& at, std::string found, std::string suggestion) {
    faults.push_back({at.key_position, at.path, std::move(found), "exactly one of them", std::move(suggestion)});
  };
  if (load != nullptr && ratio != nullptr)
    report(*ratio, "keys 'load' and 'eccentricity_ratio' together", "with --set, give the other one as 'none'");
  if (load == nullptr && ratio == nullptr) report(*value, "neither 'load' nor 'eccentricity_ratio'", "");
  if (point.journal_speed == 0)
    faults.push_back({value->find("journal_speed")->position, value->path + ".journal_speed",
                      "a journal at rest, whose film bears nothing", "a speed, of either sign", ""});
  return point;
}

/// A model with a journal that rotates at its speed, loaded or where it is said to be, and nothing else beside `parts`.
Node alone_in(const Node& root, Node parts, const CompositeParts& composite) {
  const JournalPoint point = composite.point.value_or(JournalPoint{.eccentricity_ratio = 0});
  std::string text = fmt::format(
      "hersey: 1\nbodies:\n  journal: {{mass: 1 kg, inertia: {{xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}}\n"
      "joints:\n  journal: {{type: planar, between: [ground, journal], axis: z}}\n"
      "drives:\n  rotation: {{joint: journal, coordinate: rotation, speed: {} rad/s}}\n",
      composite.point ? point.journal_speed : 1.0);
  if (point.load) {
    text += fmt::format("forces:\n  load: {{type: force, body: journal, components: [{} N, {} N, 0 N]}}\n",
                        *point.load * std::cos(point.load_angle), *point.load * std::sin(point.load_angle));
  } else {
    const double e = *point.eccentricity_ratio * composite.clearance;
    for (const auto& [axis, at] : {std::pair{'x', e * std::cos(point.eccentricity_angle)},
                                   std::pair{'y', e * std::sin(point.eccentricity_angle)}})
      text += fmt::format("  {0}: {{joint: journal, coordinate: {0}, position: {1} m}}\n", axis, at);
  }
  text += "simulation: {analysis: steady}\n";
  std::vector<Fault> faults;
  std::optional<Node> tree = parse_yaml(text, composite.position.file, faults);
  HERSEY_REQUIRE(tree && faults.empty(), "a bearing by itself is a model");
  move_to(*tree, composite.position);
  for (const Entry& entry : root.entries)
    if (entry.key == "lubricants" || entry.key == "thermal") tree->entries.push_back(entry);
  if (Node* thermal = tree->find("thermal"))
    std::erase_if(thermal->entries, [](const Entry& entry) { return entry.key == "grooves" || entry.key == "walls"; });
  add_parts(*tree, std::move(parts), composite, faults);
  HERSEY_REQUIRE(faults.empty(), "names of a bearing by itself are not taken");
  return std::move(*tree);
}

/// Sense in which a drive rotates the body of the frame `journal` about its joint's axis: where pads begin.
double sense_of(const Node& root, const std::string& journal) {
  const std::string body = journal.substr(0, journal.find('.'));
  const Node *drives = root.find("drives"), *joints = root.find("joints");
  if (drives == nullptr || joints == nullptr) return 1;
  for (const Entry& drive : drives->entries) {
    const Node* joint = joints->find(text_at(drive.value, "joint"));
    const Node* between = joint != nullptr ? joint->find("between") : nullptr;
    if (between == nullptr || between->items.size() != 2) continue;
    const std::string& outboard = between->items[1].text;
    if (outboard.substr(0, outboard.find('.')) == body && text_at(drive.value, "speed").starts_with('-')) return -1;
  }
  return 1;
}

/// Expands one composite; returns what it puts into the machine, nothing if it is in none or at fault.
std::optional<Node> expand(const Node& root, const Entry& bearing, Composites& composites, std::vector<Fault>& faults) {
  const std::size_t faults_before = faults.size();
  const Value all = checked(bearing, faults, composites.positions);
  if (faults.size() > faults_before) return std::nullopt;
  const Value& value = all.find("bearings")->members.front().value;
  CompositeParts parts{.name = bearing.key, .position = bearing.position, .alone = {}};
  parts.point = point_of(value, parts.whirl_ratio, faults);
  const std::string shell = text_at(bearing.value, "shell"), journal = text_at(bearing.value, "journal");
  if (shell.empty() != journal.empty())
    faults.push_back({bearing.position, value.path,
                      shell.empty() ? "a journal without 'shell'" : "a shell without 'journal'",
                      "both frames, or neither in a model of bearings alone", ""});
  if (parts.point && parts.point->journal_speed < 0) parts.sense = -1;
  std::optional<Node> own = tilting_pads(bearing.value, value, "ground", "journal", parts, faults);
  if (!own || faults.size() > faults_before) return std::nullopt;
  parts.alone = alone_in(root, std::move(*own), parts);
  std::optional<Node> in_machine;
  if (!shell.empty()) {
    CompositeParts again{.name = parts.name, .position = parts.position, .sense = sense_of(root, journal), .alone = {}};
    in_machine = tilting_pads(bearing.value, value, shell, journal, again, faults);
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
    const bool is_ours = entry.value.kind == Node::Kind::mapping && text_at(entry.value, "kind") == kind_of_pads;
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
        fault.path = "bearings." + composite.name + ".shell";
      for (const std::string& pad : composite.pads) {
        const std::string path = "bearings." + pad;
        if (fault.path != path && !fault.path.starts_with(path + ".")) continue;
        fault.path = "bearings." + composite.name + fault.path.substr(path.size());
      }
    }
  }
}

}  // namespace hersey::model
