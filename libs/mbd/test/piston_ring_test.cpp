#include "hersey/mbd/piston_ring.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "hersey/core/table_function.h"
#include "relative.h"
#include "test_mechanisms.h"

// Friction of piston rings by tension, gas and a Stribeck curve (theory manual, skirt.13 and skirt.14).
namespace hersey::mbd {
namespace piston_ring_test {

constexpr double kRoundOff = 1e-13;  // of a few operations

/// A curve with a minimum, over Hersey numbers up to 4e-4.
std::shared_ptr<const ScalarFunction> curve() {
  return std::make_shared<TableFunction>(std::vector{0.0, 5e-5, 1e-4, 2e-4, 4e-4},
                                         std::vector{0.12, 0.06, 0.03, 0.04, 0.06},
                                         TableFunction::Options{.interpolation = Interpolation::smooth});
}

PistonRing::Data data() {
  return {.bore = 0.075,
          .height = 1.5e-3,
          .tension = 8,
          .viscosity = 8e-3,
          .transition_speed = 0.02,
          .lowest = 0,
          .highest = 4e-4,
          .stribeck = curve(),
          .gas = std::make_shared<test::Quadratic>(3e5, -2e6, 0)};
}

// The mean pressure on the face is that of a hoop under its tension, and the gas: 2 T/(D b) + p_g.
TEST_CASE("RadialLoad_IsThatOfTensionAndGas") {
  PistonRing::Data given = data();
  const double face = std::numbers::pi * given.bore * given.height;
  CHECK(PistonRing(given).radial_load(0) ==
        relative(2 * std::numbers::pi * given.tension + 3e5 * face).epsilon(kRoundOff));
  CHECK(PistonRing(given).radial_load(0.1) ==
        relative(2 * std::numbers::pi * given.tension + 1e5 * face).epsilon(kRoundOff));
  CHECK(PistonRing(given).radial_load(1) == 0);  // lifted off
  CHECK(PistonRing(given).friction(3, 1).force == 0);
  given.gas = nullptr;
  CHECK(PistonRing(given).radial_load(1) == relative(2 * std::numbers::pi * given.tension).epsilon(kRoundOff));
}

TEST_CASE("Friction_FollowsTheStribeckCurve") {
  const PistonRing ring(data());
  const double N = ring.radial_load(0), per_length = N / (std::numbers::pi * 0.075);
  for (const double H : {2e-5, 1e-4, 3e-4, 4e-4, 9e-4}) {
    CAPTURE(H);
    const double v = H * per_length / 8e-3, within = std::min(H, 4e-4);
    const double expected = curve()->value({&within, 1}) * N * v / std::hypot(v, 0.02);
    CHECK(ring.friction(v, 0).force == relative(expected).epsilon(kRoundOff));
    CHECK(ring.friction(-v, 0).force == relative(-expected).epsilon(kRoundOff));
  }
  CHECK(ring.friction(0, 0).force == 0);
  // Twice the oil's viscosity at half of the speed is the same place of the curve.
  PistonRing::Data thicker = data();
  thicker.viscosity *= 2, thicker.transition_speed /= 2;
  CHECK(PistonRing(thicker).friction(1, 0).force == relative(ring.friction(2, 0).force).epsilon(kRoundOff));
}

// Also through zero speed, where the curve is one of the speed's size.
TEST_CASE("RingFriction_HasExactSlopes") {
  const PistonRing ring(data());
  constexpr double step = 1e-6;  // m/s
  for (const double v : {-3.0, -0.02, -1e-3, 0.0, 5e-3, 0.3, 4.0}) {
    CAPTURE(v);
    const double difference = (ring.friction(v + step, 0).force - ring.friction(v - step, 0).force) / (2 * step);
    const double size = ring.friction(0, 0).by_speed;
    CHECK(std::abs(ring.friction(v, 0).by_speed - difference) <
          1e-3 * size);  // the step over v_t, as the curvature jumps at zero
  }
}

TEST_CASE("PistonRing_ActsAlongTheLinerAtThePiston_WithExactDerivatives") {
  PistonRing ring(data());
  RelativeMotion motion;
  motion.t = 0.05;
  motion.X_AB = {rotation_exp({0.02, -0.03, 0.4}).toRotationMatrix(), {1e-3, -2e-3, -0.06}};
  motion.V_AB_A << 3, -2, 5, 0.4, -0.3, 2;
  ForceResponse centre;
  ring.evaluate(motion, true, centre);
  const Vector3 f = centre.W_B_A.tail<3>(), omega = motion.V_AB_A.head<3>();
  const double speed = (motion.V_AB_A.tail<3>() + omega.cross(motion.X_AB.r)).z();
  CHECK(f.z() == relative(-ring.friction(speed, motion.t).force).epsilon(kRoundOff));
  CHECK(f.head<2>().norm() == 0);
  CHECK((centre.W_B_A.head<3>() - motion.X_AB.r.cross(f)).norm() < kRoundOff * f.norm());
  CHECK(ring.lost_power(motion) == relative(-centre.W_B_A.dot(motion.V_AB_A)).epsilon(kRoundOff));
  constexpr double step = 1e-6, of_differences = 1e-7;  // round-off over the step, and its square times a curvature
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    const auto at = [&](double sign, bool velocity) {
      RelativeMotion moved = motion;
      const Vector6 xi = sign * step * Vector6::Unit(i);
      if (velocity)
        moved.V_AB_A += xi;
      else
        moved.X_AB = pose_exp(xi) * moved.X_AB;
      ForceResponse response;
      ring.evaluate(moved, false, response);
      return response.W_B_A;
    };
    const double size = centre.dW_dX.cwiseAbs().maxCoeff() + centre.dW_dV.cwiseAbs().maxCoeff();
    CHECK(((at(1, false) - at(-1, false)) / (2 * step) - centre.dW_dX.col(i)).norm() < of_differences * size);
    CHECK(((at(1, true) - at(-1, true)) / (2 * step) - centre.dW_dV.col(i)).norm() < of_differences * size);
  }
}

}  // namespace piston_ring_test
}  // namespace hersey::mbd
