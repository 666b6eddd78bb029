#pragma once

#include <string>

#include "hersey/model/model.h"
#include "variables.h"

namespace hersey::fmu {

/// Returns terminalsAndIcons.xml of FMI 3.0: one terminal for each thing that the importer can take hold of, with its
/// inputs as flows and the motion that answers them as signals.
///
///   - a force or torque on a body: `f.x` or `t.x` and so on, with position, velocity and rotation of the body
///   - a drive: `w` or `a` (of an angle) or `v` or `a` (of a length) with the joint's coordinate and the drive's effort
///   - a fed feature of a bearing: its pressure `p`, with the flow `q` that the bearing draws from all of them
///
/// Only what the FMU has as a variable is a member.
[[nodiscard]] std::string terminals_xml(const model::Model& model, const Variables& variables);

/// Returns the icon of all FMUs, a journal in its bearing, as a PNG file of 64 x 64 points.
[[nodiscard]] std::string icon();

}  // namespace hersey::fmu
