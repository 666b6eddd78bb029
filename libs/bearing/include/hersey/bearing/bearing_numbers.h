#pragma once

#include <Eigen/Dense>

#include "hersey/bearing/steady_bearing.h"

namespace hersey::bearing {

/// Figures by which bearings are compared, at a solved operating point (theory manual, chapter bearing).
struct BearingNumbers {
  double load = 0;        ///< |W| that the film carries [N]
  double load_angle = 0;  ///< direction of the load on the journal, from x towards y [rad]
  double eccentricity_ratio = 0;
  double eccentricity_angle = 0;  ///< direction of the journal's position, from x towards y [rad]
  double attitude = 0;            ///< from the load to the position, in the sense of rotation, in (-pi, pi] [rad]
  double sommerfeld_S = 0;        ///< mu0 N (R/c)^2 L D/W, N = |omega_J + omega_S|/(2 pi)
  double sommerfeld_So = 0;       ///< W/(L D) (c/R)^2/(mu0 |omega_J + omega_S|)
  double radial_velocity = 0;     ///< of the journal's centre along its eccentricity [m/s]
  double sommerfeld_squeeze = 0;  ///< W/(L D) (c/R)^2/(mu0 |radial velocity|/c); 0 without one
  double hersey = 0;              ///< mu0 N L D/W
  double friction_journal = 0;    ///< |torque on the journal|/(R W)
  double friction_shell = 0;      ///< |torque on the shell|/(R W)
  double asperity_share = 0;      ///< fraction of the load borne by asperities
  double film_ratio = 0;          ///< h_min/sigma; 0 for smooth surfaces
};

/// Of a state that was solved for `model`. @pre its load is not zero
[[nodiscard]] BearingNumbers bearing_numbers(const film::FilmModel& model, const SteadyState& state);

/// Coefficients of the force against the position alone, x along the load and y a quarter turn on in the sense of
/// rotation, made dimensionless (bearing.22): K = k c/W, C = b c omega/W with omega = |omega_J + omega_S|.
struct LoadAxesCoefficients {
  Eigen::Matrix2d K = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d C = Eigen::Matrix2d::Zero();
};

/// Of a state that was solved for `model`. @pre its load is not zero
[[nodiscard]] LoadAxesCoefficients in_load_axes(const film::FilmModel& model, const SteadyState& state);

/// Stability of a rigid rotor on this film against whirl, linear about the equilibrium (Lund and Thomsen 1978): where
/// (bearing.31) has a root without damping, (bearing.33).
struct WhirlStability {
  bool always_stable = false;   ///< no mass makes it whirl; then the numbers below are infinite
  bool never_stable = false;    ///< no mass is small enough: the film does not centre the journal
  double critical_mass = 0;     ///< largest stable rotor mass on this bearing [kg]
  double whirl_ratio = 0;       ///< whirl frequency at the threshold over omega
  double stability_number = 0;  ///< omega sqrt(c m/W) of the critical mass; with m = W/g: omega sqrt(c/g)
  double threshold_speed = 0;   ///< omega at which a rotor of the load's own weight (g = 9.80665) begins to whirl, with
                                ///< these coefficients [rad/s]
};

/// @param omega  speed that made the coefficients dimensionless [rad/s]; at 0 nothing drives a whirl: stable.
[[nodiscard]] WhirlStability whirl_stability(const LoadAxesCoefficients& coefficients, double c, double W,
                                             double omega);

/// Estimated errors of the grid, one standard figure each (bearing.34); negative: there is none to be had.
struct GridError {
  bool known = false;  ///< the coarser grids were fine enough to be solved
  double h_min = 0, p_max = 0, eccentricity_ratio = 0, attitude = 0, load = 0, friction_journal = 0, side_flow = 0;
  double torque_journal = 0, torque_shell = 0, power_film = 0;
  double T_max = 0, T_shell_max = 0, T_shell_mean = 0, T_journal = 0, T_film = 0, T_side = 0;  ///< of films with heat
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero(), damping = Eigen::Matrix2d::Zero();  ///< in the bearing's axes
  LoadAxesCoefficients in_load_axes;
};

/// Solves the same operating point on grids of half and a quarter of the nodes and extrapolates.
[[nodiscard]] GridError estimate_grid_error(const film::FilmModel& model, const SteadyState& state,
                                            const SteadyOptions& options);

}  // namespace hersey::bearing
