#pragma once

#include <Eigen/Dense>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/core/spatial.h"
#include "hersey/model/model.h"
#include "hersey/solver/linearise.h"

/// Rotors: shafts that spin on their bearings while their axes keep still, and small motions of these axes (theory
/// manual, chapter rotors).
namespace hersey::run {

/// A point of a shaft's axis, where its motion is looked at.
struct RotorStation {
  std::string name;  ///< of a body or a frame
  double along = 0;  ///< position along the axis [m]
  int sense = 1;     ///< of its own shaft, 1: rotates from x to y, -1: from y to x
  /// Displacement across the axis by the free coordinates, shape (2, free).
  Eigen::MatrixXd across;
  /// Displacement along the axis and rotation about it likewise, shape (2, free).
  Eigen::MatrixXd along_and_about;
};

/// What carries a shaft: a force between a body that spins and one that does not, linear in their small motion.
struct RotorBearing {
  std::string name;
  std::size_t station = 0;                          ///< index of the shaft's point among the stations
  Eigen::Matrix2d stiffness, damping, inertia;      ///< across the axis, [N/m], [N s/m], [kg]
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< on the shaft in steady motion, across the axis [N]
  /// Wrenches in the small motion, all of them by relative twists and their rates.
  Matrix6 K = Matrix6::Zero(), C = Matrix6::Zero(), M = Matrix6::Zero();
  Eigen::MatrixXd twist;               ///< of the shaft against the housing by the free coordinates, shape (6, free)
  Eigen::Matrix<double, 2, 3> across;  ///< directions across the axis in the housing's axes
};

/// A machine with a shaft in steady motion, and the equations of its small motions y,
///
///     M y'' + C y' + K y = f exp(i omega t),
///
/// in coordinates that do not rotate. The directions across the axis are x and y of the ground where it is the z-axis
/// (else the next two axes in cyclic order).
struct [[nodiscard]] RotorState : Outcome {
  double speed = 0;        ///< of the fastest shaft, its magnitude [rad/s]; of two alike that which a drive rotates
  int sense = 1;           ///< of the same, 1: rotates from x to y, -1: from y to x
  bool is_geared = false;  ///< teeth couple torsion with motions of the axis
  Vector3 axis = Vector3::UnitZ();
  std::string x_name = "x", y_name = "y";  ///< directions across the axis
  Eigen::MatrixXd M, C, K;                 ///< shape (free, free)
  std::vector<RotorStation> stations;      ///< along the axis; those named come first
  std::vector<RotorBearing> bearings;
  /// f of all unbalances of the model, shape (free); zero without any. At the time 0 the x-axis of the first body of
  /// the shaft with the unbalance, a mark at phase zero, passes the direction x.
  Eigen::VectorXcd unbalance;
  int unbalances = 0;
  std::string warning;                        ///< gear meshes that pull where teeth would part; empty without
  std::map<std::string, std::size_t> places;  ///< index of the station of each name; two frames may have one
};

/// Finds the steady motion of the shaft of `model`, whose drives keep their speeds, and linearises about it.
/// Unbalances are left out of the steady motion.
/// @param stations  frames whose motion is wanted, `body` or `body.frame`, on the axis of the shaft
/// @throws InputError if the model cannot start or has no shaft that is alike at every angle
[[nodiscard]] RotorState find_rotor_state(const model::Model& model, const std::vector<std::string>& stations);

/// Motion of a point of the axis, Re(x exp(i omega t)), Re(y exp(i omega t)).
struct Orbit {
  std::complex<double> x, y;

  [[nodiscard]] std::complex<double> forward(int sense) const;   ///< radius of the circle in the sense of the shaft
  [[nodiscard]] std::complex<double> backward(int sense) const;  ///< radius of the circle against it
  [[nodiscard]] double major() const;                            ///< half of the longest diameter
  [[nodiscard]] double minor(int sense) const;                   ///< of the shortest; negative: runs backward
};

/// How the motion of a shaft's axis circles.
enum class Whirl {
  forward,    ///< everywhere with the shaft
  backward,   ///< everywhere against it
  mixed,      ///< with it at some points, against it at others
  planar,     ///< to and fro
  none,       ///< the axis does not move: torsion, motion along the axis, or of other bodies
  diverging,  ///< it leaves its place without circling
};

/// A mode of a rotor.
struct WhirlMode {
  solver::Mode mode;  ///< `shape` in the free coordinates
  Whirl whirl = Whirl::none;
  double log_decrement = 0;   ///< 2 pi zeta/sqrt(1 - zeta^2); negative: the motion grows, -infinity: it diverges
  std::vector<Orbit> orbits;  ///< of each station, the largest axis 1
};

/// Modes that oscillate, and motions of the axis that grow without, by ascending damped frequency. @cost O(free^3)
[[nodiscard]] std::vector<WhirlMode> whirl_modes(const RotorState& rotor);

/// A cross-coupled stiffness at a station: Q from y to x and -Q from x to y [N/m], which drives forward whirl.
struct CrossCoupling {
  std::size_t station = 0;
  double Q = 0;
};

/// The same with a cross-coupled stiffness added.
[[nodiscard]] RotorState with_cross_coupling(RotorState rotor, const CrossCoupling& coupling);

/// Answer to the unbalances of the model.
struct UnbalanceResponse {
  std::vector<Orbit> stations;  ///< displacements [m]
  std::vector<Orbit> bearings;  ///< forces on the shaft [N], beside those of the steady motion
};

/// Theory manual eq. (rotors.11). @cost O(free^3)
[[nodiscard]] UnbalanceResponse unbalance_response(const RotorState& rotor);

/// An undamped critical speed.
struct CriticalSpeed {
  double speed = 0;  ///< [rad/s]
  Whirl whirl = Whirl::forward;
};

/// Speeds at which the undamped rotor, its bearings replaced by springs alike in all directions across the axis, whirls
/// once a revolution: theory manual eq. (rotors.12). Ascending; those that move the axis. @param stiffness  of each
/// bearing [N/m]
[[nodiscard]] std::vector<CriticalSpeed> undamped_critical_speeds(const RotorState& rotor, double stiffness);

}  // namespace hersey::run
