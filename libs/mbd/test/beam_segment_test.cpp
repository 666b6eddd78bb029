// A piece of a beam by itself: its tangent, its balance of power and momentum, its rigid limit.
#include "hersey/mbd/beam_segment.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "test_mechanisms.h"

namespace hersey::mbd {
namespace beam_segment_test {

constexpr double kRoundOff = 1e-13;  // of sums of products

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Central differences with step 1e-5: truncation ~ step^2, round-off ~ eps/step, both about 1e-10 of the values' size.
constexpr double kStep = 1e-5;
constexpr double kRelative = 1e-8;  // a hundredfold of that

BeamSegment any_segment() {
  BeamSegmentData data;
  data.element = {.length = 0.8, .stiffness = {50, 30, 20, 3, 5, 7}};
  data.element.frame = rotation_exp({0.4, -0.9, 0.3}).toRotationMatrix();
  data.mass_per_length = 2.5;
  data.inertia_per_length = {0.7, 0.5, 0.3};
  data.damping = 0.2;
  return BeamSegment(data);
}

/// A motion in which everything rotates, moves and deforms a lot; `bend` [rad].
ElasticMotion wild_motion(const BeamSegment& body, double bend) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double size) {
    Vector6 v;
    for (double& x : v) x = size * uniform(random);
    return v;
  };
  const Pose base = test::pose({0.7, -1.2, 0.4}, {0.5, 2, -1});
  ElasticMotion motion;
  for (int i = 0; i < 2; ++i) {
    Pose moved = pose_exp(vector(i == 0 ? 0 : 0.3));
    if (i == 1) moved.R = rotation_exp(bend * Vector3(0.5, -0.3, 0.8).normalized()).toRotationMatrix();
    motion.frames.push_back({.X_WF = base * body.rest_pose(i) * moved, .V = vector(1.5), .A = vector(3)});
  }
  return motion;
}

enum class Moved { position, velocity, acceleration };

ElasticMotion moved(ElasticMotion motion, Moved what, Index i, double step) {
  ElasticFrame& frame = motion.frames[static_cast<std::size_t>(i / 6)];
  if (what == Moved::position) frame.X_WF = frame.X_WF * pose_exp(step * Vector6::Unit(i % 6));
  if (what == Moved::velocity) frame.V[i % 6] += step;
  if (what == Moved::acceleration) frame.A[i % 6] += step;
  return motion;
}

void check_derivative(Moved what) {
  BeamSegment body = any_segment();
  for (const double bend : {0.0, 0.02, 0.9, 2.5}) {  // both sides of where series take over
    CAPTURE(bend);
    const ElasticMotion motion = wild_motion(body, bend);
    ElasticResponse response, plus, minus;
    body.evaluate(motion, true, response);
    const MatrixXd& exact = what == Moved::position ? response.K : what == Moved::velocity ? response.C : response.M;
    const double size = exact.cwiseAbs().maxCoeff();
    CHECK(size > 0.5);
    for (Index i = 0; i < 12; ++i) {
      CAPTURE(i);
      body.evaluate(moved(motion, what, i, kStep), false, plus);
      body.evaluate(moved(motion, what, i, -kStep), false, minus);
      const VectorXd numeric = (plus.force - minus.force) / (2 * kStep);
      CHECK((numeric - exact.col(i)).cwiseAbs().maxCoeff() < kRelative * size);
    }
  }
}

TEST_CASE("BeamSegment_StiffnessMatchesFiniteDifferences") { check_derivative(Moved::position); }
TEST_CASE("BeamSegment_DampingMatchesFiniteDifferences") { check_derivative(Moved::velocity); }
TEST_CASE("BeamSegment_MassMatchesFiniteDifferences") { check_derivative(Moved::acceleration); }

