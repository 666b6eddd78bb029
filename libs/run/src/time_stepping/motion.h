#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/mbd/mechanism.h"

namespace hersey::run {

/// Motion of a machine at one instant of its period: all that the next period depends on, apart from the time and from
/// drives and forces of joints that follow it.
struct Motion {
  Eigen::VectorXd q;        ///< positions
  Archive::Content memory;  ///< velocities and accelerations, films, contacts, elastic bodies, temperatures
  /// Angles of joints that swing, Swing::swinging(), whose whole revolutions count; those of all others do not.
  std::vector<mbd::Mechanism::Index> swinging = {};
};

/// Combines motions at the same instant of different periods (theory manual, integrator.44). What cannot be combined,
/// marks and counts, is that of the first.
/// @param weights  of each, their sum is 1
[[nodiscard]] Motion combine(const mbd::Mechanism& mechanism, const std::vector<Motion>& motions,
                             const Eigen::VectorXd& weights);

/// Sizes with which positions and velocities of a motion are compared: how far they go in a period.
class Swing {
 public:
  /// @param period  [s], > 0
  Swing(const mbd::Mechanism& mechanism, double period);
  /// Begins with the state at the start of a period.
  void begin(const solver::State& state);
  /// Takes another one.
  void take(const solver::State& state);
  /// Returns that of all positions, then of all velocities, each at least a share of the machine's size: shape (2 nv).
  /// Infinite for angles that go round, because a ring may have any when its period ends, and for velocities that
  /// drives prescribe.
  [[nodiscard]] Eigen::VectorXd sizes() const;
  /// How far positions went: shape (nv). 0 for angles that go round, and for what stands still, which is at most a
  /// ten-millionth of the machine's size.
  [[nodiscard]] Eigen::VectorXd ways() const;
  /// Angles of joints that do not go round, ascending; none before the first state.
  [[nodiscard]] std::vector<mbd::Mechanism::Index> swinging() const;
  /// True if nothing oscillates.
  [[nodiscard]] bool is_rest() const;

 private:
  [[nodiscard]] bool goes_round(Eigen::Index i) const;

  const mbd::Mechanism& mechanism_;
  double period_;
  Eigen::VectorXd last_, way_;  ///< positions at the last state, and the way to it from the start
  Eigen::VectorXd lowest_, highest_;
};

/// Returns `motion` with the angles that go round as they are at `here`.
/// @param sizes  Swing::sizes()
[[nodiscard]] Motion with_rings_at(const mbd::Mechanism& mechanism, const Eigen::VectorXd& here,
                                   const Eigen::VectorXd& sizes, Motion motion);

/// Returns the way from one motion to another at the same instant of another period: of positions and velocities, then
/// of the fill fractions and temperatures of films, each film with the weight of a coordinate over its swing.
[[nodiscard]] Eigen::VectorXd way_between(const mbd::Mechanism& mechanism, const Motion& from, const Motion& to);

}  // namespace hersey::run
