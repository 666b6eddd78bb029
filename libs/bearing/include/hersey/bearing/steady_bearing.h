#pragma once

#include <Eigen/Dense>

#include "hersey/bearing/global_heat.h"
#include "hersey/bearing/operating_point.h"
#include "hersey/bearing/shapes_at_rest.h"
#include "hersey/core/outcome.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_work.h"
#include "hersey/film/observables.h"

namespace hersey::bearing {

/// Outcome of a solution. `message` gives the reason of a failure; after a success it is empty or warns of a film
/// without oil.
struct [[nodiscard]] SteadySummary : Outcome {
  int iterations = 0;       ///< linearisations of the film, over all paths
  int film_iterations = 0;  ///< SOR sweeps or multigrid cycles, over all paths
  int heat_iterations = 0;  ///< of the staggered iteration of film and temperature
  double force_error = 0;   ///< |force - load| / |load|; 0 where the position is given
  film::FilmWork work;      ///< of an isothermal film on its own grid, coefficients and grid error apart; else nothing
};

/// Derivatives of the film's force on the shell, Q = (F_x, F_y, M_y, -M_x), by the position x = (e_x, e_y, t_x, t_y) of
/// the journal and its rate: stiffness dQ/dx and damping dQ/dx' (theory manual, chapter bearing). Moments, about the
/// bearing's origin, are conjugate to the tilt. Units of stiffness: N/m (by e) and N (by t) in rows of forces, N and N
/// m in rows of moments; those of damping are times s. 4 x 4 of a journal, 3 x 3 of a plane slider.
/// `inertia` is dQ/dx'' by the inertia of the oil, the added mass of a small motion (damper.8); empty where that is not
/// asked for.
struct DynamicCoefficients {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  Matrix stiffness = Eigen::Matrix4d::Zero();
  Matrix damping = Eigen::Matrix4d::Zero();
  Matrix inertia = {};
};

/// Temperatures of a solved operating point.
struct SteadyHeat {
  film::HeatState state;
  film::HeatObservables observed;
  film::TemperatureFields fields;
  Eigen::VectorXd T_body;            ///< of the shell's body, at the nodes of its mesh [K]; empty: it has no mesh
  Eigen::VectorXd T_journal_body;    ///< the same of the journal's body [K]
  film::NetworkObservables network;  ///< of walls that are nodes of a thermal network; empty without one
};

/// A solved operating point. The moving surface is the journal or the runner, the fixed one the shell or the pad.
struct SteadyState {
  std::shared_ptr<const BearingKind> kind;         ///< never null once solved
  OperatingPoint point;                            ///< with the clearance after thermal growth
  Coordinates e = Eigen::Vector2d::Zero();         ///< position of the moving surface [m]
  Coordinates load = Eigen::Vector2d::Zero();      ///< carried by the film: its force on the fixed surface [N]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< slope of the journal's axis against the shell's under load [-]
  /// Elastic rotation of the shell's frame about z under load; all vectors of this struct are in the rotated axes
  /// [rad].
  double turn = 0;
  Eigen::VectorXd u;  ///< the film's unknowns
  Eigen::VectorXd s;  ///< amplitudes of the shapes of both surfaces' bodies, shell first; empty: both rigid
  Eigen::VectorXd d_shell, d_journal;  ///< radial displacement at the nodes, away from the axis [m]; empty where rigid
  ShapesAtRest shapes;                 ///< of both surfaces beside that deformation, at the nodes
  film::FilmObservables film;
  film::LayeredViscosity viscosity;               ///< at the film's temperatures; empty: the model's everywhere
  DynamicCoefficients coefficients;               ///< at fixed temperatures and viscosities
  std::optional<SteadyHeat> heat;                 ///< unset: the film is isothermal
  std::optional<EffectiveTemperature> effective;  ///< of an isothermal film by a balance of heat
};

/// Finds the position at which the film carries the load, or solves the film at a given position; surfaces that deform
/// (SteadyOptions::elasticity) are in static equilibrium with it.
///
/// Newton's method on film and position together with exact derivatives, the film condensed; if it does not converge,
/// the load is raised from what the film carries at the start (bearing.19). No iterate puts a smooth rigid journal
/// outside its bore.
/// @throws ContractError for a load of zero, speeds that drag no oil, a rigid journal placed outside its bore, or a
/// velocity of the journal, or a shell that turns, together with surfaces that deform.
[[nodiscard]] SteadySummary solve_steady(const film::FilmModel& model, const OperatingPoint& point,
                                         const SteadyOptions& options, SteadyState& state);

/// Does the same with one effective temperature of the oil, at which the heat of the whole film is in balance (theory
/// manual, thermal.20).
/// @param model  on return its lubricant has that temperature
[[nodiscard]] SteadySummary solve_global(film::FilmModel& model, const OperatingPoint& point, const GlobalHeat& heat,
                                         const SteadyOptions& options, SteadyState& state);

/// Returns the smallest gap between the undeformed surfaces at the start of a search: at the position that is given, or
/// where the surfaces of the kind are furthest apart [m].
[[nodiscard]] double initial_gap(const film::FilmModel& model, const OperatingPoint& point,
                                 const SteadyOptions& options);

/// Returns the fields of a solved film, with the depth of its features.
[[nodiscard]] film::FilmFields steady_fields(const film::FilmModel& model, const SteadyState& state);

}  // namespace hersey::bearing
