// Geometry and law of contact, pair by pair: exact derivatives, action and reaction, meshes against what they are made
// of.
#include <doctest/doctest.h>

#include <random>

#include "contact_cases.h"
#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace contact_test {

constexpr double kDifferences = 1e-6;  // of step 1e-6: round-off over it

using test::pose_at;

const ContactLaw kLaw{.stiffness = 3e4, .exponent = 1.5, .damping = 0.4, .friction = 0.3, .slip_speed = 0.05};

struct Pair {
  std::string name;
  ShapeGeometry a, b;
  Pose X_AB;  ///< moved until they overlap by 5 % of their size
};

/// Shapes of size about 1, off their bodies' origins and axes.
std::vector<Pair> pairs() {
  const Sphere ball{{0.1, -0.2, 0.3}, 1.0};
  const HalfSpace floor{{0.2, 0.1, -0.3}, Vector3(0.1, -0.2, 1).normalized()};
  const Vector3 up = floor.normal;
  const Cylinder can{{-0.3, 0.2, -1}, {-0.3, 0.4, 1.5}, 1.0};
  const Capsule pill{{-1, 0.2, 0.1}, {1.5, 0, 0.2}, 0.8};
  const Capsule stick{{0.3, -2, 0.1}, {0.1, 2, 0}, 0.7};
  const Capsule along{{-2, 0, 0}, {1, 0, 0}, 0.5};
  const Box block{pose_at({0.2, 0.3, -0.1}, {0.1, 0.2, -0.1}), {2, 3, 2.5}};
  const Pose rotated = pose_at({0.3, -0.4, 0.2}, Vector3::Zero());
  const auto on_floor = [&](const Matrix3& R, double height) {
    return Pose{R, floor.point + height * up - R * Vector3::Zero()};
  };
  const auto side = [&](const Cylinder& c, double distance) {
    const Vector3 axis = (c.to - c.from).normalized();
    return Vector3(0.4 * c.from + 0.6 * c.to + distance * axis.unitOrthogonal());
  };
  const Matrix3 tipped = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), up).toRotationMatrix();
  std::vector<Pair> list;
  const auto ball_at = [&](const Vector3& centre) { return Pose{rotated.R, centre - rotated.R * ball.centre}; };
  list.push_back({"sphere on half-space", floor, ball, ball_at(floor.point + 0.95 * up + Vector3(0.3, 0.1, 0.06))});
  list.push_back({"sphere on sphere", ball, Sphere{{0, 0.1, 0}, 0.7}, pose_at({0.1, 0.2, 0.3}, {0.7, 0.5, 1.55})});
  list.push_back({"sphere on capsule's side", pill, ball, ball_at({0.3, 0.1, 1.9})});
  list.push_back({"sphere on capsule's end", pill, ball, ball_at({2.9, 0.9, 0.4})});
  list.push_back({"sphere on cylinder's side", can, ball, ball_at(side(can, 1.94))});
  list.push_back({"sphere on cylinder's end", can, ball, ball_at(can.to + Vector3(0.2, 0.1, 0.93))});
  list.push_back({"sphere on cylinder's rim", can, ball, ball_at(can.to + Vector3(1.6, 0.1, 0.6))});
  list.push_back({"sphere on box's face", block, ball, ball_at(block.X_BS * Vector3(0.2, 0.3, 2.2))});
  list.push_back({"sphere on box's edge", block, ball, ball_at(block.X_BS * Vector3(1.6, 0.3, 1.9))});
  list.push_back({"sphere on box's corner", block, ball, ball_at(block.X_BS * Vector3(1.5, 2.0, 1.75))});
  list.push_back({"capsule on half-space", floor, pill, on_floor(rotated.R, 0.75)});
  list.push_back({"box on half-space", floor, block, on_floor(tipped, 1.5)});
  list.push_back(
      {"lying cylinder", floor, can, Pose{tipped * pose_at({1.58, 0, 0}, Vector3::Zero()).R, floor.point + 0.9 * up}});
  list.push_back({"leaning cylinder", floor, can,
                  Pose{tipped * pose_at({0.1, 0.04, 0.2}, Vector3::Zero()).R, floor.point + 1.05 * up}});
  list.push_back({"crossed capsules", pill, stick, pose_at({0.1, 0.2, 0.1}, {0.2, 0.1, 1.45})});
  list.push_back({"parallel capsules", along, along, pose_at({0.003, 0.002, 0.004}, {0.7, 0.1, 0.94})});
  list.push_back({"nearly parallel capsules", along, along, pose_at({0.1, 0.02, 0.03}, {0.7, 0.1, 0.9})});
  list.push_back({"sphere on mesh's face", test::box_mesh(block), ball, ball_at(block.X_BS * Vector3(0.2, 0.3, 2.2))});
  list.push_back({"sphere on mesh's edge", test::box_mesh(block), ball, ball_at(block.X_BS * Vector3(1.6, 0.3, 1.9))});
  list.push_back({"sphere on mesh's corner", test::box_mesh(block), ball, ball_at(block.X_BS * Vector3(1.5, 2, 1.75))});
  list.push_back({"mesh on half-space", floor, test::ball_mesh(1, 3), on_floor(rotated.R, 0.9)});
  list.push_back({"mesh on box", block, test::ball_mesh(1, 3), Pose{rotated.R, block.X_BS * Vector3(0.1, 0.2, 2.15)}});
  list.push_back({"mesh on cylinder", can, test::ball_mesh(1, 3), Pose{rotated.R, side(can, 1.9)}});
  list.push_back({"mesh on capsule", pill, test::ball_mesh(1, 3), Pose{rotated.R, {0.3, 0.1, 1.75}}});
  for (Pair& pair : list) {
    // The gap's gradient for translations is the normal.
    Contact contact(pair.a, pair.b, kLaw);
    for (int i = 0; i < 20; ++i) {
      const auto gap = [&](const Vector3& step) {
        return contact.observe({.X_AB = {pair.X_AB.R, pair.X_AB.r + step}}).gap;
      };
      constexpr double h = 1e-6;
      Vector3 slope;
      for (int k = 0; k < 3; ++k) slope[k] = (gap(h * Vector3::Unit(k)) - gap(-h * Vector3::Unit(k))) / (2 * h);
      pair.X_AB.r -= (gap(Vector3::Zero()) + 0.05) * slope / slope.squaredNorm();
    }
  }
  const std::size_t n = list.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Pair swapped{list[i].name, list[i].b, list[i].a, list[i].X_AB.inverse()};
    list.push_back(swapped);
  }
  return list;
}

