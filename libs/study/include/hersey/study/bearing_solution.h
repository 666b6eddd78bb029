#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/bearing/bearing_numbers.h"
#include "hersey/bearing/steady_surfaces.h"  // who shows a solution draws its surfaces
#include "hersey/model/study.h"

namespace hersey::study {

/// Treatment of temperatures while a bearing's journal moves about its position: frozen, or following the motion.
enum class ThermalCoefficients { frozen, total };

/// One pad of a solved bearing of tilting pads.
struct PadState {
  std::string name;        ///< its number, "1"
  double pivot_angle = 0;  ///< of its pivot, from the fixed surface's x-axis towards y [rad]
  /// Around a journal about the axis along the bearing, in the sense from x to y; below a collar the slope along the
  /// sense of rotation, positive: the gap is wider at the leading edge [rad].
  double tilt = 0;
  double tilt_across = 0;   ///< below a collar along the radius, positive: the gap is wider at the outer edge [rad]
  double pivot_travel = 0;  ///< of its pivot away from the film; 0 of a rigid one [m]
  bool is_aside = false;    ///< nothing balances it: it is fixed at a tilt at which it carries nothing
  double h_pivot = 0;       ///< film thickness at the pivot, around a journal at mid-width [m]
  double bending = 0;       ///< largest less least radial displacement of its face; 0 of a rigid pad [m]
  double T_max = 0;         ///< of its hottest oil [K]; 0: the films have one temperature
  double T_face_max = 0;    ///< of the hottest place on its face [K]; 0 likewise
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< around a journal: of the film on it, bearing axes [N]
};

/// One film of a solved floating ring.
struct RingFilmState {
  std::string name;                             ///< "inner" or "outer"
  Eigen::Vector2d e = Eigen::Vector2d::Zero();  ///< of what rotates in it, over what is around it, bearing axes [m]
  double clearance = 0;                         ///< radial [m]
  film::FilmObservables film;
  film::FilmModel model;
  film::FilmFields fields;  ///< at the nodes of the model's grid
};

/// The ring of a solved floating ring.
struct RingState {
  double speed = 0;                                   ///< [rad/s]
  Eigen::Vector2d journal = Eigen::Vector2d::Zero();  ///< of the journal's centre over the shell's [m]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();   ///< of the ring's centre over the shell's [m]
  std::vector<RingFilmState> films;                   ///< inner, outer
};

/// What a bearing of several parts, tilting pads or a floating ring, has beside its film.
struct PadBearingSolution {
  std::string kind = "tilting_pad";
  std::vector<PadState> pads;     ///< in the order of the film's arcs
  std::optional<RingState> ring;  ///< of a floating ring, whose film in the solution is the inner one
  film::FilmFields fields;        ///< of all pads, on the grid of the solution's model
  double whirl_ratio = 1;         ///< frequency over the journal's at which the parts follow in the coefficients
  /// Full coefficients, with the freedoms of the parts: names of the velocity components of the bearing by itself and
  /// the matrices over them; drives and joints allow no motion where rows and columns are zero.
  std::vector<std::string> coordinates;
  Eigen::MatrixXd stiffness, damping, mass;
};

/// Solution of a single bearing at one operating point, with its derived results. Unsolved, all but `run` is empty.
struct [[nodiscard]] BearingSolution : Outcome {
  model::StudyRun run;
  film::FilmModel model;
  std::optional<film::FilmSolver> solver = {};  ///< of its film; unset: of a bearing of several parts
  bool expands = false;                         ///< its clearance follows the temperatures of its walls
  std::vector<std::string> node_names;  ///< nodes of the thermal network to which its walls belong; empty if they
                                        ///< belong to none
  std::shared_ptr<const bearing::SteadyElasticity> elasticity;  ///< of the surfaces; null: both rigid
  bearing::SteadySummary summary;
  bearing::SteadyState state;
  bearing::BearingNumbers numbers;
  /// Coefficients of the force on the present grid, from differences of solutions nearby; `state` has their mean over
  /// the possible positions of the grid's lines (bearing.38).
  bearing::DynamicCoefficients tangent;
  bearing::LoadAxesCoefficients coefficients;
  bearing::WhirlStability whirl;
  double whirl_speed = 0;  ///< of a damper's orbit, or angular frequency of its small motions [rad/s]
  ThermalCoefficients thermal_coefficients = ThermalCoefficients::frozen;  ///< those of `state`
  bearing::GridError grid_error;
  std::shared_ptr<const PadBearingSolution> pads;  ///< of a bearing of several parts; else null
  std::vector<std::string> warnings;  ///< states in which the film exceeds the range for which its oil is known
  double wall_time = 0;               ///< grid error included [s]
  bool from_neighbour = false;        ///< found from a neighbour's solution after a cold start had failed

  /// True if its temperatures are part of the solution.
  [[nodiscard]] bool has_temperatures() const { return state.heat || state.effective; }
};

}  // namespace hersey::study
