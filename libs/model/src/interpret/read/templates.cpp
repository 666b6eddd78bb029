#include "interpret/read/templates.h"

#include <algorithm>

#include "check/check.h"
#include "hersey/core/spelling.h"

namespace hersey::model {
namespace {

// The limits are those of aliases: templates that use each other several times would fill any memory.
constexpr std::size_t kMostNodes = 100'000;
constexpr std::size_t kMostBytes = 16'000'000;
constexpr std::size_t kDeepest = 64;

std::string sub_path(const std::string& path, const std::string& key) { return path.empty() ? key : path + "." + key; }

bool is_apart(const std::string& key) { return key == "parameters" || key == "templates" || key == "study"; }

/// The value of `key`, taken out of `node`; nothing where there is none.
std::optional<Node> take(Node& node, const std::string& key) {
  const auto at = std::find_if(node.entries.begin(), node.entries.end(), [&](const Entry& e) { return e.key == key; });
  if (at == node.entries.end()) return std::nullopt;
  Node value = std::move(at->value);
  node.entries.erase(at);
  return value;
}

/// First and last line of a value.
struct Lines {
  int first = 0, last = 0;
};

void widen(Lines& lines, const Node& node) {
  lines.last = std::max(lines.last, node.position.line);
  for (const Node& item : node.items) widen(lines, item);
  for (const Entry& entry : node.entries) {
    lines.last = std::max(lines.last, entry.position.line);
    widen(lines, entry.value);
  }
}

/// Adds `part`'s keys where `node` has them not.
void merge(Node& node, Node part) {
  for (Entry& entry : part.entries) {
    Node* own = node.find(entry.key);
    if (own == nullptr) {
      node.entries.push_back(std::move(entry));
    } else if (own->kind == Node::Kind::mapping && entry.value.kind == Node::Kind::mapping) {
      merge(*own, std::move(entry.value));
    } else if (own->kind == Node::Kind::null) {
      (void)take(node, entry.key);
    }
  }
}

}  // namespace

/// Location of the expansion: the key path, its depth, and the enclosing templates.
struct Templates::Location {
  std::string path;
  std::size_t depth = 0;
  std::vector<std::string> within;
  std::string used;  // the use that put this in; empty outside of templates

