#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "interpret/composites/composites.h"
#include "interpret/read/templates.h"
#include "tree/overrides.h"

namespace hersey::model {

/// The keys of the model's top level.
[[nodiscard]] std::vector<std::string> top_level_keys();

/// A tree with everything applied, and the template uses in it.
struct CompleteTree {
  std::vector<Fault> warnings;  ///< templates that nothing uses
  std::vector<TemplateUse> uses;
  Composites composites;  ///< spelt out in the tree
};

/// Puts overrides, templates and parameters into the tree, which then holds nothing but values, and spells out
/// composites.
[[nodiscard]] CompleteTree complete_tree(Node& root, const std::vector<Override>& overrides,
                                         std::vector<Fault>& faults);

/// Reads a model from its YAML tree; faults are added to `faults`, and the model is usable only where there are none.
[[nodiscard]] Model read_tree(Node root, const std::string& file, const std::vector<Override>& overrides,
                              std::vector<Fault>& faults);

/// Puts faults in the order of the file and drops repetitions, which one wrong value used twice would cause.
void tidy(std::vector<Fault>& faults);

}  // namespace hersey::model
