#pragma once

#include <filesystem>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/model.h"
#include "hersey/run/checkpoint.h"
#include "hersey/run/options.h"
#include "hersey/run/summary.h"

namespace hersey::run {

/// Simulates `model` from its start to its end and writes the results during the run.
///
/// A step that does not converge is repeated with half its length down to simulation.smallest_step; then the run ends
/// as `failed` with the time, the worst equation and the reason, and its results up to that time are intact.
/// @throws InputError if the model cannot start: gap closed, singular mechanism, a table that does not cover the run.
///
/// A checkpoint is written beside the results as model::Simulation::Checkpoints requires and whenever the run is
/// stopped; it is removed when the run completes. With `resume` the run continues from the checkpoint, or from the
/// start if there is no checkpoint yet, and ends with the numbers of a run that was never interrupted, to the last bit
/// on one machine. A completed run is left unchanged.
///
/// With `step_error` the model is first run with steps twice as long (a tolerance eight times as large), and the
/// difference of both runs gives the errors that the steps cause in each bearing's figures (theory manual eq.
/// (integrator.17)).
/// @throws results::FileExists if the file exists and must not be replaced, FileBusy if another run writes it.
/// @throws InputError if `resume` is requested for another model; results::ReadError if results or checkpoint are
///         damaged.
[[nodiscard]] Summary simulate(const model::Model& model, const Options& options);

/// Builds `model` and finds its starting state, as `simulate` does first, and writes nothing.
/// @returns warnings for a model that runs nevertheless: initial values that had to change, redundant constraints and
///         their treatment.
/// @throws InputError as `simulate`, and if error-controlled steps would have to hit an unlimited number of instants.
std::vector<Fault> check(const model::Model& model);

/// Warnings of the model itself, then those of its start.
/// @throws InputError as check().
[[nodiscard]] std::vector<Fault> warnings_of(const model::Model& model);

/// @throws InputError for a model of bearings alone, which has nothing to simulate.
void require_machine(const model::Model& model);

}  // namespace hersey::run
