#pragma once

#include <string>
#include <vector>

#include "interpret/source_tree.h"

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

/// Whether `name` is a parameter of the model `root`.
[[nodiscard]] bool is_parameter(const Node& root, const std::string& name);

/// Puts the overrides' values in their places: in `parameters` where the name is one, else along the key path, whose
/// missing mappings are made. `top_keys` are the keys a path may begin with. Where the study has variants, `variant`
/// stands for the overrides of the one it names.
void apply_overrides(Node& root, const std::vector<Override>& overrides, const std::vector<std::string>& top_keys,
                     std::vector<Fault>& faults);

/// Replaces every ${name} outside `parameters` and `study` by the parameter's text; a parameter may use those above it.
void substitute_parameters(Node& root, std::vector<Fault>& faults);

}  // namespace hersey::model