  [[nodiscard]] Location at(const std::string& key) const { return {sub_path(path, key), depth + 1, within, used}; }
};

Templates::Templates(Node root, const Scope& parameters, Substitution& substitution, std::vector<Fault>& faults)
    : source_(std::move(root)), parameters_(parameters), substitution_(substitution), faults_(faults) {
  const Node* section = source_.find("templates");
  if (section == nullptr || section->kind == Node::Kind::null) return;
  if (section->kind != Node::Kind::mapping) {
    report(section->position, "templates", description_of(*section), "a mapping from names to templates");
    return;
  }
  for (const Entry& entry : section->entries) {
    const std::string path = sub_path("templates", entry.key);
    if (!is_name(entry.key)) {
      report(entry.position, path, "name '" + entry.key + "'", "letters, digits and _, beginning with a letter");
    } else if (entry.value.kind != Node::Kind::mapping) {
      report(entry.value.position, path, description_of(entry.value), "a template {key: value, ...}");
    }
    templates_.push_back({entry.key, &entry});
  }
}

void Templates::report(const SourcePosition& at, const std::string& path, std::string found, std::string expected,
                       std::string suggestion) {
  faults_.push_back({at, path, std::move(found), std::move(expected), std::move(suggestion)});
}

std::vector<Fault> Templates::unused() const {
  std::vector<Fault> faults;
  for (const Template& one : templates_) {
    if (!one.is_used)
      faults.push_back({one.entry->position, sub_path("templates", one.name),
                        "a template that nothing uses, so that nothing in it is checked", "a use of it, or none of it",
                        ""});
  }
  return faults;
}

void Templates::expand(Node& root) {
  if (root.kind != Node::Kind::mapping) return;
  for (Entry& entry : root.entries) {
    if (!is_apart(entry.key) && entry.key != kUse) expand(entry.value, Location{}.at(entry.key));
  }
  if (const std::optional<Node> use = take(root, kUse)) expand_uses(root, *use, Location{});
}

void Templates::expand(Node& node, const Location& location) {
  for (std::size_t i = 0; i < node.items.size(); ++i) expand(node.items[i], location.at(std::to_string(i)));
  for (Entry& entry : node.entries) {
    if (entry.key != kUse) expand(entry.value, location.at(entry.key));
  }
  if (const std::optional<Node> use = take(node, kUse)) expand_uses(node, *use, location);
}

void Templates::expand_uses(Node& node, const Node& use, const Location& location) {
  const std::size_t faults_before = faults_.size();
  expand_each(node, use, location);
  // Keys of a template that could not be expanded are not reported as missing, too.
  if (faults_.size() > faults_before && !location.path.empty()) node.reported = true;
}

// Two templates beside each other may not give the same key; what is beside `use` goes before both.
void Templates::expand_each(Node& node, const Node& use, const Location& location) {
  if (use.kind != Node::Kind::sequence) return merge(node, instance(use, location));
  Node all{.kind = Node::Kind::mapping};
  const auto add = [&](const auto& self, Node& to, Node part, const std::string& path) -> void {
    for (Entry& entry : part.entries) {
      Node* there = to.find(entry.key);
      if (there == nullptr) {
        to.entries.push_back(std::move(entry));
      } else if (there->kind == Node::Kind::mapping && entry.value.kind == Node::Kind::mapping) {
        self(self, *there, std::move(entry.value), sub_path(path, entry.key));
      } else {
        report(entry.position, sub_path(path, entry.key),
               "a key that another use beside it has too (line " + std::to_string(there->position.line) + ")",
               "each key from one template", "in keys, a parameter distinguishes them: rod_${n}");
      }
    }
  };
  for (const Node& item : use.items) add(add, all, instance(item, location), location.path);
  merge(node, std::move(all));
}

Templates::Template* Templates::find(const Node& name, const Location& location) {
  std::vector<std::string> names;
  for (Template& one : templates_) {
    if (name.kind == Node::Kind::scalar && one.name == name.text) return &one;
    names.push_back(one.name);
  }
  const std::string path = sub_path(location.path, kUse);
  if (name.kind != Node::Kind::scalar) {
    report(name.position, path, description_of(name), "the name of a template");
  } else if (names.empty()) {
    report(name.position, path, "unknown template '" + name.text + "'", "a template, but the model has none");
  } else {
    report(name.position, path, "unknown template '" + name.text + "'", one_of(names), did_you_mean(name.text, names));
  }
  return nullptr;
}

Node Templates::instance(const Node& given_use, const Location& location) {
  const Node nothing{.kind = Node::Kind::mapping, .position = given_use.position};
  if (given_use.reported || is_over_limit_) return nothing;
  Node use = given_use;
  // Inside a template the arguments have been put in with everything of it.
  substitution_.visit(use, sub_path(location.path, kUse), parameters_);
  const bool is_name_alone = use.kind == Node::Kind::scalar;
  const Node* name = is_name_alone ? &use : use.find("template");
  if (name == nullptr) {
    report(use.position, sub_path(location.path, kUse), description_of(use) + " without the key 'template'",
           "a template's name, {template: name, parameter: value, ...}, or a list of these");
    return nothing;
  }
  if (name->reported) return nothing;
  Template* chosen = find(*name, location);
  if (chosen == nullptr) return nothing;
  chosen->is_used = true;
  if (chosen->entry->value.kind != Node::Kind::mapping) return nothing;
  if (std::find(location.within.begin(), location.within.end(), chosen->name) != location.within.end()) {
    std::string chain;
    for (const std::string& outer : location.within) chain += outer + " -> ";
    report(use.position, sub_path(location.path, kUse), "a template that uses itself: " + chain + chosen->name,
           "templates of other templates");
    return nothing;
  }
  Node part = chosen->entry->value;
  if (!is_within_limits(part, use, location)) return nothing;
  Scope scope(&parameters_);
  if (!take_arguments(use, *chosen, location, scope)) return nothing;
  (void)take(part, "parameters");
  note_use(*chosen, use, location);
  substitution_.visit(part, location.path, scope);
  replace_keys(part, location, scope);
  Location inside = location;
  inside.within.push_back(chosen->name);
  inside.used = uses_.back().text;
  expand(part, inside);
  return part;
}

void Templates::note_use(const Template& chosen, const Node& use, const Location& location) {
  Lines lines{chosen.entry->position.line, chosen.entry->position.line};
  widen(lines, chosen.entry->value);
  const SourcePosition& at = use.position;
  const std::string where = at.line > 0 ? " in line " + std::to_string(at.line) : " by " + at.file;
  uses_.push_back(
      {location.path, chosen.entry->position.file, lines.first, lines.last,
       "template " + chosen.name + ", used" + where + (location.used.empty() ? "" : " of " + location.used)});
}

bool Templates::is_within_limits(const Node& node, const Node& use, const Location& location) {
  const Extent extent = extent_of(node);
  nodes_ += extent.nodes;
  bytes_ += extent.text_bytes + extent.key_bytes;
  const auto refuse = [&](const char* found, const char* expected) {
    report(use.position, location.path, found, expected);
    is_over_limit_ = true;
    return false;
  };
  if (nodes_ > kMostNodes) return refuse("templates that repeat more than 100000 values", "at most 100000 values");
  if (bytes_ > kMostBytes) return refuse("templates that repeat more than 16 MB of text", "at most 16 MB");
  if (location.depth + extent.depth > kDeepest || location.within.size() > kDeepest)
    return refuse("templates within templates more than 64 deep", "at most 64 levels");
  return true;
}

// A template's parameters: those that the use gives, of the others their defaults, each of which may use those above.
bool Templates::take_arguments(const Node& use, const Template& chosen, const Location& location, Scope& scope) {
  const std::size_t faults_before = faults_.size();
  const Node none{.kind = Node::Kind::mapping};
  const Node* declared = chosen.entry->value.find("parameters");
  if (declared == nullptr || declared->kind == Node::Kind::null) declared = &none;
  if (declared->kind != Node::Kind::mapping) {
    report(declared->position, sub_path(sub_path("templates", chosen.name), "parameters"), description_of(*declared),
           "a mapping from names to values, {angle: 90 deg, n}; what has none is given by each use");
    return false;
  }
  std::vector<std::string> names;
  for (const Entry& parameter : declared->entries) names.push_back(parameter.key);
  for (const Entry& given : use.entries) {
    if (given.key == "template" || declared->find(given.key) != nullptr) continue;
    report(given.position, sub_path(sub_path(location.path, kUse), given.key),
           "unknown parameter '" + given.key + "' of template '" + chosen.name + "'",
           names.empty() ? "no parameters, as the template has none" : one_of(names), did_you_mean(given.key, names));
  }
  for (const Entry& parameter : declared->entries)
    take_argument(parameter, use.find(parameter.key), use, location, scope);
  return faults_.size() == faults_before;
}

bool Templates::take_argument(const Entry& parameter, const Node* given, const Node& use, const Location& location,
                              Scope& scope) {
  Node value = given != nullptr ? *given : parameter.value;
  const std::string path = sub_path(sub_path(location.path, kUse), parameter.key);
  scope.define(parameter.key, Node{.kind = Node::Kind::scalar, .reported = true});  // until it is known to be good
  if (value.kind == Node::Kind::null) {
    report(use.position, path, "missing parameter '" + parameter.key + "'", "a value: it has no default");
    return false;
  }
  if (value.kind != Node::Kind::scalar || parameter.key == "template" || !is_name(parameter.key)) {
    const bool is_bad_name = value.kind == Node::Kind::scalar;
    report(is_bad_name ? parameter.position : value.position, path,
           is_bad_name ? "a parameter called '" + parameter.key + "'" : description_of(value),
           is_bad_name ? "letters, digits and _, beginning with a letter, and not 'template'"
                       : "a number, quantity or word");
    return false;
  }
  if (given == nullptr) substitution_.visit(value, path, scope);
  if (value.reported) return false;
  scope.define(parameter.key, std::move(value));
  return true;
}

void Templates::replace_keys(Node& node, const Location& location, const Scope& scope) {
  for (Node& item : node.items) replace_keys(item, location, scope);
  std::vector<std::string> keys;
  for (Entry& entry : node.entries) {
    const bool has_parameter = entry.key.find("${") != std::string::npos;
    if (has_parameter) entry.key = substitution_.in_key(entry.key, entry.position, location.path, scope);
    const bool is_repeated = std::find(keys.begin(), keys.end(), entry.key) != keys.end();
    if (has_parameter && is_repeated)
      report(entry.position, sub_path(location.path, entry.key), "duplicate key '" + entry.key + "'", "each key once");
    keys.push_back(entry.key);
    replace_keys(entry.value, location, scope);
  }
}

void name_template_uses(const std::vector<TemplateUse>& uses, std::vector<Fault>& faults) {
  for (Fault& fault : faults) {
    const SourcePosition& at = fault.position;
    const TemplateUse* best = nullptr;
    for (const TemplateUse& use : uses) {
      const bool is_inside = at.file == use.file && use.first_line <= at.line && at.line <= use.last_line;
      const bool is_of_it = use.path.empty() || fault.path == use.path || fault.path.starts_with(use.path + ".");
      if (is_inside && is_of_it && (best == nullptr || use.path.size() >= best->path.size())) best = &use;
    }
    if (best != nullptr) fault.expected += " (" + best->text + ")";
  }
}

}  // namespace hersey::model
