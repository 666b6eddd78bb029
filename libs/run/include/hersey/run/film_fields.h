#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "hersey/film/observables.h"

namespace hersey::run {

/// A field of a film: a line of their one table.
struct FilmField {
  std::string name;         ///< in the results file, "asperity_pressure"
  std::string unit;         ///< SI
  std::string text;         ///< description
  std::string label;        ///< in tables, "asperity pressure"
  std::string shown_unit;   ///< in tables, "MPa"; empty for a pure number
  double shown_per_si = 1;  ///< number of shown units in one SI unit, 1e-6
  /// Values at the nodes, shape (n_phi n_z); empty where the film has none.
  std::function<Eigen::VectorXd(const film::FilmFields&)> values;
  std::string symbol = {}, note = {};  ///< QuantityInfo
};

/// All fields that are stored over time and shown of a single bearing.
[[nodiscard]] const std::vector<FilmField>& film_fields();

}  // namespace hersey::run
