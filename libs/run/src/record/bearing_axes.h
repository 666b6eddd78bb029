#pragma once

#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Bearings whose journal is to turn about another axis than theirs, by a joint between journal and shell or by the
/// velocities of the start: it would touch the shell at the edges within a part of a turn.
/// @param start  the machine where the run begins
[[nodiscard]] std::vector<Fault> axis_warnings(const model::Model& model, const model::Machine& machine,
                                               const mbd::Observation& start);

}  // namespace hersey::run
