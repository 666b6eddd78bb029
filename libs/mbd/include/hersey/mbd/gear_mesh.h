#pragma once

#include <array>
#include <limits>

#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// The mesh of two external gear wheels with involute teeth, spur or helical, on shafts that bend (theory manual,
/// rotors.16 to rotors.20): a spring and damper along the line of action, which follows the wheels' centres.
///
/// Frames A and B lie in the middle of the first and second wheel's faces, their z-axes are those of the wheels and
/// point the same way. The same flanks touch at all times: the force is linear in the deflection, also where teeth
/// would part. The deflection is a function of where both wheels are, periodic in one tooth, so that it stays as exact
/// over any number of revolutions.
/// @verified_by gear_mesh_test.cpp, tests/cli/gear_test.py
class GearMesh final : public TwoBodyForce {
 public:
  struct Data {
    std::array<int, 2> teeth{};           ///< numbers of teeth, > 0
    std::array<double, 2> base_radius{};  ///< [m], > 0, in the ratio of the numbers of teeth
    double base_helix = 0;                ///< helix angle of the first wheel on its base cylinder; > 0: right-handed
    int side = 1;                         ///< sign of the torque on the first wheel by all but this mesh, 1 or -1
    double stiffness = 0;                 ///< along the normal of the flanks [N/m], >= 0
    double damping = 0;                   ///< likewise [N s/m], >= 0
    double error = 0;                     ///< amplitude of the transmission error along the normal [m]
    double error_phase = 0;               ///< at the position of `mesh_here`; grows as the first wheel turns by `side`
    /// Distance of the axes up to which teeth reach each other [m].
    double reach = std::numeric_limits<double>::infinity();
  };

  /// What a mesh exerts. Components are those of the force on the first wheel, at its pitch circle in service.
  struct Load {
    double normal = 0;         ///< by which the flanks press on each other; below zero they would part [N]
    double tangential = 0;     ///< against the torque of the shaft that drives it [N]
    double radial = 0;         ///< towards its axis [N]
    double axial = 0;          ///< along its z-axis [N]
    double deflection = 0;     ///< of the teeth along the normal, the transmission error included [m]
    double damping_power = 0;  ///< [W]
  };

  /// @throws ContractError if these rules are violated
  explicit GearMesh(const Data& data);

  /// Makes the wheels mesh without deflection where they are now (but for the transmission error).
  void mesh_here(const RelativeMotion& motion);

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] double lost_power(const RelativeMotion& motion) const override;
  [[nodiscard]] std::string domain_error() const override { return fault_; }

  /// Returns what acts in the mesh.
  [[nodiscard]] Load load(const RelativeMotion& motion) const;
  /// Rate of the deflection of wheels without errors [m/s]: zero where they roll in their ratio.
  [[nodiscard]] double approach(const RelativeMotion& motion) const;
  [[nodiscard]] const Data& data() const { return data_; }
  /// Of the teeth along the normal [m].
  [[nodiscard]] double pitch() const { return pitch_; }

 private:
  struct Deflection;
  /// Of wheels without errors, from any position.
  [[nodiscard]] Deflection geometry(const RelativeMotion& motion) const;
  /// From where the wheels mesh without force.
  [[nodiscard]] Deflection deflection(const RelativeMotion& motion) const;

  Data data_;
  double pitch_;           // of the teeth along the normal [m]
  double free_ = 0;        // deflection where the wheels mesh without force, modulo the pitch [m]
  double free_phase_ = 0;  // angle at which the first wheel sees the second there
  std::string fault_;      // of the last evaluation
};

}  // namespace hersey::mbd
