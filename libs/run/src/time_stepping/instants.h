#pragma once

#include <vector>

#include "hersey/mbd/mechanism.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Times inside the run at which an unbalance begins, ascending. Steps of every kind have to hit them: what acts on the
/// machine jumps there.
[[nodiscard]] std::vector<double> jumps(const model::Model& model);

/// Times inside the run at which a table of a drive, load or bearing bends, with the `jumps`, ascending: a step across
/// one would lose its order. Tables over time, and over coordinates that a drive moves at constant speed.
/// @param start  the machine at the start of the run
[[nodiscard]] std::vector<double> kinks(const model::Model& model, const mbd::MechanismSpec& spec,
                                        const mbd::Observation& start);

/// Times that an error-controlled run has to hit, ascending, the last one its end: `kinks`, rows at output.interval,
/// and stored fields where there are bearings.
[[nodiscard]] std::vector<double> instants_to_hit(const model::Model& model, const std::vector<double>& kinks);

}  // namespace hersey::run