const Vector6 kVelocity = (Vector6() << 0.3, -0.2, 0.1, 0.25, 0.15, -0.2).finished();

RelativeMotion motion_at(const Pose& X, const Vector6& V = kVelocity) {
  RelativeMotion motion;
  motion.X_AB = X;
  motion.V_AB_A = V;
  return motion;
}

Vector6 wrench(Contact& contact, const RelativeMotion& motion) {
  ForceResponse response;
  contact.evaluate(motion, false, response);
  return response.W_B_A;
}

/// A mesh pressed onto a solid whose corners move with three amplitudes.
struct DeformingPair {
  std::string name;
  ShapeGeometry solid;
  Pose X_AB;
};

TEST_CASE("ContactOfCornersThatDeform_MatchesFiniteDifferencesAndDoesTheWorkOfItsForces") {
  const auto mesh = test::box_mesh({{}, {0.4, 0.3, 0.2}}, 2);
  const auto corners = static_cast<Eigen::Index>(mesh->corners.size());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd U(3 * corners, 3);
  for (auto& x : U.reshaped()) x = uniform(random);
  const std::vector<DeformingPair> pairs{
      {"half-space", HalfSpace{{0, 0, 0.05}, Vector3(0.1, 0.2, 1).normalized()},
       test::pose_at({0.3, 0.1, 0.4}, {0.2, 0.1, 0.13})},
      {"sphere", Sphere{{0, 0, -0.5}, 0.6}, test::pose_at({0.3, -0.2, 0.4}, {0.02, 0.05, 0.2})}};
  for (const DeformingPair& pair : pairs) {
    CAPTURE(pair.name);
    Contact contact(pair.solid, mesh, U, kLaw);
    RelativeMotion motion = motion_at(pair.X_AB);
    motion.s = Vector3(0.004, -0.006, 0.003);
    motion.s_rate = Vector3(0.3, 0.2, -0.4);
    ForceResponse response, other;
    contact.evaluate(motion, true, response);
    REQUIRE(response.Q.norm() > 0);
    const auto forces = [&](const RelativeMotion& m) {
      contact.evaluate(m, false, other);
      Eigen::VectorXd all(9);
      all << other.W_B_A, other.Q;
      return all;
    };
    const auto compare = [&](const Eigen::VectorXd& column, const auto& move) {
      constexpr double h = 1e-6;
      RelativeMotion plus = motion, minus = motion;
      move(plus, h);
      move(minus, -h);
      const Eigen::VectorXd numeric = (forces(plus) - forces(minus)) / (2 * h);
      CHECK((column - numeric).norm() < kDifferences * std::max(column.norm(), 1.0));
    };
    for (int j = 0; j < 6; ++j) {
      CAPTURE(j);
      Eigen::VectorXd column(9);
      column << response.dW_dX.col(j), response.dQ_dX.col(j);
      compare(column, [&](RelativeMotion& m, double h) { m.X_AB = pose_exp(h * Vector6::Unit(j)) * m.X_AB; });
      column << response.dW_dV.col(j), response.dQ_dV.col(j);
      compare(column, [&](RelativeMotion& m, double h) { m.V_AB_A[j] += h; });
    }
    for (int a = 0; a < 3; ++a) {
      CAPTURE(a);
      Eigen::VectorXd column(9);
      column << response.dW_ds.col(a), response.dQ_ds.col(a);
      compare(column, [&](RelativeMotion& m, double h) { m.s[a] += h; });
      column << response.dW_dr.col(a), response.dQ_dr.col(a);
      compare(column, [&](RelativeMotion& m, double h) { m.s_rate[a] += h; });
    }
    // The work of the forces equals the energy stored in the springs plus the losses of damping and friction.
    constexpr double dt = 1e-6;
    const auto later = [&](double t) {
      RelativeMotion m = motion;
      const Vector6 V = motion.V_AB_A;
      m.X_AB = pose_exp(t * V) * motion.X_AB;
      m.s += t * motion.s_rate;
      return m;
    };
    const double filled = (contact.stored_energy(later(dt)) - contact.stored_energy(later(-dt))) / (2 * dt);
    const ContactObservation observation = contact.observe(motion);
    const double done = response.W_B_A.dot(motion.V_AB_A) + response.Q.dot(motion.s_rate);
    CHECK(done + filled + observation.damping_power + observation.friction_power ==
          doctest::Approx(0).scale(std::abs(filled) + std::abs(observation.friction_power)).epsilon(kDifferences));
  }
}

