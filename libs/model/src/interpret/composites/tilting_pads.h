#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.h"
#include "interpret/composites/composite_parts.h"

namespace hersey::model {

/// What a bearing of tilting pads consists of: bodies, joints, forces and films of a model, as a tree with these
/// sections.
/// @param node  its mapping in the file, with parameters put in
/// @param value  the same, checked
/// @param shell, journal  frames that carry pads and journal
/// @param parts  receives what is known of the pads
/// @returns nothing if it is at fault, which is added to `faults`
[[nodiscard]] std::optional<Node> tilting_pads(const Node& node, const Value& value, const std::string& shell,
                                               const std::string& journal, CompositeParts& parts,
                                               std::vector<Fault>& faults);

}  // namespace hersey::model
