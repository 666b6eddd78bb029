#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/bearing_numbers.h"
#include "hersey/model/study.h"

namespace hersey::study {

/// What temperatures do while a bearing's journal moves about its position.
enum class ThermalCoefficients { frozen, total };

/// A bearing by itself at one operating point, and all that is to be said about it.
/// Unsolved, all but `run` is empty.
struct [[nodiscard]] BearingSolution : Outcome {
  model::StudyRun run;
  film::FilmModel model;
  bool expands = false;                 ///< its clearance follows the temperatures of its walls
  std::vector<std::string> node_names;  ///< of the thermal network that its walls belong to; none: they belong to none
  std::shared_ptr<const bearing::SteadyElasticity> elasticity;  ///< of the surfaces; null: both rigid
  bearing::SteadySummary summary;
  bearing::SteadyState state;
  bearing::BearingNumbers numbers;
  /// Of the force on the grid as it lies, as differences of solutions nearby tell them; `state` has their mean over
  /// where the lines of the grid may lie (bearing.38).
  bearing::DynamicCoefficients tangent;
  bearing::LoadAxesCoefficients coefficients;
  bearing::WhirlStability whirl;
  ThermalCoefficients thermal_coefficients = ThermalCoefficients::frozen;  ///< those of `state`
  bearing::GridError grid_error;
  std::vector<std::string> warnings;  ///< where the film goes beyond what is known of its oil
  double wall_time = 0;               ///< grid error included [s]
  bool from_neighbour = false;        ///< found from a neighbour's solution after a cold start had failed

  /// Whether its temperatures have been solved for.
  [[nodiscard]] bool has_temperatures() const { return state.heat || state.effective; }
};

struct BearingStudyOptions {
  std::string bearing;     ///< empty: the only one of the model
  bool grid_error = true;  ///< solve on coarser grids too
  /// Of stiffness, damping and stability; without meaning where the oil has one temperature that is given.
  ThermalCoefficients thermal_coefficients = ThermalCoefficients::frozen;
  int threads = 0;                      ///< solutions at the same time; 0: one per core
  const model::Model* first = nullptr;  ///< the model of the first run where it has been read already
  /// Set meanwhile: no further run is begun, those under way are ended. Null: nobody stops it.
  const std::atomic<bool>* stop = nullptr;
};

/// The bearing of `model` called `name`, or its only one.
/// @throws InputError for a name that is not there or ambiguous.
[[nodiscard]] const model::Bearing& bearing_called(const model::Model& model, const std::string& name);

/// @throws InputError where the bearing has none.
[[nodiscard]] bearing::OperatingPoint operating_point_of(const model::Bearing& bearing);

/// @throws InputError where temperatures that follow the motion are not to be had of this bearing's coefficients.
void require_coefficients(const model::Bearing& bearing, ThermalCoefficients coefficients);

/// Gives the model with overrides in place, as model::read does; called from several threads at once.
using ModelReader = std::function<model::Model(const std::vector<std::string>& overrides)>;

/// Solves the bearing of the model that `read` gives at every run of `runs`, several at a time. One that fails is
/// tried again from the solution of a neighbour, a run that differs in one value only; one without any does not stop
/// the others. Runs that were not begun when it was stopped have the message kNotBegun.
[[nodiscard]] std::vector<BearingSolution> solve_bearings(const ModelReader& read,
                                                          const std::vector<model::StudyRun>& runs,
                                                          const BearingStudyOptions& options);
/// The same of the model file at `path`.
[[nodiscard]] std::vector<BearingSolution> solve_bearings(const std::string& path,
                                                          const std::vector<model::StudyRun>& runs,
                                                          const BearingStudyOptions& options);

/// Why a run has no solution that a stop has kept from being begun.
inline constexpr const char* kNotBegun = "stopped before it was begun";

class KnownBodies;

/// Solves bearings one after another, as a caller comes to them. How bodies give way and conduct heat is worked out
/// once for all solutions that leave them as they are.
/// @verified_by bearing_study_test.cpp
class BearingSolver {
 public:
  /// Knows no bodies yet.
  BearingSolver();
  /// The bearing of `model` that `options` name; `options.threads` and `options.first` are without meaning. May be
  /// called from several threads at once.
  /// @returns a solution, or why there is none.
  /// @throws InputError where the model gives no operating point, or one that cannot be solved.
  [[nodiscard]] BearingSolution solve(const model::Model& model, const BearingStudyOptions& options) const;

 private:
  std::shared_ptr<KnownBodies> bodies_;
};

/// Solves a model's bearings at one run after the other, and remembers what takes long: the bodies of meshes. A run
/// that has no solution from the start is tried again from that of the model as it stands.
class RunSolver {
 public:
  /// @param given  overrides of the model as it stands
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
  std::string name;     ///< "minimum film thickness"
  std::string unit;     ///< "um"; empty for a bare number
  std::string si_unit;  ///< "m"
  double si = 1;        ///< what one `unit` is in SI: 1e-6
  double value = 0;
  double grid_error = -1;  ///< estimated error of the grid; negative: none estimated
  std::string words;       ///< said in place of a value that is no number, "stable at every mass"; else empty
  std::string group;       ///< "film": figures of one kind stand together
};

/// Every figure of a solution, always the same ones in the same order.
[[nodiscard]] std::vector<BearingFigure> figures_of(const BearingSolution& solution);

/// Keys that figures may have; <...> stands for a name.
[[nodiscard]] std::vector<std::string> figure_keys();

}  // namespace hersey::study
