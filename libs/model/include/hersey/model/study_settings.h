#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::model {

/// Distribution of a scattering parameter. All numbers are in `unit`; those that a kind does not need are 0.
struct Distribution {
  enum class Kind { normal, uniform, triangular, truncated_normal };
  Kind kind = Kind::uniform;
  double mean = 0, standard_deviation = 0;
  double low = 0, mode = 0, high = 0;
  std::string unit;  ///< as written with the mean or `low`; empty for a bare number

  /// number of standard deviations from the mean for which the model must be valid if the distribution is unbounded
  static constexpr double reach = 5;
  /// True if it has the bounds `low` and `high`.
  [[nodiscard]] bool is_bounded() const { return kind != Kind::normal; }
  /// The smallest value that a parameter must be able to take, in `unit`.
  [[nodiscard]] double lowest() const { return is_bounded() ? low : mean - reach * standard_deviation; }
  /// The largest, in `unit`.
  [[nodiscard]] double highest() const { return is_bounded() ? high : mean + reach * standard_deviation; }
};

struct StudyParameter {
  std::string name;                 ///< a parameter, or a key path
  std::vector<std::string> values;  ///< as written, e.g. "100 N"; none where it has a distribution
  SourcePosition position;
  std::optional<Distribution> distribution = {};
};

enum class StudyFigure { midplane_pressure, film_thickness };
enum class StudyPlan { full_factorial, list, latin_hypercube, sobol, halton, corners, optimise };
enum class StudySearch { local, global };
enum class StudyAnalysis { as_model, simulation, steady };
enum class StudyKeep { figures, results, report };
enum class StudyDiagram { none, campbell, run_up };

/// A figure that is to be small or large.
struct StudyObjective {
  std::string name;
  bool is_maximised = false;
  SourcePosition position;
};

/// A bound of a figure: "bearings.main.h_min > 1.5 um".
struct StudyConstraint {
  std::string text;  ///< as written
  std::string name;
  bool is_lower = false;  ///< the figure is to lie above
  std::string bound;      ///< "1.5 um"
  SourcePosition position;
};

struct StudyOutput {
  std::string name;
  SourcePosition position;
};

struct Study {
  std::vector<StudyParameter> parameters;  ///< with variants, the last is called `variant`, its values their names
  std::vector<StudyFigure> figures;
  SourcePosition position;
  StudyPlan plan = StudyPlan::full_factorial;
  int samples = 128;
  int seed = 1;
  std::vector<StudyOutput> outputs;
  std::vector<StudyObjective> objectives;
  std::vector<StudyConstraint> constraints;
  StudySearch search = StudySearch::local;
  StudyAnalysis analysis = StudyAnalysis::as_model;
  StudyKeep keep = StudyKeep::results;
  StudyDiagram diagram = StudyDiagram::none;
  std::string spectrum_of;  ///< a series of results; empty: none

  /// True if its runs are listed: every combination of values, or values side by side.
  [[nodiscard]] bool is_written_out() const;
};

}  // namespace hersey::model
