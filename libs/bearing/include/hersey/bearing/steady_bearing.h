#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "hersey/bearing/global_heat.h"
#include "hersey/bearing/surface_flexibility.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/observables.h"

namespace hersey::bearing {

/// What acts on a bearing by itself. Bearing axes rest; angles count from x towards y.
struct OperatingPoint {
  double journal_speed = 0;  ///< angular velocity of the journal about z [rad/s]
  double shell_speed = 0;    ///< angular velocity of the shell about z [rad/s]
  /// On the journal [N], not zero, in the bearing's axes while nothing deforms; without it the position is given.
  std::optional<Eigen::Vector2d> load;
  Eigen::Vector2d e = Eigen::Vector2d::Zero();       ///< position of the journal, where no load is given [m]
  Eigen::Vector2d e_rate = Eigen::Vector2d::Zero();  ///< velocity of the journal's centre [m/s]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();    ///< slope of the journal's axis while nothing deforms [-]
  double journal_angle = 0;                          ///< by which the journal, with its holes, stands turned [rad]

  /// Sum of both speeds, which drags the oil [rad/s].
  [[nodiscard]] double entraining_speed() const { return journal_speed + shell_speed; }
  /// What the film's fill scales with: the entraining speed, or where the journal is pressed outwards twice the speed
  /// of the eccentricity ratio, if that is more (in Reynolds' equation it counts so) [rad/s].
  [[nodiscard]] double film_speed(double c) const {
    return std::max(std::abs(entraining_speed()), 2 * e_rate.norm() / c);
  }
};

struct SteadyOptions {
  double rtol = 1e-10;      ///< on the film's relative residual, and on force over load, > 0
  int max_iterations = 40;  ///< of one Newton iteration on film and position
  int max_linearisations =
      1000;  ///< of the film on paths from the start; the search from inside out adds 0.6 of it; > 0
  /// Of the film; `sor` solves it anew at every position. Between surfaces that deform always `newton`.
  film::FilmSolver solver = film::FilmSolver::newton;
  std::shared_ptr<const SteadyElasticity> elasticity = {};  ///< of the surfaces; null: both rigid
  std::optional<film::ThermalModel> thermal = {};  ///< of a film with temperatures; unset: one temperature, the model's
  std::optional<Eigen::Vector2d> start;    ///< where the search begins [m]; unset: where Ocvirk's short bearing lies
  Eigen::VectorXd start_film = {};         ///< the film's unknowns there; empty: none known
  std::optional<film::HeatState> start_heat = {};  ///< temperatures there; unset: those of the supply
  Eigen::VectorXd start_deformation = {};  ///< amplitudes of the surfaces' bodies there; empty: none known
};

struct SteadySummary {
  bool converged = false;
  int iterations = 0;       ///< linearisations of the film on the way
  int film_iterations = 0;  ///< SOR sweeps or multigrid cycles of film solves on the way
  int heat_iterations = 0;  ///< of film and temperature in turn
  double force_error = 0;   ///< |force - load| / |load|; 0 where the position is given
  std::string message;      ///< why there is no answer; also a remark on the answer, such as a film without oil
};

/// Force of the film on the shell, Q = (F_x, F_y, M_y, -M_x), against position s = (e_x, e_y, t_x, t_y) of the journal:
/// stiffness dQ/ds, damping dQ/ds' (theory manual, chapter bearing). Moments about the bearing's origin are those that
/// work on the tilt. Units N/m, N (s) for the force rows against e and t; N and N m against e and t in the moment rows.
struct DynamicCoefficients {
  Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d damping = Eigen::Matrix4d::Zero();
};

/// Temperatures of a solved operating point.
struct SteadyHeat {
  film::HeatState state;
  film::HeatObservables seen;
  film::TemperatureFields fields;
};

/// A solved operating point.
struct SteadyState {
  OperatingPoint point;
  Eigen::Vector2d e = Eigen::Vector2d::Zero();     ///< position of the journal [m]
  Eigen::Vector2d load = Eigen::Vector2d::Zero();  ///< that the film carries: its force on the shell [N]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< slope of the journal's axis, both frames turned by the load [-]
  double turn = 0;    ///< of the shell's frame, whose axes all of this is in, about z under the load [rad]
  Eigen::VectorXd u;  ///< the film's unknowns
  Eigen::VectorXd s;  ///< amplitudes of the shapes of both surfaces' bodies, shell first; empty: both rigid
  Eigen::VectorXd d_shell, d_journal;  ///< radial displacement at the nodes, away from the axis [m]; empty where rigid
  film::FilmObservables film;
  DynamicCoefficients coefficients;  ///< with the temperatures, and so the viscosities, as they are
  std::optional<SteadyHeat> heat;    ///< of a film with temperatures
  std::optional<EffectiveTemperature> effective;  ///< of a film with one, by a balance of heat
};

/// The same film with its fill fraction scaled for the speed of the point, which keeps the search short down to the
/// slowest (film.6).
[[nodiscard]] film::FilmModel scaled_for(film::FilmModel model, const OperatingPoint& point);

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

/// The same with one temperature of the oil, at which heat is in balance (theory manual, thermal.18). @param model  its
/// oil is left at that temperature
[[nodiscard]] SteadySummary solve_global(film::FilmModel& model, const OperatingPoint& point, const GlobalHeat& heat,
                                         const SteadyOptions& options, SteadyState& state);

/// Surfaces of the film with the journal at `e`.
[[nodiscard]] film::SurfaceMotion steady_surfaces(const film::FilmModel& model, const OperatingPoint& point,
                                                  const Eigen::Vector2d& e);

/// Where Ocvirk's short bearing (half film) of the same size carries the load of `point` [m].
[[nodiscard]] Eigen::Vector2d ocvirk_position(const film::FilmModel& model, const OperatingPoint& point);

/// Fields of a film found, with the depth of its features.
[[nodiscard]] film::FilmFields steady_fields(const film::FilmModel& model, const SteadyState& state);

}  // namespace hersey::bearing
