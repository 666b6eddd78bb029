#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/core/scalar_function.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// Coefficients of a bearing about one state of equilibrium, in the axes x and y of its frame.
struct BearingCoefficients {
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  ///< K_ij = -df_i/dx_j [N/m]
  Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();    ///< C_ij = -df_i/dxdot_j [N s/m]
  Eigen::Matrix2d inertia = Eigen::Matrix2d::Zero();    ///< M_ij = -df_i/dxddot_j, symmetric [kg]
  Eigen::Vector2d position = Eigen::Vector2d::Zero();   ///< of the journal at equilibrium [m]
  Eigen::Vector2d force = Eigen::Vector2d::Zero();      ///< on the journal there [N]
};

/// Bearing coefficients over the speed of the shaft: between its speeds monotone cubics (TableFunction), nearer to rest
/// constant. A table of one speed holds at every speed.
/// @verified_by linear_bearing_test.cpp
class BearingCoefficientTable {
 public:
  /// @param speeds        increasing, at least one [rad/s]
  /// @param coefficients  as many
  /// @throws ContractError if these rules are violated, a number is not finite or an inertia not symmetric
  BearingCoefficientTable(const std::vector<double>& speeds, const std::vector<BearingCoefficients>& coefficients);

  /// Returns the coefficients at a speed [rad/s].
  [[nodiscard]] BearingCoefficients at(double speed) const;
  /// Returns their derivatives by the speed, 0 beyond the table.
  [[nodiscard]] BearingCoefficients slope(double speed) const;

  /// Returns why the table says nothing about a speed [rad/s]: one in the other sense of rotation, or more than a
  /// hundredth beyond its fastest; else empty.
  [[nodiscard]] std::string fault_at(double speed) const;

  [[nodiscard]] double lowest() const { return lowest_; }    ///< speed [rad/s]
  [[nodiscard]] double highest() const { return highest_; }  ///< speed [rad/s]

 private:
  double lowest_, highest_;
  std::vector<std::unique_ptr<const ScalarFunction>> entries_;  ///< one for each number of BearingCoefficients
};

/// A bearing, seal or magnetic bearing by its coefficients (theory manual, rotors.1): a force in the plane across its
/// axis, linear in the small motion about an equilibrium, with coefficients that depend on the speed of the shaft.
/// Choose it for what another program or a maker gives as a table; a film computed by hersey needs none, and large
/// motions are beyond it.
///
/// Frame A is the housing's, its z-axis that of the shaft, B lies on the shaft. The force acts at B's origin.
class LinearBearing final : public TwoBodyForce {
 public:
  /// @param table  shared by all bearings with these coefficients, not null
  explicit LinearBearing(std::shared_ptr<const BearingCoefficientTable> table) : table_(std::move(table)) {}

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  /// Of the symmetric part of the stiffness and the force at equilibrium.
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] double kinetic_energy(const RelativeMotion& motion) const override;
  /// Whatever is not stored: damping, what cross-coupled stiffness circulates (negative where it drives the shaft), and
  /// what a change of speed does to the coefficients.
  [[nodiscard]] double lost_power(const RelativeMotion& motion) const override;
  [[nodiscard]] std::string domain_error() const override { return table_->fault_at(speed_); }

 private:
  std::shared_ptr<const BearingCoefficientTable> table_;
  double speed_ = 0;  ///< of the shaft at the last evaluation [rad/s]
};

}  // namespace hersey::mbd
