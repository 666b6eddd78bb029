#pragma once

#include <optional>
#include <string>

#include "answers/repairs.h"
#include "hersey/model/model.h"
#include "hersey/model/text_map.h"
#include "hersey/run/picture.h"

namespace hersey::workbench {

/// The scene of Answers::check as JSON text: a run of one instant, with `sources` (where each part stands in the text),
/// `bearings` (the unwrapped films), `loads`, `frames` and `circuit` (scene_parts.h), which a run does not draw,
/// `joints` (coordinates that can be moved) and `open` (why loops do not close; else empty).
[[nodiscard]] std::string scene_json(const model::Model& model, const run::Picture& picture, const model::TextMap& map,
                                     const TextColumns& columns);

/// `{name: {position: [3], orientation: [w, x, y, z]}}`.
[[nodiscard]] Json poses_json(const run::Picture& picture);

/// The coordinates that can be moved, with their values: `{joint: [{name, unit, value}]}`.
[[nodiscard]] Json joints_json(const model::Model& model, const run::Picture& picture);

}  // namespace hersey::workbench
