#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.h"
#include "interpret/composites/composite_parts.h"

namespace hersey::model {

/// What a thrust bearing of pads on pivots consists of, as tilting_pads() says of one around a journal.
/// @param stator, runner  frames that carry pads and collar
[[nodiscard]] std::optional<Node> thrust_pads(const Node& node, const Value& value, const std::string& stator,
                                              const std::string& runner, CompositeParts& parts,
                                              std::vector<Fault>& faults);

}  // namespace hersey::model
