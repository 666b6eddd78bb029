#pragma once

#include <Eigen/Dense>

#include "hersey/core/spatial.h"

/// What a film answers to its surfaces: directions in which these move, forces, oil.
namespace hersey::film {

/// A one-parameter change of the surfaces or of the pressures at the film's ports, the features that feed it; the
/// film's derivative along it is a column.
struct MotionDirection {
  Eigen::VectorXd g;       ///< d gap / d parameter at the nodes; empty means zero
  Eigen::VectorXd g_rate;  ///< d gap rate / d parameter; empty means zero
  double u_shell = 0, u_journal = 0, w_shell = 0, w_journal = 0, phi_supply = 0, phi_journal = 0;
  double shell_fraction = 0;  ///< of `g`, which opens the gap by the shell's surface; the rest by the journal's [-]
  Eigen::VectorXd port_pressure = {};  ///< d SurfaceMotion::feature_pressure / d parameter; empty means zero
};

/// Forces that push the surfaces apart at the nodes, film and asperities together: pressure times the node's area,
/// shape (n) each.
struct NormalForces {
  Eigen::VectorXd value;       ///< [N]
  Eigen::VectorXd by_u, by_g;  ///< derivatives by the node's unknown [m^2] and gap [N/m]
};

/// How far a film is from balance at the state last evaluated.
struct FilmResidual {
  const Eigen::VectorXd& value;  ///< [m^3/s], shape (n)
  double relative;               ///< max |value| / largest throughput of a control volume
  int worst_node;                ///< where |value| is largest
};

/// Forces of a film at the state last evaluated, and their derivatives at the state last linearised.
struct FilmForces {
  /// Of pressure, shear and asperities, at the grid frame's origin; on the journal acts its negative at the same point:
  /// action equals reaction, moment included.
  const Vector6& wrench_on_shell;
  const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrench_by_u;  ///< its derivative by u at fixed surfaces
  const NormalForces& normal;
};

/// The oil of one step: flows as means over it, with which what is in the film at its end is what was there at its
/// start and what has come in since, to round-off (theory manual, film.15). Volumes are masses over rho0.
struct StepOilBalance {
  Eigen::VectorXd content;  ///< oil in each control volume over the volume itself, rho theta [-], shape (n)
  Eigen::VectorXd gap;      ///< that volume per area, without pockets [m], shape (n)
  double volume = 0;  ///< in the film, every control volume counted as no emptier than empty, no fuller than full [m^3]
  double flow_left = 0, flow_right = 0;  ///< out over the edges z = -L/2, +L/2 [m^3/s]
  double flow_first = 0, flow_last = 0;  ///< out over the first and the last ends of patches [m^3/s]
  [[nodiscard]] double flow_ends() const { return flow_first + flow_last; }               ///< [m^3/s]
  [[nodiscard]] double flow_out() const { return flow_left + flow_right + flow_ends(); }  ///< [m^3/s]
  double flow_supply = 0;         ///< in through line and features [m^3/s]
  Eigen::VectorXd flow_features;  ///< in through each feature [m^3/s]
  /// Largest volume of oil that a control volume had no room for, or lacked, over its own volume; it was redistributed
  /// downstream [-]; 1 where no control volume downstream could take it.
  double redistributed_overfill = 0;
};

/// Forces of a film whose unknowns are eliminated, and their derivatives along directions in which the surfaces move.
struct CondensedFilm {
  Vector6 wrench = Vector6::Zero();                      ///< on the shell
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrench_by_s;  ///< a column per direction
  Eigen::VectorXd Q;                                     ///< forces on shapes
  Eigen::MatrixXd Q_by_s;                                ///< (shapes, directions)
  Eigen::VectorXd port_flow;       ///< in through each feature, a port of the film [m^3/s]; empty unless asked for
  Eigen::MatrixXd port_flow_by_s;  ///< (features, directions)
};

}  // namespace hersey::film
