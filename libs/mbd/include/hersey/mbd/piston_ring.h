#pragma once

#include <memory>

#include "hersey/core/scalar_function.h"
#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// Friction between a piston ring and its liner, with given forces instead of a film (theory manual, skirt.13 and
/// skirt.14): tension and gas press the ring against the liner, and a Stribeck curve over the Hersey number of its face
/// gives the coefficient of friction. Choose it for the rings' part of an engine's friction; it has no film thickness,
/// takes no oil and carries no side force.
///
/// Frame A is the liner's, its z-axis that of the liner, B lies on the piston's axis where the ring is. The force acts
/// at B's origin along the liner's axis.
class PistonRing final : public TwoBodyForce {
 public:
  struct Data {
    double bore = 0.08;              ///< of the liner [m], > 0
    double height = 1.5e-3;          ///< of the face that bears, along the axis [m], > 0
    double tension = 0;              ///< force along the ring that closes its gap [N], >= 0
    double viscosity = 0;            ///< of the oil on the liner [Pa s], >= 0
    double transition_speed = 0.01;  ///< at which 71 % of the friction of sliding acts [m/s], > 0
    double lowest = 0, highest = 0;  ///< Hersey numbers between which the curve is defined; it is constant beyond [-]
    std::shared_ptr<const ScalarFunction> stribeck = {};  ///< coefficient of friction over the Hersey number [-], >= 0
    std::shared_ptr<const ScalarFunction> gas =
        {};  ///< mean pressure of the gas between back and face over time [Pa]; null: none
  };
  /// @throws ContractError for data outside these ranges
  explicit PistonRing(Data data);

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  [[nodiscard]] double lost_power(const RelativeMotion& motion) const override;

  /// Returns the force that presses the whole ring against the liner at a time [s], 0 where gas lifts it off (skirt.13)
  /// [N].
  [[nodiscard]] double radial_load(double t) const;
  /// Friction force of a ring that slides, against its velocity, and its slope by it (skirt.14).
  struct Friction {
    double force = 0;     ///< in the direction of -speed [N]
    double by_speed = 0;  ///< [N s/m]
  };
  /// @param speed  of the piston along the liner's axis [m/s] @param t  [s]
  [[nodiscard]] Friction friction(double speed, double t) const;

 private:
  Data data_;
};

}  // namespace hersey::mbd
