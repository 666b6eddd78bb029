#pragma once

#include <optional>
#include <string>
#include <vector>

#include "check/check.h"
#include "interpret/composites/composite_parts.h"

namespace hersey::model {

/// What a floating ring consists of, as tilting_pads() says of pads around a journal.
/// @param shell, journal  frames around and in the ring
[[nodiscard]] std::optional<Node> floating_ring(const Node& node, const Value& value, const std::string& shell,
                                                const std::string& journal, CompositeParts& parts,
                                                std::vector<Fault>& faults);

}  // namespace hersey::model
