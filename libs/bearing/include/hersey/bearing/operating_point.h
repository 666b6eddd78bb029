#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/coordinates.h"
#include "hersey/bearing/surface_flexibility.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/film_model.h"
#include "hersey/film/thermal_network.h"

namespace hersey::bearing {

class BearingKind;

/// Conditions of a bearing by itself, in the coordinates of its kind. Bearing axes rest; angles count from x towards y.
/// Words and sizes below are those of a journal, position and force (x, y).
struct OperatingPoint {
  double journal_speed = 0;  ///< angular velocity of the journal about z [rad/s]
  double shell_speed = 0;    ///< angular velocity of the shell about z [rad/s]
  /// On the journal [N], not zero, in the bearing's axes while nothing deforms; without it the position is given.
  std::optional<Coordinates> load;
  Coordinates e = Eigen::Vector2d::Zero();              ///< position of the journal, where no load is given [m]
  Coordinates e_rate = Eigen::Vector2d::Zero();         ///< velocity of the journal's centre [m/s]
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();       ///< slope of the journal's axis while nothing deforms [-]
  Eigen::Vector2d tilt_rate = Eigen::Vector2d::Zero();  ///< at which it changes [1/s]
  double journal_angle = 0;                             ///< by which the journal, with its holes, stands turned [rad]
  double growth = 0;  ///< of the radial clearance with the temperatures of its walls [m]
  /// Angular velocity at which the position `e` goes around the shell's axis (damper.4) [rad/s]. The axes of position
  /// and film then rotate with it, in which the film is steady. Only between surfaces that are the same all around.
  double whirl_speed = 0;

  /// Sum of both speeds in the axes of the film, which drags the oil [rad/s].
  [[nodiscard]] double entraining_speed() const { return journal_speed + shell_speed - 2 * whirl_speed; }
  /// Speed by which the fill fraction is scaled: the entraining speed, or twice the speed of the eccentricity ratio if
  /// that is larger, in the middle or by the tilt at the ends of a width L, as it counts in Reynolds' equation [rad/s].
  [[nodiscard]] double film_speed(double c, double L) const {
    return std::max(std::abs(entraining_speed()), 2 * std::max(e_rate.norm(), 0.5 * L * tilt_rate.norm()) / c);
  }
};

/// The radial clearance that is there, at the temperatures of its walls [m].
[[nodiscard]] inline double clearance(const film::FilmModel& model, const OperatingPoint& point) {
  return clearance(model, point.growth);
}

/// Returns the point with another growth of the clearance; a position that is given keeps its eccentricity ratio.
[[nodiscard]] OperatingPoint with_growth(OperatingPoint point, const film::FilmModel& model, double growth);

struct SteadyOptions {
  std::shared_ptr<const BearingKind> kind = {};  ///< null: a journal in a bore
  double rtol = 1e-10;                           ///< on the film's relative residual, and on force over load, > 0
  int max_iterations = 40;                       ///< of one Newton iteration on film and position
  int max_linearisations =
      1000;  ///< of the film on paths from the start; the search from inside out adds 0.6 of it; > 0
  /// Of the film; `sor` solves it anew at every position. Between surfaces that deform always `newton`.
  film::FilmSolver solver = film::FilmSolver::newton;
  std::shared_ptr<const SteadyElasticity> elasticity = {};  ///< of the surfaces; null: both rigid
  /// Momentum factor of the oil's inertia in DynamicCoefficients::inertia (damper.7); 0: none [-].
  double inertia_factor = 0;
  std::optional<film::ThermalModel> thermal = {};  ///< of a film with temperatures; unset: one temperature, the model's
  std::optional<film::ThermalNetworkModel> network = {};  ///< of walls that are nodes; in balance with this film alone
  std::optional<Coordinates> start;  ///< where the search begins [m]; unset: where the kind's own estimate lies
  Eigen::VectorXd start_film = {};   ///< the film's unknowns there; empty: none known
  std::optional<film::HeatState> start_heat = {};  ///< temperatures there; unset: those of the supply
  Eigen::VectorXd start_deformation = {};          ///< amplitudes of the surfaces' bodies there; empty: none known
};

/// Returns the film with its fill fraction scaled for the speed of the point, which keeps the search short down to the
/// slowest speeds (film.6).
[[nodiscard]] film::FilmModel scaled_for(film::FilmModel model, const OperatingPoint& point);

}  // namespace hersey::bearing
