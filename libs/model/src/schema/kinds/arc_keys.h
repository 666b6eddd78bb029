#pragma once

#include <vector>

#include "schema/format.h"

namespace hersey::model {

/// `arcs` of a journal bearing: each with an angle, preload and ends of its own.
[[nodiscard]] TypePtr arcs_format();

/// Keys of what lies outside the ends of an arc: in the grooves before and after it.
[[nodiscard]] std::vector<Key> arc_end_keys();

/// `bore` of a journal bearing: equal arcs by the names that they are known by.
[[nodiscard]] TypePtr bore_format();

}  // namespace hersey::model
