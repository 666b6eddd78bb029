#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hersey/model/study.h"
#include "hersey/study/bearing_solution.h"
#include "hersey/study/model_reader.h"

namespace hersey::study {

struct BearingStudyOptions {
  std::string bearing;     ///< empty: the only one of the model
  bool grid_error = true;  ///< solve on coarser grids too
  /// treatment of temperatures in stiffness, damping and stability; unused if the oil has one given temperature
  ThermalCoefficients thermal_coefficients = ThermalCoefficients::frozen;
  /// false: stiffness and damping are those of the present grid, not their mean over the possible positions of its
  /// lines (bearing.38). They jump by some percent as the grid or the load changes, and take a third of the time.
  bool phase_averages = true;
  const BearingSolution* nearby = nullptr;  ///< a solution of a similar bearing to start from; null: a cold start
  int threads = 0;                          ///< solutions at the same time; 0: one per core
  const model::Model* first = nullptr;      ///< the model of the first run where it has been read already
  /// If it is set, no further run is begun and those under way are ended; null if there is no stop.
  const std::atomic<bool>* stop = nullptr;
};

/// The bearing of `model` called `name`, or its only one. A bearing of several films is called by its own name, and so
/// are its films.
/// @throws InputError for a name that is not there or ambiguous.
[[nodiscard]] const model::Bearing& bearing_called(const model::Model& model, const std::string& name);

/// Fields of the film of a solution, at the nodes of the grid of its model.
[[nodiscard]] film::FilmFields fields_of(const BearingSolution& solution);

/// @throws InputError if the bearing has none.
[[nodiscard]] bearing::OperatingPoint operating_point_of(const model::Bearing& bearing);

/// @throws InputError where temperatures that follow the motion are not to be had of this bearing's coefficients.
void require_coefficients(const model::Bearing& bearing, ThermalCoefficients coefficients);

/// Solves the bearing of the model that `read` returns for every run of `runs`, several at a time. A run that fails is
/// repeated from the solution of a neighbour, a run that differs in one value only; a run without a solution does not
/// stop the others. Runs that had not begun at a stop have the message kNotBegun.
[[nodiscard]] std::vector<BearingSolution> solve_bearings(const ModelReader& read,
                                                          const std::vector<model::StudyRun>& runs,
                                                          const BearingStudyOptions& options);
/// Solves the runs of the model file at `path`.
[[nodiscard]] std::vector<BearingSolution> solve_bearings(const std::string& path,
                                                          const std::vector<model::StudyRun>& runs,
                                                          const BearingStudyOptions& options);

/// Message of a run that a stop kept from beginning.
inline constexpr const char* kNotBegun = "stopped before it was begun";

class KnownBodies;

/// Solves bearings one after another, in the order of the calls. Compliance and heat conduction of bodies are computed
/// once for all solutions that leave them unchanged.
/// @verified_by bearing_study_test.cpp
class BearingSolver {
 public:
  /// Starts without any known bodies.
  BearingSolver();
  /// Solves the bearing of `model` that `options` name; `options.threads` and `options.first` are ignored. May be
  /// called from several threads at once. Where `options.nearby` leads to no solution it starts anew.
  /// @returns a solution, or the reason why there is none.
  /// @throws InputError if the model gives no operating point, or one that cannot be solved.
  [[nodiscard]] BearingSolution solve(const model::Model& model, const BearingStudyOptions& options) const;

 private:
  std::shared_ptr<KnownBodies> bodies_;
};

/// Solves a model's bearings for one run after the other, and keeps the results that take long: the bodies of meshes. A
/// run that has no solution from a cold start is repeated from that of the unchanged model.
class RunSolver {
 public:
  /// @param given  overrides of the unchanged model
  RunSolver(std::string path, std::vector<std::string> given);
  RunSolver(const RunSolver&) = delete;
  RunSolver& operator=(const RunSolver&) = delete;
  ~RunSolver();

  /// Each bearing of `bearings`, or where that is empty each with an operating point. @throws InputError
  [[nodiscard]] std::vector<std::pair<std::string, BearingSolution>> solve(const model::StudyRun& run,
                                                                           const std::vector<std::string>& bearings);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "load=100N:2500N:10", "journal_speed=1rpm:1000rpm:7:log" or "load=100N,200N,500N" as a study's parameter with its
/// values written out. @throws InputError for any other text.
[[nodiscard]] model::StudyParameter parse_sweep(const std::string& text);

/// One reported figure in the unit people use.
struct BearingFigure {
  std::string key;      ///< "h_min"
  std::string name;     ///< "angle of the minimum film thickness"
  std::string label;    ///< its name below the one before it in a table: "  at the angle"; mostly the same
  std::string unit;     ///< "um"; empty for a bare number
  std::string si_unit;  ///< "m"
  double si = 1;        ///< value of one `unit` in SI: 1e-6
  double value = 0;
  double grid_error = -1;  ///< estimated error of the grid; negative: none estimated
  std::string words;       ///< said in place of a value that is no number, "stable at every mass"; else empty
  std::string group;       ///< "film": figures of one kind stand together
};

/// Kind of the bearing of a solution, as in the model file; empty where it is not solved.
[[nodiscard]] std::string kind_of(const BearingSolution& solution);

/// Every figure of a solution, always the same ones in the same order.
[[nodiscard]] std::vector<BearingFigure> figures_of(const BearingSolution& solution);

/// Keys that figures may have; <...> stands for a name.
/// @param kind  of the bearing; empty: keys of all kinds
[[nodiscard]] std::vector<std::string> figure_keys(const std::string& kind = "");

}  // namespace hersey::study
