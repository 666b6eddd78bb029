// The modal body by itself: its tangent, its balance of power and momentum, its rigid limit.
#include "hersey/mbd/modal_body.h"

#include <doctest/doctest.h>

#include <cmath>

#include "test_mechanisms.h"

namespace hersey::mbd {
namespace modal_body_test {

constexpr double kRoundOff = 1e-13;  // of sums over shapes
constexpr double kNodes = 1e-12;     // round-off of sums over nodes

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Central differences with step 1e-5: truncation ~ step^2, round-off ~ eps/step, both about 1e-10 of the values' size.
constexpr double kStep = 1e-5;
constexpr double kRelative = 1e-8;  // a hundredfold of that

/// Forces on every node, the same for the same seed.
Eigen::Matrix3Xd random_forces(unsigned seed, Index nodes) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::Matrix3Xd f(3, nodes);
  for (Index i = 0; i < f.size(); ++i) f.data()[i] = uniform(random);
  return f;
}

/// Puts a load in the body's axes and one in ground's on a body.
void load(ModalBody& body) {
  body.add_load({"rotating", LoadAxes::body, random_forces(1, body.data().nodes.cols())});
  body.add_load({"steady", LoadAxes::ground, random_forces(2, body.data().nodes.cols())});
}

/// A motion in which everything rotates, moves and deforms a lot.
ElasticMotion wild_motion(const ModalBody& body) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto vector = [&](double size) {
    Vector6 v;
    for (double& x : v) x = size * uniform(random);
    return v;
  };
  ElasticMotion motion;
  const Pose base = test::pose({0.7, -1.2, 0.4}, {0.5, 2, -1});
  for (int i = 0; i < body.frame_count(); ++i) {
    ElasticFrame frame;
    frame.X_WF = base * body.rest_pose(i) * pose_exp(vector(i == 0 ? 0 : 0.4));
    frame.V = vector(1.5);
    frame.A = vector(3);
    motion.frames.push_back(frame);
  }
  const auto own = [&](double size) {
    VectorXd v(body.coordinate_count());
    for (double& x : v) x = size * uniform(random);
    return v;
  };
  motion.eta = own(0.3);
  motion.eta_rate = own(1);
  motion.eta_acceleration = own(2);
  motion.loads = Eigen::Vector2d(3, -5);
  return motion;
}

/// The motion with unknown `i` of position, velocity or acceleration moved by `step`.
enum class Moved { position, velocity, acceleration };
ElasticMotion moved(const ElasticMotion& from, Moved what, Index i, double step) {
  ElasticMotion motion = from;
  const auto frames = static_cast<Index>(motion.frames.size());
  if (i >= 6 * frames) {
    VectorXd& v = what == Moved::position   ? motion.eta
                  : what == Moved::velocity ? motion.eta_rate
                                            : motion.eta_acceleration;
    v[i - 6 * frames] += step;
    return motion;
  }
  ElasticFrame& frame = motion.frames[static_cast<std::size_t>(i / 6)];
  if (what == Moved::position) frame.X_WF = frame.X_WF * pose_exp(step * Vector6::Unit(i % 6));
  if (what == Moved::velocity) frame.V[i % 6] += step;
  if (what == Moved::acceleration) frame.A[i % 6] += step;
  return motion;
}

void check_derivative(Moved what) {
  ModalBody body(test::random_modal_data());
  load(body);
  const ElasticMotion motion = wild_motion(body);
  ElasticResponse response, plus, minus;
  body.evaluate(motion, true, response);
  const MatrixXd& exact = what == Moved::position ? response.K : what == Moved::velocity ? response.C : response.M;
  const double size = exact.cwiseAbs().maxCoeff();
  CHECK(size > 1);
  for (Index i = 0; i < exact.cols(); ++i) {
    CAPTURE(i);
    body.evaluate(moved(motion, what, i, kStep), false, plus);
    body.evaluate(moved(motion, what, i, -kStep), false, minus);
    const VectorXd numeric = (plus.force - minus.force) / (2 * kStep);
    CHECK((numeric - exact.col(i)).cwiseAbs().maxCoeff() < kRelative * size);
  }
}

TEST_CASE("ModalBody_StiffnessMatchesFiniteDifferences") { check_derivative(Moved::position); }
TEST_CASE("ModalBody_DampingMatchesFiniteDifferences") { check_derivative(Moved::velocity); }
TEST_CASE("ModalBody_MassMatchesFiniteDifferences") { check_derivative(Moved::acceleration); }

