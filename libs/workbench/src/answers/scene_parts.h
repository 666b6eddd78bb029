#pragma once

#include "answers/request.h"
#include "hersey/model/model.h"
#include "hersey/run/picture.h"

namespace hersey::workbench {

/// The forces of a model, in its order: `[{name, kind, ...}]` with the kind a word of the model file.
///
/// One on a body has `body`, `at` (its point [m], in the body), `torque`, `axes` ("ground" or "body", of `direction`),
/// `direction` (a unit vector, or absent where none is known), `value` with `unit`, and `when`: "always" of a constant
/// one, "start" at the first instant, "largest" where it is zero then: the largest of its table, of a revolution or of
/// the run. One between two frames has `from` and `to`, the bodies; one on a coordinate `joint` and `coordinate`.
[[nodiscard]] Json loads_json(const model::Model& model, const run::Picture& picture);

/// The frames with a name: `{body: [{name, position: [3], orientation: [w, x, y, z]}]}`, in the axes of their body.
[[nodiscard]] Json frames_json(const model::Model& model);

/// The oil circuit: `{nodes: [{name, given, pressure}], elements: [name], feeds: [{node, bearing, feature}]}`. The
/// pressure [Pa] of a node is that of the first instant where it is given, else absent. @pre the model has a circuit
[[nodiscard]] Json circuit_json(const model::Model& model);

}  // namespace hersey::workbench
