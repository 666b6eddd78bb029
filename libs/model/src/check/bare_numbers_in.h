#pragma once

#include <vector>

#include "check/schema_type.h"
#include "hersey/model/bare_number.h"
#include "tree/source_tree.h"

namespace hersey::model {

/// Numbers of `node` without unit where `type` asks for one.
[[nodiscard]] std::vector<BareNumber> bare_numbers_in(const Node& node, const Type& type);

}  // namespace hersey::model
