#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tree/substitution.h"

namespace hersey::model {

/// Use of a template, for messages about faults in it.
struct TemplateUse {
  std::string path, file;  ///< of the mapping that uses it; of the template
  int first_line = 0, last_line = 0;
  std::string text;  ///< "template main_bearing, used in line 57"
};

/// Adds to faults inside templates the use that caused them.
void name_template_uses(const std::vector<TemplateUse>& uses, std::vector<Fault>& faults);

/// Puts templates where they are used.
///
/// `templates` of a model are mappings with parameters of their own; `use: {template: main_bearing, angle: 90 deg}` in
/// any mapping adds the template's keys to it. Keys beside `use` go before the template's; mappings that both have are
/// merged so, key by key, and a key beside `use` with nothing behind it removes the template's. Keys of a template may
/// contain parameters. What was put in keeps its position in the template; a fault in it tells the use as well.
class Templates {
 public:
  /// Reads `templates` of `root`, which it keeps; reports what is no template.
  Templates(Node root, const Scope& parameters, Substitution& substitution, std::vector<Fault>& faults);

  /// Puts templates into everything of `root` but `parameters`, `templates` and `study`. Where nothing is used, or all
  /// has been put in already, it changes nothing.
  void expand(Node& root);

  /// All that has been put in.
  [[nodiscard]] const std::vector<TemplateUse>& uses() const { return uses_; }

  /// Templates that were put in nowhere: nothing in them has been checked.
  [[nodiscard]] std::vector<Fault> unused() const;

 private:
  struct Template {
    std::string name;
    const Entry* entry = nullptr;
    bool is_used = false;
  };
  struct Location;

  void expand(Node& node, const Location& location);
  void expand_uses(Node& node, const Node& use, const Location& location);
  void expand_each(Node& node, const Node& use, const Location& location);
  Node instance(const Node& use, const Location& location);
  Template* find(const Node& name, const Location& location);
  bool take_arguments(const Node& use, const Template& chosen, const Location& location, Scope& scope);
  bool take_argument(const Entry& parameter, const Node* given, const Node& use, const Location& location,
                     Scope& scope);
  void replace_keys(Node& node, const Location& location, const Scope& scope);
  void note_use(const Template& chosen, const Node& use, const Location& location);
  bool is_within_limits(const Node& node, const Node& use, const Location& location);
  void report(const SourcePosition& at, const std::string& path, std::string found, std::string expected,
              std::string suggestion = {});

  Node source_;  // of the templates, while the model's own tree changes
  const Scope& parameters_;
  Substitution& substitution_;
  std::vector<Fault>& faults_;
  std::vector<Template> templates_;
  std::vector<TemplateUse> uses_;
  std::size_t nodes_ = 0, bytes_ = 0;  // put in so far
  bool is_over_limit_ = false;
};

/// The word that puts a template in.
inline constexpr const char* kUse = "use";

}  // namespace hersey::model
