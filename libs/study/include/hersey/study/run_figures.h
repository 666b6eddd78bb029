#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/results/reader.h"

namespace hersey::study {

/// A number of a run by its name.
struct RunFigure {
  std::string key;      ///< "bearings.big_end.cycle.film_loss"
  std::string text;     ///< "mean power loss in the film"
  std::string si_unit;  ///< "W", "1" for a pure number
  double value = 0;     ///< in `si_unit`
};

/// Returns the summary rows of a run, and those of `wanted` that are a series of the results file and one of `.min`,
/// `.max`, `.mean`, `.rms`, `.end`, such as `bearings.main.eccentricity.x.max`; for a machine's modes
/// `modes.<number>.frequency`, `.damped_frequency` and `.damping_ratio`. Values of cycles (`bearings.<b>.cycle.`) are
/// those of the last one.
/// @throws results::ReadError
/// @verified_by run_figures_test.cpp
[[nodiscard]] std::vector<RunFigure> figures_of(const results::Reader& reader, const std::vector<std::string>& wanted);

/// Names that figures_of a simulation may give, <...> standing for any; series not among them.
[[nodiscard]] std::vector<std::string> run_figure_keys();

/// Names that figures of `model` solved as steady bearings have, <...> standing for any.
[[nodiscard]] std::vector<std::string> steady_figure_keys(const model::Model& model);

/// True if `name` matches one of `patterns`, in which <...> matches anything without a dot.
[[nodiscard]] bool is_among(const std::string& name, const std::vector<std::string>& patterns);

/// Names of series that are like `name`: every one of the same kind of thing, with the names of things and the ending
/// that `name` has. For who has mistyped one.
[[nodiscard]] std::vector<std::string> series_like(const std::string& name);

/// True if `name` is that of a series of results files with a statistic.
[[nodiscard]] bool is_of_a_series(const std::string& name);

}  // namespace hersey::study
