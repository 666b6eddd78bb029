#include "hersey/mbd/unbalance.h"

#include <doctest/doctest.h>

#include "relative.h"
#include "test_mechanisms.h"

// Unbalances of shafts (theory manual, rotors.4).
namespace hersey::mbd {
namespace unbalance_test {

const Vector3 kMoment(2e-5, -3e-5, 1e-5), kGravity(1, -9, 2);

RelativeMotion shaft_motion() {
  RelativeMotion motion;
  motion.X_AB = {rotation_exp({0.02, -0.3, 0.4}).toRotationMatrix(), {8e-2, -2e-2, 0.3}};
  motion.V_AB_A << 3, -2, 250, 0.4, -0.3, 0.2;
  motion.A_AB_A << 4, 7, 60, 3, -5, 2;
  return motion;
}

/// Acceleration of a point fixed on B at r, from the origin of A.
Vector3 acceleration_at(const RelativeMotion& motion, const Vector3& r) {
  const Vector3 omega = motion.V_AB_A.head<3>(), alpha = motion.A_AB_A.head<3>();
  const Vector3 velocity = motion.V_AB_A.tail<3>() + omega.cross(r);
  return motion.A_AB_A.tail<3>() + alpha.cross(r) + omega.cross(velocity);
}

// A large mass near the axis, less the same mass on it: the moment of inertia that this adds falls with the mass.
TEST_CASE("Unbalance_IsAMassOffTheAxisInPlaceOfOneOnIt") {
  const RelativeMotion motion = shaft_motion();
  Unbalance unbalance(kMoment, kGravity);
  ForceResponse response;
  unbalance.evaluate(motion, false, response);
  for (const double mass : {10.0, 1000.0}) {
    const Vector3 r = motion.X_AB.r, e = motion.X_AB.R * kMoment / mass;
    const Vector3 off = -mass * (acceleration_at(motion, r + e) - kGravity);
    const Vector3 on = -mass * (acceleration_at(motion, r) - kGravity);
    Vector6 expected;
    expected << (r + e).cross(off) - r.cross(on), off - on;
    // e/m of the moment, and the round-off of the large forces' difference.
    CHECK((response.W_B_A - expected).norm() < (1e-3 / mass + 1e-13 * mass) * response.W_B_A.norm());
  }
}

TEST_CASE("Unbalance_HasExactDerivatives") {
  Unbalance unbalance(kMoment, kGravity);
  const RelativeMotion motion = shaft_motion();
  ForceResponse centre, plus, minus;
  unbalance.evaluate(motion, true, centre);
  constexpr double step = 1e-5;
  for (int k = 0; k < 6; ++k) {
    CAPTURE(k);
    const auto difference = [&](auto change) {
      RelativeMotion after = motion, before = motion;
      change(after, step), change(before, -step);
      unbalance.evaluate(after, false, plus), unbalance.evaluate(before, false, minus);
      return Vector6((plus.W_B_A - minus.W_B_A) / (2 * step));
    };
    const Vector6 by_pose =
        difference([&](RelativeMotion& m, double by) { m.X_AB = pose_exp(by * Vector6::Unit(k)) * m.X_AB; });
    const Vector6 by_velocity = difference([&](RelativeMotion& m, double by) { m.V_AB_A[k] += by; });
    const Vector6 by_acceleration = difference([&](RelativeMotion& m, double by) { m.A_AB_A[k] += by; });
    constexpr double smooth = 1e-7;  // of central differences of smooth functions
    CHECK((by_pose - centre.dW_dX.col(k)).norm() < smooth * centre.dW_dX.norm());
    CHECK((by_velocity - centre.dW_dV.col(k)).norm() < smooth * centre.dW_dV.norm());
    CHECK((by_acceleration - centre.dW_dA.col(k)).norm() < smooth * centre.dW_dA.norm());
  }
}

TEST_CASE("Unbalance_TakesThePowerThatItsEnergiesGain") {
  const Unbalance unbalance(kMoment, kGravity);
  const RelativeMotion motion = shaft_motion();
  const auto moved = [&](double dt) {
    RelativeMotion m = motion;
    // V' = A as an observer on A sees it; the pose along the mean velocity.
    m.X_AB = pose_exp(dt * motion.V_AB_A + 0.5 * dt * dt * motion.A_AB_A) * m.X_AB;
    m.V_AB_A += dt * motion.A_AB_A;
    return m;
  };
  const auto energy = [&](double dt) {
    return unbalance.kinetic_energy(moved(dt)) + unbalance.stored_energy(moved(dt));
  };
  constexpr double dt = 1e-6;
  ForceResponse response;
  Unbalance(kMoment, kGravity).evaluate(motion, false, response);
  const double gained = (energy(dt) - energy(-dt)) / (2 * dt);
  CHECK(-response.W_B_A.dot(motion.V_AB_A) == relative(gained).epsilon(1e-6));  // of central differences
}

TEST_CASE("UnbalanceThatBegins_IsNoneBeforeAndTheSameAfterwards") {
  RelativeMotion motion = shaft_motion();
  Unbalance always(kMoment, kGravity), begins(kMoment, kGravity, 0.3);
  ForceResponse expected, response;
  always.evaluate(motion, true, expected);
  const auto step_from = [&](double t) {
    motion.t = t;
    begins.begin_step(motion, 1e-3);
    motion.t = t + 1e-3;
    begins.evaluate(motion, true, response);
  };
  step_from(0.299);  // ends where it begins
  CHECK(response.W_B_A.norm() == 0);
  CHECK(response.dW_dX.norm() + response.dW_dV.norm() + response.dW_dA.norm() == 0);
  CHECK(begins.kinetic_energy(motion) == 0);
  CHECK(begins.stored_energy(motion) == 0);
  motion.t = 0.3;
  begins.accept_step(motion);
  begins.evaluate(motion, true, response);
  CHECK(response.W_B_A == expected.W_B_A);  // of the accelerations there
  step_from(0.3 - 1e-9);                    // of the sum of steps
  CHECK(response.W_B_A == expected.W_B_A);
  CHECK(response.dW_dX == expected.dW_dX);
  CHECK(begins.kinetic_energy(motion) == 0);  // counted from its beginning
  step_from(0.299);
  CHECK(response.W_B_A.norm() == 0);
}

TEST_CASE("UnbalanceThatHasBegun_GoesOnFromWhereItWasSaved") {
  RelativeMotion motion = shaft_motion();
  Unbalance begun(kMoment, kGravity, 0.3), restored(kMoment, kGravity, 0.3);
  motion.t = 0.3;
  begun.begin_step(motion, 1e-3);
  Archive saved;
  begun.persist(saved);
  Archive read(saved.content());
  restored.persist(read);
  motion.t = 0.4;
  motion.V_AB_A *= 1.5;
  motion.X_AB.R = rotation_exp({0.1, 0.2, 0.3}).toRotationMatrix() * motion.X_AB.R;
  CHECK(restored.kinetic_energy(motion) == begun.kinetic_energy(motion));
  CHECK(restored.stored_energy(motion) == begun.stored_energy(motion));
  CHECK(begun.kinetic_energy(motion) != Unbalance(kMoment, kGravity).kinetic_energy(motion));
}

}  // namespace unbalance_test
}  // namespace hersey::mbd
