#pragma once

#include <Eigen/Dense>

#include "hersey/bearing/global_heat.h"
#include "hersey/bearing/operating_point.h"
#include "hersey/core/outcome.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/film_model.h"
#include "hersey/film/observables.h"

namespace hersey::bearing {

/// Unsolved, `message` tells why; solved, it may tell of a film without oil.
struct [[nodiscard]] SteadySummary : Outcome {
  int iterations = 0;       ///< linearisations of the film on the way
  int film_iterations = 0;  ///< SOR sweeps or multigrid cycles of film solves on the way
  int heat_iterations = 0;  ///< of film and temperature in turn
  double force_error = 0;   ///< |force - load| / |load|; 0 where the position is given
};

/// Force of the film on the shell, Q = (F_x, F_y, M_y, -M_x), against position s = (e_x, e_y, t_x, t_y) of the journal:
/// stiffness dQ/ds, damping dQ/ds' (theory manual, chapter bearing). Moments about the bearing's origin are those that
/// work on the tilt. Units N/m, N (s) for the force rows against e and t; N and N m against e and t in the moment rows.
struct DynamicCoefficients {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  Matrix stiffness = Eigen::Matrix4d::Zero();
  Matrix damping = Eigen::Matrix4d::Zero();
};

/// Temperatures of a solved operating point.
struct SteadyHeat {
  film::HeatState state;
  film::HeatObservables observed;
  film::TemperatureFields fields;
  Eigen::VectorXd T_body;          ///< of the body the shell is in, at the nodes of its mesh [K]; empty: it is in none
  Eigen::VectorXd T_journal_body;  ///< likewise of the journal's body [K]
  film::NetworkObservables network;  ///< of walls that are nodes; without nodes where none is
};

/// A solved operating point.
struct SteadyState {
  std::shared_ptr<const BearingKind> kind;         ///< never null once solved
  OperatingPoint point;                            ///< between walls as they have grown
  Coordinates e = Eigen::Vector2d::Zero();         ///< position of the moving surface [m]
  Coordinates load = Eigen::Vector2d::Zero();      ///< that the film carries: its force on the fixed surface [N]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< slope of the journal's axis, both frames turned by the load [-]
  double turn = 0;    ///< of the shell's frame, whose axes all of this is in, about z under the load [rad]
  Eigen::VectorXd u;  ///< the film's unknowns
  Eigen::VectorXd s;  ///< amplitudes of the shapes of both surfaces' bodies, shell first; empty: both rigid
  Eigen::VectorXd d_shell, d_journal;  ///< radial displacement at the nodes, away from the axis [m]; empty where rigid
  /// By how much the shell's body puts it further out at the nodes by its temperature [m]; empty: not at all.
  Eigen::VectorXd thermal_shape;
  /// And the journal's body the journal's surface, the mean around (thermal.61), at the nodes as well [m].
  Eigen::VectorXd journal_shape;
  film::FilmObservables film;
  film::LayeredViscosity viscosity;               ///< by the oil's temperatures; empty: that of the model everywhere
  DynamicCoefficients coefficients;               ///< with the temperatures, and so the viscosities, as they are
  std::optional<SteadyHeat> heat;                 ///< of a film with temperatures
  std::optional<EffectiveTemperature> effective;  ///< of a film with one, by a balance of heat
};

/// The position at which the film carries the load, or the film at a given position; surfaces that deform
/// (SteadyOptions::elasticity) in static equilibrium with it.
///
/// Newton on film and position together with exact derivatives, the film condensed; where that does not settle, the
/// load is raised from what the film carries at the start (bearing.19). A smooth rigid journal never leaves its bore
/// on the way.
/// @throws ContractError for a load of zero, speeds that drag no oil, a rigid journal placed outside its bore, or a
/// velocity of the journal, or a shell that turns, together with surfaces that deform.
[[nodiscard]] SteadySummary solve_steady(const film::FilmModel& model, const OperatingPoint& point,
                                         const SteadyOptions& options, SteadyState& state);

/// The same with one temperature of the oil, at which heat is in balance (theory manual, thermal.20). @param model  its
/// oil is left at that temperature
[[nodiscard]] SteadySummary solve_global(film::FilmModel& model, const OperatingPoint& point, const GlobalHeat& heat,
                                         const SteadyOptions& options, SteadyState& state);

/// Smallest gap between the rigid surfaces where a search may begin: at the position that is given, or where a kind's
/// surfaces are furthest apart [m].
[[nodiscard]] double gap_at_first(const film::FilmModel& model, const OperatingPoint& point,
                                  const SteadyOptions& options);

/// Fields of a film found, with the depth of its features.
[[nodiscard]] film::FilmFields steady_fields(const film::FilmModel& model, const SteadyState& state);

}  // namespace hersey::bearing