TEST_CASE("BeamSegment_MassIsSymmetricAndPositive") {
  BeamSegment body = any_segment();
  ElasticResponse response;
  body.evaluate(wild_motion(body, 0.9), true, response);
  const MatrixXd& M = response.M;
  CHECK((M - M.transpose()).cwiseAbs().maxCoeff() < 100 * 2.2e-16 * M.cwiseAbs().maxCoeff());
  CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues().minCoeff() > 0);
}

/// The motion a time s later, to second order.
ElasticMotion later(ElasticMotion motion, double s) {
  for (ElasticFrame& frame : motion.frames) {
    frame.X_WF = frame.X_WF * pose_exp(s * frame.V + 0.5 * s * s * frame.A);
    frame.V += s * frame.A;
  }
  return motion;
}

TEST_CASE("BeamSegment_PowerOfItsForcesIsTheRateOfItsEnergy") {
  BeamSegment body = any_segment();
  const ElasticMotion motion = wild_motion(body, 0.9);
  ElasticResponse response;
  body.evaluate(motion, false, response);
  double power = 0;
  for (std::size_t f = 0; f < 2; ++f)
    power += response.force.segment<6>(6 * static_cast<Index>(f)).dot(motion.frames[f].V);
  const Vector3 none = Vector3::Zero();
  const ElasticEnergy now = body.energy(motion, none), plus = body.energy(later(motion, kStep), none),
                      minus = body.energy(later(motion, -kStep), none);
  const auto rate = [](double a, double b) { return (a - b) / (2 * kStep); };
  const double size = std::abs(now.kinetic_rate) + std::abs(now.strain_rate) + now.dissipation;
  CHECK(now.dissipation > 0.01 * size);
  CHECK(std::abs(rate(plus.kinetic, minus.kinetic) - now.kinetic_rate) < kRelative * size);
  CHECK(std::abs(rate(plus.strain, minus.strain) - now.strain_rate) < kRelative * size);
  CHECK(std::abs(power - now.kinetic_rate - now.strain_rate - now.dissipation) < kRoundOff * size);
}

TEST_CASE("BeamSegment_ForcesOnItsFramesAreTheRatesOfItsMomenta") {
  // Inner forces, elasticity and damping among them, change neither.
  BeamSegment body = any_segment();
  const ElasticMotion motion = wild_motion(body, 0.9);
  ElasticResponse response;
  body.evaluate(motion, false, response);
  Vector6 wrench = Vector6::Zero();
  for (std::size_t f = 0; f < 2; ++f)
    wrench += force_transform(motion.frames[f].X_WF) * response.force.segment<6>(6 * static_cast<Index>(f));
  const Vector3 none = Vector3::Zero();
  const ElasticEnergy plus = body.energy(later(motion, kStep), none), minus = body.energy(later(motion, -kStep), none);
  const Vector3 force = (plus.momentum - minus.momentum) / (2 * kStep);
  const Vector3 torque = (plus.angular_momentum - minus.angular_momentum) / (2 * kStep);
  CHECK((force - wrench.tail<3>()).norm() < kRelative * wrench.norm());
  CHECK((torque - wrench.head<3>()).norm() < kRelative * wrench.norm());
}

TEST_CASE("BeamSegment_GravityIsWeightAtItsMiddle") {
  BeamSegment body = any_segment();
  ElasticMotion motion = wild_motion(body, 0.9);
  const Vector3 g(1, -2, 3);
  ElasticResponse without, with;
  body.evaluate(motion, false, without);
  for (ElasticFrame& frame : motion.frames) frame.A.tail<3>() -= frame.X_WF.R.transpose() * g;
  body.evaluate(motion, false, with);
  const VectorXd weight = without.force - with.force;
  for (int i = 0; i < 2; ++i)
    CHECK((motion.frames[static_cast<std::size_t>(i)].X_WF.R * weight.segment<3>(6 * i + 3) - body.mass() / 2 * g)
              .norm() < kRoundOff * g.norm());
  const ElasticEnergy e = body.energy(motion, g);
  const Vector3 middle = (motion.frames[0].X_WF.r + motion.frames[1].X_WF.r) / 2;
  CHECK(e.potential == doctest::Approx(-body.mass() * g.dot(middle)).epsilon(1e-14));  // round-off
}