TEST_CASE("ModalBody_MassIsSymmetricAndPositive") {
  ModalBody body(test::random_modal_data());
  ElasticResponse response;
  body.evaluate(wild_motion(body), true, response);
  const MatrixXd& M = response.M;
  CHECK((M - M.transpose()).cwiseAbs().maxCoeff() < 100 * 2.2e-16 * M.cwiseAbs().maxCoeff());
  CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues().minCoeff() > 0);
}

/// The motion a time s later, to second order.
ElasticMotion later(const ElasticMotion& from, double s) {
  ElasticMotion motion = from;
  for (ElasticFrame& frame : motion.frames) {
    frame.X_WF = frame.X_WF * pose_exp(s * frame.V + 0.5 * s * s * frame.A);
    frame.V += s * frame.A;
  }
  motion.eta += s * motion.eta_rate + 0.5 * s * s * motion.eta_acceleration;
  motion.eta_rate += s * motion.eta_acceleration;
  return motion;
}

TEST_CASE("ModalBody_PowerOfItsForcesIsTheRateOfItsEnergy") {
  ModalBody body(test::random_modal_data());
  const ElasticMotion motion = wild_motion(body);
  ElasticResponse response;
  body.evaluate(motion, false, response);
  double power = response.force.tail(body.coordinate_count()).dot(motion.eta_rate);
  for (std::size_t f = 0; f < motion.frames.size(); ++f)
    power += response.force.segment<6>(6 * static_cast<Index>(f)).dot(motion.frames[f].V);
  const Vector3 none = Vector3::Zero();
  const ElasticEnergy now = body.energy(motion, none), plus = body.energy(later(motion, kStep), none),
                      minus = body.energy(later(motion, -kStep), none);
  const auto rate = [](double a, double b) { return (a - b) / (2 * kStep); };
  const double size = std::abs(now.kinetic_rate) + std::abs(now.strain_rate) + now.dissipation;
  CHECK(now.dissipation > 0);
  CHECK(std::abs(rate(plus.kinetic, minus.kinetic) - now.kinetic_rate) < kRelative * size);
  CHECK(std::abs(rate(plus.strain, minus.strain) - now.strain_rate) < kRelative * size);
  CHECK(std::abs(power - now.kinetic_rate - now.strain_rate - now.dissipation) < kRoundOff * size);
}

TEST_CASE("ModalBody_LoadsDoTheWorkOfTheirForcesAtTheirNodes") {
  ModalBody body(test::random_modal_data());
  load(body);
  const ElasticMotion motion = wild_motion(body);
  ElasticMotion free = motion;
  free.loads.setZero();
  ElasticResponse with, without;
  body.evaluate(motion, false, with);
  body.evaluate(free, false, without);
  const VectorXd difference = without.force - with.force;
  double power = difference.tail(body.coordinate_count()).dot(motion.eta_rate);
  Vector6 wrench = Vector6::Zero();
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    const Vector6 W = difference.segment<6>(6 * static_cast<Index>(f));
    power += W.dot(motion.frames[f].V);
    wrench += force_transform(motion.frames[0].X_WF.inverse() * motion.frames[f].X_WF) * W;
  }
  const Matrix3 R = motion.frames[0].X_WF.R;
  const auto positions = [&](const ElasticMotion& at) {
    const VectorXd u = body.data().displacements * body.amplitudes(at);
    Eigen::Matrix3Xd y = body.data().nodes + Eigen::Map<const Eigen::Matrix3Xd>(u.data(), 3, u.size() / 3);
    return Eigen::Matrix3Xd((at.frames[0].X_WF.R * y).colwise() + at.frames[0].X_WF.r);
  };
  // The same quantities follow from the nodes themselves, their velocities by differences.
  const Eigen::Matrix3Xd y = positions(motion),
                         v = (positions(later(motion, kStep)) - positions(later(motion, -kStep))) / (2 * kStep);
  const ElasticEnergy energy = body.energy(motion, Vector3::Zero());
  double sum = 0;
  Vector6 total = Vector6::Zero();
  for (int i = 0; i < 2; ++i) {
    Eigen::Matrix3Xd f = motion.loads[i] * random_forces(i == 0 ? 1 : 2, y.cols());
    if (i == 0) f = R * f;
    const ElasticLoad& observation = energy.loads[static_cast<std::size_t>(i)];
    // Velocities by differences of step 1e-5.
    CHECK(observation.power == doctest::Approx((f.array() * v.array()).sum()).epsilon(1e-7));
    CHECK((observation.wrench.tail<3>() - f.rowwise().sum()).norm() < kNodes * observation.wrench.norm());
    Vector3 torque = Vector3::Zero();
    for (Index a = 0; a < y.cols(); ++a) torque += (y.col(a) - motion.frames[0].X_WF.r).cross(Vector3(f.col(a)));
    CHECK((observation.wrench.head<3>() - torque).norm() < kNodes * observation.wrench.norm());
    sum += observation.power;
    total.head<3>() += R.transpose() * observation.wrench.head<3>();
    total.tail<3>() += R.transpose() * observation.wrench.tail<3>();
  }
  CHECK(power == doctest::Approx(sum).epsilon(kNodes));
  CHECK((wrench - total).norm() < kNodes * total.norm());
}

