#pragma once

#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Returns warnings for bearings whose journal rotates about another axis than theirs, by a joint between journal and
/// shell or by the velocities of the start: it would touch the shell at the edges within a part of a revolution.
/// @param start  the machine at the start of the run
[[nodiscard]] std::vector<Fault> axis_warnings(const model::Model& model, const model::Machine& machine,
                                               const mbd::Observation& start);

}  // namespace hersey::run