TEST_CASE("ContactDerivatives_MatchFiniteDifferences") {
  constexpr double h = 1e-6;  // truncation h^2, round-off eps/h: 1e-9 of the largest entry is safe
  for (const Pair& pair : pairs()) {
    CAPTURE(pair.name);
    Contact contact(pair.a, pair.b, kLaw);
    ForceResponse response;
    contact.evaluate(motion_at(pair.X_AB), true, response);
    CHECK(contact.domain_error() == "");
    REQUIRE(response.W_B_A.tail<3>().norm() > 0);
    Matrix6 K, D;
    for (int j = 0; j < 6; ++j) {
      const Vector6 e = h * Vector6::Unit(j);
      K.col(j) =
          (wrench(contact, motion_at(pose_exp(e) * pair.X_AB)) - wrench(contact, motion_at(pose_exp(-e) * pair.X_AB))) /
          (2 * h);
      D.col(j) = (wrench(contact, motion_at(pair.X_AB, kVelocity + e)) -
                  wrench(contact, motion_at(pair.X_AB, kVelocity - e))) /
                 (2 * h);
    }
    // Round-off over h, 1e-10 of forces, and what K has over them.
    CHECK((K - response.dW_dX).cwiseAbs().maxCoeff() < 1e-7 * K.cwiseAbs().maxCoeff());
    CHECK((D - response.dW_dV).cwiseAbs().maxCoeff() < 1e-7 * D.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("ContactForce_IsTheSameFromBothSides") {
  for (const Pair& pair : pairs()) {
    CAPTURE(pair.name);
    Contact one(pair.a, pair.b, kLaw), other(pair.b, pair.a, kLaw);
    const Vector6 on_b = wrench(one, motion_at(pair.X_AB));
    const Pose X_BA = pair.X_AB.inverse();
    const Vector6 V_BA_B = -(motion_transform(X_BA) * kVelocity);
    const Vector6 on_a = force_transform(pair.X_AB) * wrench(other, motion_at(X_BA, V_BA_B));
    // Nearly parallel capsules touch at the ends of their common length, counted on the first of the two.
    const bool ends = pair.name.find("parallel") != std::string::npos;
    CHECK((on_a + on_b).norm() < (ends ? 1e-2 : 1e-9) * on_b.norm());  // round-off
  }
}

TEST_CASE("ElasticForce_IsTheGradientOfTheStoredEnergy") {
  constexpr double h = 1e-6;
  ContactLaw elastic = kLaw;
  elastic.damping = elastic.friction = 0;
  for (const Pair& pair : pairs()) {
    CAPTURE(pair.name);
    // Passing from one spot to two, or a rim's three other points, is smooth but has no potential (contact.3).
    if (pair.name.find("parallel") != std::string::npos || pair.name == "leaning cylinder") continue;
    Contact contact(pair.a, pair.b, elastic);
    const Vector6 W = wrench(contact, motion_at(pair.X_AB));
    Vector6 slope;
    for (int j = 0; j < 6; ++j) {
      const Vector6 e = h * Vector6::Unit(j);
      slope[j] = (contact.stored_energy(motion_at(pose_exp(e) * pair.X_AB)) -
                  contact.stored_energy(motion_at(pose_exp(-e) * pair.X_AB))) /
                 (2 * h);
    }
    CHECK((slope + W).cwiseAbs().maxCoeff() < kDifferences * W.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("ObservedPowers_AddUpToTheWorkDone") {
  for (const Pair& pair : pairs()) {
    CAPTURE(pair.name);
    if (pair.name.find("parallel") != std::string::npos || pair.name == "leaning cylinder") continue;
    Contact contact(pair.a, pair.b, kLaw);
    const ContactObservation observation = contact.observe(motion_at(pair.X_AB));
    constexpr double h = 1e-6;
    const double stored = (contact.stored_energy(motion_at(pose_exp(h * kVelocity) * pair.X_AB)) -
                           contact.stored_energy(motion_at(pose_exp(-h * kVelocity) * pair.X_AB))) /
                          (2 * h);
    const double work = wrench(contact, motion_at(pair.X_AB)).dot(kVelocity);
    const double size = std::abs(stored) + observation.damping_power + observation.friction_power;
    CHECK(std::abs(work + stored + observation.damping_power + observation.friction_power) < kDifferences * size);
    CHECK(observation.damping_power >= 0);
    CHECK(observation.friction_power > 0);
    CHECK(observation.gap < 0);
  }
}

TEST_CASE("BallOnMeshOfABox_IsBallOnBox") {
  const Box block{pose_at({0.2, 0.3, -0.1}, {0.1, 0.2, -0.1}), {2, 3, 2.5}};
  const Sphere ball{{0, 0, 0}, 0.5};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const int cuts : {1, 3}) {
    Contact exact(block, ball, kLaw), meshed(test::box_mesh(block, cuts), ball, kLaw);
    int touching = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3 p(1.5 * uniform(random), 2 * uniform(random), 1.75 * uniform(random));
      const RelativeMotion motion = motion_at({Matrix3::Identity(), block.X_BS * p});
      const Vector6 W = wrench(exact, motion);
      if (!exact.domain_error().empty()) continue;
      const double gap = exact.observe(motion).gap;
      // Another way to the same positions: round-off.
      CHECK(meshed.observe(motion).gap == doctest::Approx(gap).epsilon(1e-10));
      if (W.norm() == 0) continue;
      ++touching;
      CHECK((wrench(meshed, motion) - W).norm() < 1e-9 * W.norm());  // another way to the same positions: round-off
    }
    CHECK(touching > 50);
  }
  // Exactly over the diagonal of a face, and over a corner, there is one spot and not two.
  Contact meshed(test::box_mesh(Box{{}, {2, 2, 2}}), ball, kLaw);
  for (const Vector3& p : {Vector3(0, 0, 1.45), Vector3(0.3, 0.3, 1.45), Vector3(1, 1, 1.45), Vector3(1, 0.2, 1.45)})
    CHECK(meshed.observe(motion_at({Matrix3::Identity(), p})).spots == 1);
}

TEST_CASE("BallInACornerOfAMesh_TouchesEveryWall") {
  TriangleMesh corner;  // the planes x = 0 and z = 0, seen from x > 0, z > 0
  corner.corners = {{0, -9, 0}, {0, 9, 0}, {9, -9, 0}, {9, 9, 0}, {0, -9, 9}, {0, 9, 9}};
  corner.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
  Contact contact(std::make_shared<const TriangleMesh>(corner), Sphere{Vector3::Zero(), 1},
                  {.stiffness = 1e3, .exponent = 1});
  const ContactObservation observation =
      contact.observe(motion_at({Matrix3::Identity(), {0.9, 0.3, 0.95}}, Vector6::Zero()));
  CHECK(observation.spots == 2);
  CHECK((observation.force - Vector3(100, 0, 50)).norm() < 1e-9);  // N: round-off
}

TEST_CASE("MeshOfABall_PressesLikeTheBallAsItIsRefined") {
  // A foundation of pressure K delta under a ball: N = K int delta dA = pi K R delta^2.
  const double K = 1e6, R = 1, delta = 0.15;
  Contact ball(HalfSpace{}, Sphere{Vector3::Zero(), R}, {.stiffness = std::numbers::pi * K * R, .exponent = 2});
  const double exact = wrench(ball, motion_at({Matrix3::Identity(), {0, 0, R - delta}}, Vector6::Zero()))[5];
  CHECK(exact == doctest::Approx(std::numbers::pi * K * R * delta * delta));
  std::array<double, 3> error{};
  for (int i = 0; i < 3; ++i) {
    Contact mesh(HalfSpace{}, test::ball_mesh(R, 3 + i), {.stiffness = K, .exponent = 1});
    // The segment pressed flat has depth R(1 - cos): its normal component makes the area's projection exact.
    const Pose X = pose_at({0.3, 0.5, 0.1}, {0, 0, R - delta});
    error[i] = std::abs(wrench(mesh, motion_at(X, Vector6::Zero()))[5] / exact - 1);
  }
  CAPTURE(error[0]);
  CAPTURE(error[1]);
  CAPTURE(error[2]);
  CHECK(error[2] < 0.02);
  CHECK(error[2] < error[0]);
}

TEST_CASE("UprightCylinder_HasNoPreferredDirection") {
  const Cylinder can{{0, 0, -1}, {0, 0, 1}, 1};
  Contact contact(HalfSpace{}, can, {.stiffness = 1e5, .exponent = 1.5});
  const double lean = 0.005;
  const auto tilting = [&](double phi) {
    const Vector3 axis(std::cos(phi), std::sin(phi), 0);
    const Vector6 W = wrench(contact, motion_at(pose_at(lean * axis, {0, 0, 0.98}), Vector6::Zero()));
    return std::array<double, 3>{W[5], W.head<3>().dot(axis), W.head<3>().dot(Vector3::UnitZ().cross(axis))};
  };
  const auto one = tilting(0);
  for (const double phi : {0.3, 1.1, 2.5}) {
    const auto other = tilting(phi);
    CHECK(other[0] == doctest::Approx(one[0]).epsilon(1e-9));  // round-off
    // Third order in the tilt.
    CHECK(other[1] == doctest::Approx(one[1]).epsilon(1e-6));
    CHECK(std::abs(other[2]) < 1e-6 * std::abs(one[1]));
  }
  CHECK(one[1] < 0);  // it rights itself
  // Exactly upright the direction of leaning is undefined, and nothing depends on it.
  ForceResponse upright, almost;
  contact.evaluate(motion_at(pose_at(Vector3::Zero(), {0, 0, 0.98})), true, upright);
  contact.evaluate(motion_at(pose_at({1e-6, 0, 0}, {0, 0, 0.98})), true, almost);
  CHECK((upright.W_B_A - almost.W_B_A).norm() < 1e-4 * upright.W_B_A.norm());  // a tilt of 1e-6 by its stiffness
}

TEST_CASE("Contact_NeverPulls") {
  Contact contact(HalfSpace{}, Sphere{Vector3::Zero(), 1}, kLaw);
  Vector6 V = Vector6::Zero();
  V[5] = 10;  // leaving faster than 1/damping
  const ContactObservation observation = contact.observe(motion_at({Matrix3::Identity(), {0, 0, 0.95}}, V));
  CHECK(observation.spots == 1);
  CHECK(observation.force.norm() == 0);
}

TEST_CASE("DeepOverlap_IsADomainError") {
  Contact contact(HalfSpace{}, Sphere{Vector3::Zero(), 1}, kLaw);
  (void)wrench(contact, motion_at({Matrix3::Identity(), {0, 0, 0.81}}));
  CHECK(contact.domain_error() == "");
  (void)wrench(contact, motion_at({Matrix3::Identity(), {0, 0, 0.7}}));
  CHECK(contact.domain_error() == "the shapes overlap by 300 mm, more than 200 mm (20 % of the smaller one's size)");
  (void)wrench(contact, motion_at({Matrix3::Identity(), {0, 0, 2}}));
  CHECK(contact.domain_error() == "");
}

TEST_CASE("UnsupportedPairs_AreRefused") {
  const Box block{{}, {1, 1, 1}};
  CHECK_FALSE(can_touch(HalfSpace{}, HalfSpace{}));
  CHECK_FALSE(can_touch(block, block));
  CHECK_FALSE(can_touch(block, Cylinder{}));
  CHECK(can_touch(block, Sphere{Vector3::Zero(), 1}));
  CHECK(touches_with_pressure(block, test::box_mesh(block)));
  CHECK_FALSE(touches_with_pressure(Sphere{Vector3::Zero(), 1}, test::box_mesh(block)));
  CHECK_THROWS_AS(Contact(block, block, kLaw), ContractError);
}

}  // namespace contact_test
}  // namespace hersey::mbd
