#pragma once

#include "schema/format.h"

namespace hersey::model {

/// `arcs` of a journal bearing: each with an angle, preload and ends of its own.
[[nodiscard]] TypePtr arcs_format();

/// `bore` of a journal bearing: equal arcs by the names that they are known by.
[[nodiscard]] TypePtr bore_format();

}  // namespace hersey::model