// Round-off of poses affects forces by a share of a deformation as large as the piece, multiplied by the largest of its
// stiffnesses: a thick piece resists bending about one axis most.
TEST_CASE("BeamSegment_MagnitudeCoversItsLargestStiffness") {
  constexpr double kShare = 1e-6;  // as the segment takes it
  for (const int largest : {0, 1, 2, 3, 4, 5}) {
    CAPTURE(largest);
    double of[6] = {50, 30, 20, 3, 5, 7};
    of[largest] = 5000;
    BeamSegmentData data;
    data.element = {.length = 0.1, .stiffness = {of[0], of[1], of[2], of[3], of[4], of[5]}};
    data.mass_per_length = 2.5;
    data.inertia_per_length = {0.7, 0.5, 0.3};
    BeamSegment body(data);
    ElasticMotion rest;
    for (int i = 0; i < 2; ++i) rest.frames.push_back({.X_WF = body.rest_pose(i)});
    ElasticResponse response;
    body.evaluate(rest, true, response);
    for (Index i = 0; i < 12; ++i) {
      CAPTURE(i);
      const double deformation = i % 6 < 3 ? 1 : data.element.length;  // a radian, a length
      CHECK(response.magnitude[i] >= (1 - kRoundOff) * kShare * response.K(i, i) * deformation);
    }
  }
}

TEST_CASE("BeamSegment_RigidMotionStoresNothingAndNeedsTheRigidBodysForces") {
  BeamSegment body = any_segment();
  const double L = body.data().element.length, m = body.mass();
  for (const double angle : {0.0, 0.3, 3.1, 7.0, 100.0}) {
    CAPTURE(angle);
    const Pose base{rotation_exp(angle * Vector3(0.6, -0.64, 0.48)).toRotationMatrix(), {3, -2, 5}};
    const Vector6 V = (Vector6() << 0.4, -1.1, 0.8, 2, 0.5, -1).finished();
    const Vector6 A = (Vector6() << 1, -2, 0.3, -1, 4, 2).finished();
    ElasticMotion motion;
    for (int i = 0; i < 2; ++i) {
      const Pose rest = body.rest_pose(i);
      const Matrix6 to_frame = motion_transform(rest.inverse());
      motion.frames.push_back({.X_WF = base * rest, .V = to_frame * V, .A = to_frame * A});
    }
    const fem::BeamMotionResponse strained = body.section(motion);
    const double size = body.data().element.stiffness.EA;
    CHECK(strained.force.norm() < 1e-14 * size * L);  // round-off of poses
    // The square of round-off.
    CHECK(strained.energy < 1e-26 * size * L);
    CHECK(strained.dissipation < 1e-26 * size * L);
    // A thin rod with the inertia of its sections.
    const Matrix3& E = body.data().element.frame;
    const Matrix3 J = E * (body.data().inertia_per_length * L).asDiagonal() * E.transpose();
    const Vector3 s = m * body.centre(), x = E.col(0);
    const Matrix3 about = J + m * L * L / 3 * (Matrix3::Identity() - x * x.transpose());
    Matrix6 I;
    I << about, skew(s), -skew(s), m * Matrix3::Identity();
    ElasticResponse response;
    body.evaluate(motion, false, response);
    Vector6 wrench = Vector6::Zero();
    for (int i = 0; i < 2; ++i) wrench += force_transform(body.rest_pose(i)) * response.force.segment<6>(6 * i);
    const Vector6 rigid = I * A + cross_force(V, I * V);
    CHECK((wrench - rigid).norm() < kRoundOff * (rigid.norm() + size));
    CHECK(body.energy(motion, Vector3::Zero()).kinetic == doctest::Approx(0.5 * V.dot(I * V)).epsilon(kRoundOff));
  }
}

}  // namespace beam_segment_test
}  // namespace hersey::mbd
