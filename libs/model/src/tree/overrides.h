#pragma once

#include <string>
#include <vector>

#include "tree/source_tree.h"

namespace hersey::model {

/// One replacement of a value before checking.
struct Override {
  std::string name;         ///< a parameter, or a key path
  Node value;               ///< every position in it says where the override was given
  SourcePosition position;  ///< ("--set", 0, 0), or a line of a study
};

/// Reads "load=500N" or "bearings.big_end.grid.axial=25"; the value is YAML.
[[nodiscard]] std::vector<Override> parse_overrides(const std::vector<std::string>& texts, std::vector<Fault>& faults);

/// The override by which a study's variant is chosen: --set variant=rigid.
inline constexpr const char* kVariant = "variant";

/// True if `name` is a parameter of the model `root`.
[[nodiscard]] bool is_parameter(const Node& root, const std::string& name);

/// Applies the overrides' values: in `parameters` if the name is one, else along the key path, whose missing mappings
/// are made. `top_keys` are the keys with which a path may begin.
void apply_overrides(Node& root, const std::vector<Override>& overrides, const std::vector<std::string>& top_keys,
                     std::vector<Fault>& faults);

/// The overrides in two parts: those of parameters, templates and their uses, which have to be known before templates
/// are put in, and all others, with variants spelt out.
struct OrderedOverrides {
  std::vector<Override> before_templates, after_templates;
};

/// Sorts the overrides, each part in the order they came.
[[nodiscard]] OrderedOverrides in_order(const Node& root, const std::vector<Override>& overrides,
                                        std::vector<Fault>& faults);

}  // namespace hersey::model