TEST_CASE("ModalBody_ForcesOnItsFramesAreTheRatesOfItsMomenta") {
  // Whatever the shapes: inner forces, elasticity and damping among them, change neither.
  ModalBody body(test::random_modal_data());
  const ElasticMotion motion = wild_motion(body);
  ElasticResponse response;
  body.evaluate(motion, false, response);
  Vector6 wrench = Vector6::Zero();
  for (std::size_t f = 0; f < motion.frames.size(); ++f)
    wrench += force_transform(motion.frames[f].X_WF) * response.force.segment<6>(6 * static_cast<Index>(f));
  const Vector3 none = Vector3::Zero();
  const ElasticEnergy plus = body.energy(later(motion, kStep), none), minus = body.energy(later(motion, -kStep), none);
  const Vector3 force = (plus.momentum - minus.momentum) / (2 * kStep);
  const Vector3 torque = (plus.angular_momentum - minus.angular_momentum) / (2 * kStep);
  CHECK((force - wrench.tail<3>()).norm() < kRelative * wrench.norm());
  CHECK((torque - wrench.head<3>()).norm() < kRelative * wrench.norm());
}

TEST_CASE("ModalBody_RigidMotionStoresNothingAndNeedsTheRigidBodysForces") {
  ModalBodyData data = test::random_modal_data();
  ModalBody body(data);
  ElasticMotion motion = wild_motion(body);
  const ElasticFrame base = motion.frames[0];
  for (int i = 1; i < body.frame_count(); ++i) {
    ElasticFrame& frame = motion.frames[static_cast<std::size_t>(i)];
    const Pose rest = body.rest_pose(i);
    frame.X_WF = base.X_WF * rest;
    frame.V = motion_transform(rest.inverse()) * base.V;
    frame.A = motion_transform(rest.inverse()) * base.A;
  }
  motion.eta.setZero();
  motion.eta_rate.setZero();
  motion.eta_acceleration.setZero();
  const Vector3 g(1, -2, 3);
  const ElasticEnergy energy = body.energy(motion, g);
  // The square of round-off.
  CHECK(energy.strain < 1e-28 * data.stiffness.norm());
  CHECK(energy.dissipation < 1e-28 * data.damping.norm());
  // A rigid body with the same mass, centre of mass and inertia.
  const Vector3 S = data.first_moment.col(0);
  Matrix3 Gamma;
  for (int p = 0; p < 3; ++p)
    for (int r = 0; r < 3; ++r) Gamma(p, r) = data.second_moment[static_cast<std::size_t>(3 * p + r)](0, 0);
  Matrix6 I;
  I << Gamma.trace() * Matrix3::Identity() - Gamma, skew(S), -skew(S), data.mass * Matrix3::Identity();
  const Vector6 h = I * base.V, rigid = I * base.A + cross_force(base.V, h);
  CHECK(energy.kinetic == doctest::Approx(0.5 * base.V.dot(h)).epsilon(kRoundOff));
  CHECK(energy.potential == doctest::Approx(-g.dot(data.mass * base.X_WF.r + base.X_WF.R * S)).epsilon(kRoundOff));
  ElasticResponse response;
  body.evaluate(motion, false, response);
  Vector6 wrench = Vector6::Zero();
  for (int i = 0; i < body.frame_count(); ++i)
    wrench += force_transform(body.rest_pose(i)) * response.force.segment<6>(6 * i);
  CHECK((wrench - rigid).norm() < kRoundOff * rigid.norm());
}

}  // namespace modal_body_test
}  // namespace hersey::mbd
