#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/initialise.h"

namespace hersey::run {

/// True if the analysis starts from the values that `initial` gives; otherwise its search for rest begins there.
[[nodiscard]] bool keeps_start(const model::Simulation& plan);

/// Refuses a start that differs from the given values by more than the rounding of values written with three digits:
/// 1e-3 rad, of the machine's size, or of its largest rate.
/// @param summary  of the assembly that ended in `start`
/// @throws InputError, a fault for each such value with the nearest value found, and the joints that stay open with
///         their distances
void require_given_start(const model::Model& model, mbd::Mechanism& mechanism, const solver::State& start,
                         const solver::InitialiseSummary& summary);

/// Every given value that `start` does not have, beyond round-off, for the terminal ...
[[nodiscard]] std::vector<Fault> start_warnings(const model::Model& model, mbd::Mechanism& mechanism,
                                                const solver::State& start);
/// ... and as name and text for the results file.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> start_rows(const model::Model& model,
                                                                          mbd::Mechanism& mechanism,
                                                                          const solver::State& start);

/// "joint wrist is 0.03 mm apart, ...".
[[nodiscard]] std::string gaps_text(const std::vector<solver::OpenConstraint>& open);

}  // namespace hersey::run
