#include "hersey/mbd/gear_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "relative.h"

// Meshes of gear wheels (theory manual, rotors.16 to rotors.20).
namespace hersey::mbd {
namespace gear_mesh_test {

constexpr double kPi = std::numbers::pi;
constexpr double kStiffness = 4e8, kRoundOff = 1e-12;  // of some dozens of operations

GearMesh::Data data_of(int side, double helix) {
  GearMesh::Data data;
  data.teeth = {23, 57};
  data.base_radius = {0.0433, 0.0433 * 57 / 23};
  data.base_helix = helix;
  data.side = side;
  data.stiffness = kStiffness;
  data.damping = 3e3;
  return data;
}

double sum_of_radii(const GearMesh::Data& data) { return data.base_radius[0] + data.base_radius[1]; }

Pose wheel_at(const Vector3& centre, double angle) { return {rotation_exp({0, 0, angle}).toRotationMatrix(), centre}; }

RelativeMotion between(const Pose& first, const Pose& second) {
  RelativeMotion motion;
  motion.X_AB = first.inverse() * second;
  return motion;
}

/// Wheels whose axes are tilted and moved, in motion.
RelativeMotion any_motion(const GearMesh::Data& data) {
  RelativeMotion motion;
  motion.X_AB = {rotation_exp({0.012, -0.02, 0.7}).toRotationMatrix(),
                 1.06 * sum_of_radii(data) * Vector3(std::cos(0.4), std::sin(0.4), 0.03)};
  motion.V_AB_A << 0.3, -0.2, 250, 0.04, -0.03, 0.02;
  return motion;
}

Vector6 wrench(GearMesh& mesh, const RelativeMotion& motion) {
  ForceResponse response;
  mesh.evaluate(motion, false, response);
  REQUIRE(mesh.domain_error() == "");
  return response.W_B_A;
}

// The second wheel turned into the first one's teeth is pushed along the normal of their flanks at the pitch point.
TEST_CASE("GearMesh_PushesAlongItsLineOfAction") {
  for (const int side : {1, -1}) {
    for (const double helix : {0.0, 0.25, -0.25}) {
      CAPTURE(side);
      CAPTURE(helix);
      const GearMesh::Data data = data_of(side, helix);
      const double alpha = 0.4, gamma = 1.1, a = sum_of_radii(data) / std::cos(alpha), turned = 2e-4;
      const Vector3 e(std::cos(gamma), std::sin(gamma), 0), t(-std::sin(gamma), std::cos(gamma), 0);
      GearMesh mesh(data);
      mesh.mesh_here(between(Pose{}, wheel_at(a * e, 0.3)));
      const RelativeMotion motion = between(Pose{}, wheel_at(a * e, 0.3 + side * turned));
      const double F = kStiffness * data.base_radius[1] * turned * std::cos(helix);
      const Vector3 n = std::cos(helix) * (side * std::cos(alpha) * t + std::sin(alpha) * e) -
                        side * std::sin(helix) * Vector3::UnitZ();
      const Vector3 pitch_point = data.base_radius[0] / std::cos(alpha) * e;
      Vector6 expected;
      expected << F * pitch_point.cross(n), F * n;
      CHECK((wrench(mesh, motion) - expected).norm() < kRoundOff / turned * F);  // the angles' difference loses digits
      const GearMesh::Load load = mesh.load(motion);
      CHECK(load.normal == relative(F).epsilon(kRoundOff / turned));
      // On the first wheel: against its torque, towards its axis, along it.
      CHECK(load.tangential == relative(side * F * n.dot(t)).epsilon(kRoundOff / turned));
      CHECK(load.radial == relative(F * n.dot(e)).epsilon(kRoundOff / turned));
      CHECK(load.axial == relative(-F * n.z()).scale(F * 1e-9).epsilon(kRoundOff / turned));
    }
  }
}

// A right-handed wheel that is driven pushes itself along its axis as a right-handed screw would go.
TEST_CASE("RightHandedWheel_IsPushedAsAScrewDrivesItself") {
  const GearMesh::Data data = data_of(1, 0.25);
  GearMesh mesh(data);
  const Vector3 centre(1.05 * sum_of_radii(data), 0, 0);
  mesh.mesh_here(between(Pose{}, wheel_at(centre, 0)));
  CHECK(mesh.load(between(wheel_at(Vector3::Zero(), 1e-4), wheel_at(centre, 0))).axial > 0);
}

/// Angle that the flank of an involute on the base radius r_b has turned on by at the radius r.
double polar_angle(double r_b, double r) { return std::sqrt(r * r - r_b * r_b) / r_b - std::acos(r_b / r); }

/// Smallest angle about the first wheel's axis from its flank to the flank of the second, point by point: both are
/// involutes as a string from the base circle draws them, rising with the angle.
double gap(const GearMesh::Data& data, double a, double angle_of_second) {
  const double r_1 = data.base_radius[0], r_2 = data.base_radius[1];
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 4000; ++i) {
    const double roll = 0.2 + 0.4 * i / 4000;
    // The flank of the second wheel faces that of the first: its string unwinds in the same sense.
    const double x = r_2 * (std::cos(roll) + roll * std::sin(roll)), y = r_2 * (std::sin(roll) - roll * std::cos(roll));
    const double c = std::cos(angle_of_second), s = std::sin(angle_of_second);
    const Eigen::Vector2d point(a - (c * x - s * y), -(s * x + c * y));
    if (point.norm() <= r_1) continue;
    least = std::min(least, polar_angle(r_1, point.norm()) - std::atan2(point.y(), point.x()));
  }
  return least;
}

// Flanks drawn point by point touch where the mesh has no force, at another distance of the axes too.
TEST_CASE("InvolutesTouch_WhereTheMeshIsFreeOfForce") {
  const GearMesh::Data data = data_of(-1, 0);
  const auto touching = [&](double a) {
    double low = -0.3, high = 0.3;
    REQUIRE(gap(data, a, low) * gap(data, a, high) < 0);
    const bool rises = gap(data, a, high) > 0;
    for (int i = 0; i < 60; ++i) ((gap(data, a, 0.5 * (low + high)) > 0) == rises ? high : low) = 0.5 * (low + high);
    return low;
  };
  const double near = 1.06 * sum_of_radii(data), far = near + 5e-4;
  GearMesh mesh(data);
  mesh.mesh_here(between(Pose{}, wheel_at({near, 0, 0}, touching(near))));
  const double apart = mesh.load(between(Pose{}, wheel_at({far, 0, 0}, touching(near)))).deflection;
  const double met = mesh.load(between(Pose{}, wheel_at({far, 0, 0}, touching(far)))).deflection;
  CHECK(apart < -1e-4);                           // m: sin(alpha) of the 0.5 mm by which the wheels were moved
  CHECK(std::abs(met) < 1e-4 * std::abs(apart));  // of flanks by 4001 points: the square of their distance
}

TEST_CASE("WheelsThatRollInTheirRatio_HaveNoForceOverAnyNumberOfRevolutions") {
  const GearMesh::Data data = data_of(1, 0.25);
  const Vector3 centre = 1.05 * sum_of_radii(data) * Vector3(std::cos(2.0), std::sin(2.0), 0);
  GearMesh mesh(data);
  const double first = 0.8, second = -1.9;
  mesh.mesh_here(between(wheel_at(Vector3::Zero(), first), wheel_at(centre, second)));
  for (const double revolutions : {0.013, 0.5, 1.7, 1e3, 1e6}) {
    CAPTURE(revolutions);
    const double turned = 2 * kPi * revolutions;
    const RelativeMotion motion = between(wheel_at(Vector3::Zero(), first + turned),
                                          wheel_at(centre, second - turned * data.teeth[0] / data.teeth[1]));
    // Round-off of the angles that were turned.
    CHECK(std::abs(mesh.load(motion).deflection) <
          16 * std::numeric_limits<double>::epsilon() * (10 + turned) * data.base_radius[1]);
  }
}

TEST_CASE("GearMesh_IsTheSameATeethFurther") {
  const GearMesh::Data data = data_of(1, 0.25);
  GearMesh mesh(data);
  const Vector3 centre(1.05 * sum_of_radii(data), 0, 0);
  mesh.mesh_here(between(Pose{}, wheel_at(centre, 0)));
  const double pressed = mesh.load(between(Pose{}, wheel_at(centre, 1e-4))).normal;
  for (const int teeth : {1, -3, 40}) {
    const RelativeMotion further = between(Pose{}, wheel_at(centre, 1e-4 + 2 * kPi * teeth / data.teeth[1]));
    CHECK(mesh.load(further).normal == relative(pressed).epsilon(1e-9));  // digits that 1e-4 of an angle loses
  }
}

TEST_CASE("GearMesh_HasExactDerivatives") {
  for (const int side : {1, -1}) {
    GearMesh::Data data = data_of(side, 0.25);
    data.error = 3e-6, data.error_phase = 0.4;
    GearMesh mesh(data);
    const RelativeMotion motion = any_motion(data);
    RelativeMotion start = motion;
    start.X_AB.r += Vector3(2e-5, 3e-5, 1e-5);
    mesh.mesh_here(start);
    ForceResponse centre, plus, minus;
    mesh.evaluate(motion, true, centre);
    REQUIRE(mesh.domain_error() == "");
    constexpr double step = 1e-6, smooth = 1e-6;  // of central differences of smooth functions
    for (int k = 0; k < 6; ++k) {
      CAPTURE(k);
      const auto difference = [&](auto change) {
        RelativeMotion after = motion, before = motion;
        change(after, step), change(before, -step);
        mesh.evaluate(after, false, plus), mesh.evaluate(before, false, minus);
        return Vector6((plus.W_B_A - minus.W_B_A) / (2 * step));
      };
      const Vector6 by_pose =
          difference([&](RelativeMotion& m, double by) { m.X_AB = pose_exp(by * Vector6::Unit(k)) * m.X_AB; });
      const Vector6 by_velocity = difference([&](RelativeMotion& m, double by) { m.V_AB_A[k] += by; });
      CHECK((by_pose - centre.dW_dX.col(k)).norm() < smooth * centre.dW_dX.col(k).norm());
      CHECK((by_velocity - centre.dW_dV.col(k)).norm() < smooth * centre.dW_dV.norm());
    }
  }
}

TEST_CASE("GearMesh_StoresOrLosesThePowerThatItTakes") {
  GearMesh::Data data = data_of(-1, 0.25);
  data.error = 3e-6;
  GearMesh mesh(data);
  const RelativeMotion motion = any_motion(data);
  RelativeMotion start = motion;
  start.X_AB.r += Vector3(2e-5, 3e-5, 1e-5);
  mesh.mesh_here(start);
  constexpr double dt = 1e-9;
  const auto energy = [&](double time) {
    RelativeMotion moved = motion;
    moved.X_AB = pose_exp(time * motion.V_AB_A) * motion.X_AB;
    return mesh.stored_energy(moved);
  };
  const double stored = (energy(dt) - energy(-dt)) / (2 * dt), taken = -wrench(mesh, motion).dot(motion.V_AB_A);
  CHECK(mesh.lost_power(motion) > 0);
  // Of central differences.
  CHECK(taken == relative(stored + mesh.lost_power(motion)).epsilon(1e-6));
}

// The second wheel called the first: the other hand, the same sign of the torque (it is the driven one's).
TEST_CASE("GearMesh_DoesNotDependOnTheOrderOfItsWheels") {
  const GearMesh::Data data = data_of(1, 0.25);
  GearMesh::Data other = data;
  std::swap(other.teeth[0], other.teeth[1]), std::swap(other.base_radius[0], other.base_radius[1]);
  other.base_helix = -data.base_helix;
  GearMesh mesh(data), exchanged(other);
  const RelativeMotion motion = any_motion(data);
  RelativeMotion back, start = motion, start_back;
  start.X_AB.r += Vector3(2e-5, 3e-5, 1e-5);
  back.X_AB = motion.X_AB.inverse(), start_back.X_AB = start.X_AB.inverse();
  back.V_AB_A = -(motion_transform(back.X_AB) * motion.V_AB_A);
  mesh.mesh_here(start), exchanged.mesh_here(start_back);
  const Vector6 W = wrench(mesh, motion), on_first = wrench(exchanged, back);
  CHECK((force_transform(motion.X_AB) * on_first + W).norm() < 1e-9 * W.norm());  // digits that deflections lose
}

// The teeth of wheels that roll come once, whichever wheel counts them; the other one counts them the other way.
TEST_CASE("TransmissionError_HasTheOppositePhaseWithItsWheelsExchanged") {
  for (const int side : {1, -1}) {
    GearMesh::Data data = data_of(side, 0);
    data.error = 3e-6, data.error_phase = 0.7;
    GearMesh::Data other = data;
    std::swap(other.teeth[0], other.teeth[1]), std::swap(other.base_radius[0], other.base_radius[1]);
    other.error_phase = -data.error_phase;
    GearMesh mesh(data), exchanged(other);
    const Vector3 centre(1.05 * sum_of_radii(data), 0, 0);
    const auto motion_at = [&](double turned) {
      return between(wheel_at(Vector3::Zero(), turned), wheel_at(centre, -turned * data.teeth[0] / data.teeth[1]));
    };
    const auto back = [](const RelativeMotion& motion) { return between(motion.X_AB, Pose{}); };
    mesh.mesh_here(motion_at(0)), exchanged.mesh_here(back(motion_at(0)));
    for (const double turned : {0.0, 0.05, 0.1, 0.15}) {
      CAPTURE(turned);
      const double error = mesh.load(motion_at(turned)).deflection;
      CHECK(error == relative(data.error * std::cos(0.7 + side * data.teeth[0] * turned)).epsilon(1e-8));  // of angles
      CHECK(exchanged.load(back(motion_at(turned))).deflection == relative(error).epsilon(1e-8));          // of angles
    }
  }
}

// Seen in a mirror that holds the axes: the other hand, torque and sense of rotation.
TEST_CASE("GearMesh_HasAMirrorImage") {
  GearMesh::Data data = data_of(1, 0.25);
  data.error = 3e-6, data.error_phase = 0.7;
  GearMesh::Data other = data;
  other.side = -1, other.base_helix = -data.base_helix;
  GearMesh mesh(data), mirrored(other);
  const Vector3 signs(1, -1, 1);
  const auto image = [&](const RelativeMotion& m) {
    RelativeMotion seen;
    seen.X_AB.R = signs.asDiagonal() * m.X_AB.R * signs.asDiagonal();
    seen.X_AB.r = signs.asDiagonal() * m.X_AB.r;
    seen.V_AB_A << -(signs.asDiagonal() * m.V_AB_A.head<3>()), signs.asDiagonal() * m.V_AB_A.tail<3>();
    return seen;
  };
  const RelativeMotion motion = any_motion(data);
  RelativeMotion start = motion;
  start.X_AB.r += Vector3(2e-5, 3e-5, 1e-5);
  mesh.mesh_here(start), mirrored.mesh_here(image(start));
  const Vector6 W = wrench(mesh, motion), seen = wrench(mirrored, image(motion));
  Vector6 expected;
  expected << -(signs.asDiagonal() * W.head<3>()), signs.asDiagonal() * W.tail<3>();
  CHECK((seen - expected).norm() < 1e-9 * W.norm());  // digits that deflections lose
}

TEST_CASE("GearMesh_SaysWhatItCannotDo") {
  GearMesh::Data data = data_of(1, 0);
  data.reach = 1.1 * sum_of_radii(data);
  GearMesh mesh(data);
  const Vector3 centre(1.05 * sum_of_radii(data), 0, 0);
  mesh.mesh_here(between(Pose{}, wheel_at(centre, 0)));
  ForceResponse response;
  const auto fault = [&](const RelativeMotion& motion) {
    mesh.evaluate(motion, true, response);
    return mesh.domain_error();
  };
  CHECK(fault(between(Pose{}, wheel_at(0.9 * centre, 0))).find("sum of their base radii") != std::string::npos);
  CHECK(fault(between(Pose{}, wheel_at(1.06 * centre, 0))).find("their teeth reach each other up to") !=
        std::string::npos);
  CHECK(fault(between(Pose{}, wheel_at(centre, 0.4 * 2 * kPi / data.teeth[1]))).find("a quarter of their pitch") !=
        std::string::npos);
  RelativeMotion crossed = between(Pose{}, wheel_at(centre, 0));
  crossed.X_AB.R = rotation_exp({0.2, 0, 0}).toRotationMatrix();
  CHECK(fault(crossed).find("the axes of its wheels") != std::string::npos);
  CHECK(fault(between(Pose{}, wheel_at(centre, 0))) == "");
}

}  // namespace gear_mesh_test
}  // namespace hersey::mbd
