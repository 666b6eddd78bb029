#include "hersey/fem/beam.h"

#include <doctest/doctest.h>

#include <limits>
#include <numbers>

#include "beam_statics.h"

namespace hersey::fem {
namespace beam_test {

constexpr double kDifferences = 1e-7;  // central differences of step 1e-5: h^2, and round-off over h

constexpr double eps = std::numeric_limits<double>::epsilon(), pi = std::numbers::pi;

using namespace test;

/// Nodes along x, of `n` elements of length 1 together.
std::vector<Vector3> line(int n) {
  std::vector<Vector3> nodes;
  for (int i = 0; i <= n; ++i) nodes.emplace_back(static_cast<double>(i) / n, 0, 0);
  return nodes;
}

const std::vector<int> first_node_clamped = {0, 1, 2, 3, 4, 5};

/// EI = 1, and neither stretch nor shear to speak of.
constexpr BeamStiffness slender = {1e8, 1e8, 1e8, 1, 1, 1};

BeamElement any_element() {
  BeamElement element{.length = 0.8, .stiffness = {50, 30, 20, 3, 5, 7}};
  element.frame = rotation_exp({0.4, -0.9, 0.3}).toRotationMatrix();
  return element;
}

BeamState any_state(double bend) {
  const Eigen::Quaterniond R = rotation_exp({0.7, 1.9, -0.4});
  return {{R.toRotationMatrix(), {0.1, 0.2, -0.3}},
          {(R * rotation_exp(bend * Vector3(0.5, -0.3, 0.8))).toRotationMatrix(), {0.5, -0.2, 0.4}}};
}

TEST_CASE("BeamForce_IsTheGradientOfItsEnergy_AndTheTangentThatOfTheForce") {
  const double h = 1e-5;
  for (const double bend : {0.0, 1e-3, 0.02, 1.0, 2.5}) {  // both sides of where series take over
    CAPTURE(bend);
    const BeamState state = any_state(bend);
    const BeamMotionResponse here = beam_response(any_element(), state[0], state[1]);
    for (int i = 0; i < 12; ++i) {
      BeamState plus = state, minus = state;
      move(plus, h * Eigen::VectorXd::Unit(12, i));
      move(minus, -h * Eigen::VectorXd::Unit(12, i));
      const BeamMotionResponse p = beam_response(any_element(), plus[0], plus[1]),
                               m = beam_response(any_element(), minus[0], minus[1]);
      CHECK((p.energy - m.energy) / (2 * h) == doctest::Approx(here.force[i]).epsilon(kDifferences).scale(10));
      CHECK(((p.force - m.force) / (2 * h) - here.K.col(i)).norm() < kDifferences * here.K.norm());
    }
  }
}

TEST_CASE("RigidMotionOfABeam_ChangesNoForce") {
  const BeamState state = any_state(1);
  const Pose Q{rotation_exp({1.2, -2.1, 0.6}).toRotationMatrix(), {3, -2, 5}};
  const BeamMotionResponse before = beam_response(any_element(), state[0], state[1]),
                           after = beam_response(any_element(), Q * state[0], Q * state[1]);
  CHECK(after.energy == doctest::Approx(before.energy).epsilon(1000 * eps));
  CHECK((after.force - before.force).norm() <
        1000 * eps * before.force.norm());  // in axes that rotate with the element
  // Undeformed and rotated, it stores nothing.
  const Pose far{Matrix3::Identity(), any_element().frame.col(0) * 0.8};
  CHECK(beam_response(any_element(), Q, Q * far).force.norm() < 1000 * eps * 50);
}

TEST_CASE("BeamForces_BalanceEachOther") {
  const BeamState state = any_state(1);
  const BeamVector f = beam_response(any_element(), state[0], state[1]).force;
  const Vector6 W_a = force_transform(state[0]) * f.head<6>(), W_b = force_transform(state[1]) * f.tail<6>();
  CHECK((W_a + W_b).tail<3>().norm() < 1000 * eps * f.norm());
  CHECK((W_a + W_b).head<3>().norm() < 1000 * eps * f.norm());
}

/// Tip of a clamped beam of `n` elements under a force across it: rotation, deflection, shortening.
Vector3 elastica(int n, double load) {
  const BeamBody body = beam_body(line(n), slender, {0, 0, 1});
  BeamState state = undeformed(body);
  REQUIRE(solve_beam(body, first_node_clamped, {{.node = n, .force = {0, load, 0}}}, state) == 1);
  const Pose& tip = state.back();
  return {rotation_log(Eigen::Quaterniond(tip.R)).z(), tip.r.y(), 1 - tip.r.x()};
}

TEST_CASE("Elastica_UnderATipLoad_ConvergesToTheExactSolutionWithOrderTwo") {
  // P L^2/(E I) = 10, 1, 5: elliptic integrals.
  const std::pair<double, Vector3> exact[] = {{10, {1.430285538803807, 0.8106090248802941, 0.5549955977537528}},
                                              {1, {0.46135194971169713, 0.30172077379985884, 0.05643323628354946}},
                                              {5, {1.215368117611686, 0.7137915236119133, 0.3876283607244293}}};
  for (const auto& [load, tip] : exact) {
    const double coarse = (elastica(16, load) - tip).norm(), fine = (elastica(32, load) - tip).norm();
    CHECK(fine < 1e-3);  // 32 elements, second order
    CHECK(std::abs(std::log2(coarse / fine) - 2) < 0.1);
    CHECK((elastica(32, load) + (elastica(32, load) - elastica(16, load)) / 3 - tip).norm() < 2e-5);  // extrapolated
  }
}

TEST_CASE("RollUp_ByAnEndMoment_IsACircleExactly") {
  // Every element bends alike, so the nodes lie on a polygon with the exact rotations.
  for (const double revolutions : {0.25, 0.5, 1.0}) {
    const int n = 20;
    const BeamBody body = beam_body(line(n), slender, {0, 0, 1});
    BeamState state = undeformed(body);
    const double angle = 2 * pi * revolutions;
    REQUIRE(solve_beam(body, first_node_clamped, {{.node = n, .moment = {0, 0, angle}}}, state, 20) == 1);
    const double chord = 1 / (2.0 * n) / std::sin(angle / (2 * n));  // radius of the polygon's corners
    for (int a = 0; a <= n; ++a) {
      const double phi = angle * a / n;
      // Sections are half an element's rotation off the chords. A circle instead of its polygon would be off by 1e-4
      // and more.
      CHECK(std::abs(state[a].r.x() - chord * std::sin(phi)) < 1e-6);
      CHECK(std::abs(state[a].r.y() - chord * (1 - std::cos(phi))) < 1e-6);
    }
  }
}

TEST_CASE("LateralBuckling_OfAStripUnderATipLoad_AtItsExactLoad") {
  // P L^2 = 4.0125993 sqrt(EI_z GJ) for a strip much stiffer the other way.
  const int n = 40;
  const BeamBody body = beam_body(line(n), {1e9, 1e9, 1e9, 0.7, 1e5, 1.3}, {0, 0, 1});
  const auto unstable = [&](double P) {
    BeamState state = undeformed(body);
    const std::vector<BeamLoad> loads = {{.node = n, .force = {0, 0, -P}}};
    REQUIRE(solve_beam(body, first_node_clamped, loads, state, 1) == 1);
    return unstable_motions(body, first_node_clamped, loads, state);
  };
  const double exact = 4.0125993435788985 * std::sqrt(0.7 * 1.3);
  CHECK(unstable(0.998 * exact) == 0);
  CHECK(unstable(1.002 * exact) == 1);
}

TEST_CASE("FortyFiveDegreeBend_OfBatheAndBolourchi") {
  // R = 100, section 1 x 1, E = 1e7, nu = 0, P = 600 across the plane; reference on the curved beam with the J stated.
  const std::pair<double, Vector3> reference[] = {{1.0 / 6, {47.1504, 15.6848, 53.4749}},
                                                  {0.1406, {46.8919, 15.5578, 53.6074}}};
  for (const auto& one : reference) {
    const double J = one.first;
    const Vector3& tip = one.second;
    CAPTURE(J);
    const auto solve = [&, torsion = J](int n) -> Vector3 {
      std::vector<Vector3> nodes = line(n);
      for (Vector3& x : nodes) {
        const double phi = pi / 4 * x.x();
        x = {100 * std::sin(phi), 100 * (1 - std::cos(phi)), 0};
      }
      const BeamStiffness stiffness = beam_stiffness({1, 1, 1, 1.0 / 12, 1.0 / 12, torsion}, {.youngs_modulus = 1e7});
      const BeamBody body = beam_body(nodes, stiffness, {0, 0, 1});
      BeamState state = undeformed(body);
      REQUIRE(solve_beam(body, first_node_clamped, {{.node = n, .force = {0, 0, 600}}}, state) == 1);
      return state.back().r;
    };
    const Vector3 coarse = solve(16), fine = solve(32);
    // Axes as in the reference: along the clamped end's tangent, across it in the plane, and out of it.
    const Vector3 extrapolated = fine + (fine - coarse) / 3;
    CAPTURE(extrapolated.transpose());
    CHECK(std::abs(extrapolated.x() - tip.x()) < 5e-3);
    CHECK(std::abs(extrapolated.y() - tip.y()) < 5e-3);
    CHECK(std::abs(extrapolated.z() - tip.z()) < 5e-3);
  }
}

TEST_CASE("BeamWithoutSupports_FindsNoEquilibrium") {
  const BeamBody body = beam_body(line(4), slender, {0, 0, 1});
  BeamState state = undeformed(body);
  CHECK(solve_beam(body, {}, {{.node = 4, .force = {0, 1, 0}}}, state) == 0);
}

}  // namespace beam_test
}  // namespace hersey::fem
