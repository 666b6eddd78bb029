#pragma once

#include <filesystem>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/model.h"
#include "hersey/run/checkpoint.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"

namespace hersey::run {

/// Simulates `model` from its start to its end and writes the results as it goes.
///
/// A step that does not converge is repeated with half its length down to simulation.smallest_step; then the run ends
/// as `failed` with the time, the worst equation and the reason, its results up to there intact.
/// @throws InputError where the model cannot start: gap closed, singular mechanism, a table that does not cover the
/// run.
///
/// Beside the results lies a checkpoint, written as model::Simulation::Checkpoints asks and whenever the run is
/// stopped; it is removed when the run completes. With `resume` the run goes on from there, or from the start where
/// there is no checkpoint yet, and ends with the numbers of a run that was never interrupted, to the last bit on one
/// machine. A run that was completed is left as it is.
///
/// With `step_error` the model is first run with steps twice as long (a tolerance eight times as large), and from the
/// difference of both follows what the steps have done to each bearing's figures (theory manual eq. (integrator.17)).
/// @throws results::FileExists where the file exists and is not to be replaced, FileBusy where another run writes it.
/// @throws InputError if `resume` is asked for another model; results::ReadError if results or checkpoint are damaged.
[[nodiscard]] Summary simulate(const model::Model& model, const Options& options);

/// Builds `model` and finds its starting state, as `simulate` does first, and writes nothing.
/// @returns what the user should know though the model runs: initial values that had to move, redundant constraints and
///          how they are treated.
/// @throws InputError as `simulate`, and where error-controlled steps would have to hit instants without end.
std::vector<Fault> check(const model::Model& model);

}  // namespace hersey::run
