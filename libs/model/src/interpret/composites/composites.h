#pragma once

#include <map>
#include <string>
#include <vector>

#include "interpret/composites/composite_parts.h"

namespace hersey::model {

/// The composites of a model and the location of their keys.
struct Composites {
  std::vector<CompositeParts> parts;
  std::map<std::string, SourcePosition> positions;
};

/// Spells out all composites of the tree `root`, whose templates and parameters have been put in. One that is at fault
/// is taken out, and its faults are added to `faults`.
[[nodiscard]] Composites expand_composites(Node& root, std::vector<Fault>& faults);

/// Gives faults in parts of a composite the path of the composite, which is what the file has.
void name_composites(const std::vector<CompositeParts>& composites, std::vector<Fault>& faults);

}  // namespace hersey::model
