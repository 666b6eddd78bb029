// Every derivative a mechanism hands to the solver against finite differences of the function it is the derivative of.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "hersey/mbd/bushing.h"
#include "mechanisms_recursive_velocity.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace derivatives_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using solver::Stage;
using solver::State;

// Central differences with step 1e-5: truncation ~ step^2, round-off ~ eps/step, both about 1e-10 of the values' size.
constexpr double kStep = 1e-5;
constexpr double kRelative = 1e-8;  // a hundredfold of that

/// Residual at the state reached by increment x of the stage's unknowns, from start q_n.
VectorXd residual_at(Mechanism& m, const State& centre, const VectorXd& q_n, Stage stage, const VectorXd& x) {
  State s = centre;
  const Index nv = m.nv();
  stage.dq += stage.k * x.head(nv);
  m.retract(q_n, stage.dq, s.q);
  s.v += stage.c * x.head(nv);
  s.vdot += stage.m * x.head(nv);
  s.lambda += x.tail(m.nlambda());
  VectorXd r, scale;
  m.assemble(s, stage, r, scale, nullptr);
  return r;
}

void check_tangent(const Stage& given) {
  const auto m = test::nasty_mechanism();
  State state = test::wild_state(*m);
  const VectorXd q_n = state.q;
  Stage stage = given;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.4, 0.4);
  stage.dq.resize(m->nv());
  for (auto& x : stage.dq) x = uniform(random);
  m->retract(q_n, stage.dq, state.q);

  VectorXd r, scale;
  Mechanism::SparseMatrix tangent;
  m->assemble(state, stage, r, scale, &tangent);
  const MatrixXd J(tangent);
  const Index n = m->nv() + m->nlambda();
  MatrixXd numeric(n, n);
  for (Index j = 0; j < n; ++j) {
    VectorXd x = VectorXd::Zero(n);
    x[j] = kStep;
    numeric.col(j) = (residual_at(*m, state, q_n, stage, x) - residual_at(*m, state, q_n, stage, -x)) / (2 * kStep);
  }
  const double size = J.cwiseAbs().maxCoeff();
  Index row = 0, column = 0;
  const double worst = (J - numeric).cwiseAbs().maxCoeff(&row, &column) / size;
  CAPTURE(m->name_of_row(row));
  CAPTURE(m->name_of_row(column));
  CAPTURE(J(row, column));
  CAPTURE(numeric(row, column));
  CHECK(worst < kRelative);
  CHECK(size > 1);  // there is something to compare
}

TEST_CASE("Stiffness_MatchesFiniteDifferences") { check_tangent({.dt = 0, .k = 1, .c = 0, .m = 0, .dq = {}}); }
TEST_CASE("Damping_MatchesFiniteDifferences") { check_tangent({.dt = 0, .k = 0, .c = 1, .m = 0, .dq = {}}); }
TEST_CASE("Mass_MatchesFiniteDifferences") { check_tangent({.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}}); }
TEST_CASE("WholeTangent_MatchesFiniteDifferences") { check_tangent({.dt = 0, .k = 1, .c = 3, .m = 7, .dq = {}}); }

TEST_CASE("MassMatrix_IsSymmetricAndPositive") {
  const auto m = test::nasty_mechanism();
  State state = test::wild_state(*m);
  VectorXd r, scale;
  Mechanism::SparseMatrix tangent;
  m->assemble(state, {.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}}, r, scale, &tangent);
  const MatrixXd M = MatrixXd(tangent).topLeftCorner(m->nv(), m->nv());
  CHECK((M - M.transpose()).cwiseAbs().maxCoeff() < 100 * 2.2e-16 * M.cwiseAbs().maxCoeff());
  // Positive semidefinite: the massless link of the split joint has no inertia of its own.
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
  CHECK(eigenvalues.minCoeff() > -1e-12 * eigenvalues.maxCoeff());
}

TEST_CASE("ConstraintJacobian_MatchesFiniteDifferencesAndTangent") {
  const auto m = test::nasty_mechanism();
  const State state = test::wild_state(*m);
  VectorXd phi, plus, minus, scale, r;
  Mechanism::SparseMatrix G, tangent;
  m->constraints(state, phi, scale, &G);
  m->assemble(state, {.dt = 0, .k = 1, .c = 0, .m = 0, .dq = {}}, r, scale, &tangent);
  const MatrixXd dense(G);
  CHECK((phi - r.tail(m->nlambda())).norm() == 0);
  CHECK((MatrixXd(tangent).bottomLeftCorner(m->nlambda(), m->nv()) - dense).norm() == 0);
  CHECK((MatrixXd(tangent).topRightCorner(m->nv(), m->nlambda()).transpose() - dense).norm() == 0);
  for (Index k = 0; k < m->nv(); ++k) {
    State s = state;
    m->retract(state.q, VectorXd::Unit(m->nv(), k) * kStep, s.q);
    m->constraints(s, plus, scale, nullptr);
    m->retract(state.q, VectorXd::Unit(m->nv(), k) * -kStep, s.q);
    m->constraints(s, minus, scale, nullptr);
    CHECK(((plus - minus) / (2 * kStep) - dense.col(k)).cwiseAbs().maxCoeff() < kRelative);
  }
}

TEST_CASE("Difference_InvertsRetract") {
  const auto m = test::nasty_mechanism();
  const State state = test::wild_state(*m);
  VectorXd dq(m->nv()), moved;
  for (Index k = 0; k < dq.size(); ++k) dq[k] = 0.3 * std::sin(1.7 * static_cast<double>(k) + 1);
  m->retract(state.q, dq, moved);
  constexpr double round_off = 1e-12;  // of quaternions
  CHECK((m->difference(state.q, moved) - dq).cwiseAbs().maxCoeff() < round_off);
  CHECK((m->difference(moved, state.q) + m->difference(state.q, moved)).cwiseAbs().maxCoeff() < round_off);
}

/// The state that the motion through `centre` reaches `s` seconds later, to second order.
State drift(const Mechanism& m, const State& centre, double s) {
  State moved = centre;
  moved.t += s;
  m.retract(centre.q, s * centre.v + 0.5 * s * s * centre.vdot, moved.q);
  moved.v = centre.v + s * centre.vdot;
  return moved;
}

TEST_CASE("ConstraintRates_AreTimeDerivatives") {
  const auto m = test::nasty_mechanism();
  const State centre = test::wild_state(*m);
  VectorXd phi, plus, minus, scale, velocity, velocity_plus, velocity_minus, bias, unused;
  Mechanism::SparseMatrix G;
  m->constraints(centre, phi, scale, &G);
  m->constraints(drift(*m, centre, kStep), plus, scale, nullptr);
  m->constraints(drift(*m, centre, -kStep), minus, scale, nullptr);
  m->constraint_rates(centre, velocity, bias);
  m->constraint_rates(drift(*m, centre, kStep), velocity_plus, unused);
  m->constraint_rates(drift(*m, centre, -kStep), velocity_minus, unused);
  const VectorXd acceleration = G * centre.vdot + bias;
  CHECK(((plus - minus) / (2 * kStep) - velocity).cwiseAbs().maxCoeff() < kRelative * velocity.cwiseAbs().maxCoeff());
  CHECK(((velocity_plus - velocity_minus) / (2 * kStep) - acceleration).cwiseAbs().maxCoeff() <
        kRelative * acceleration.cwiseAbs().maxCoeff());
}

TEST_CASE("FrameVelocityAndAcceleration_AreTimeDerivatives") {
  const auto m = test::nasty_mechanism();
  const State centre = test::wild_state(*m);
  const int frames = static_cast<int>(m->spec().frames.size());
  for (int f = 0; f < frames; ++f) {
    CAPTURE(f);
    const FrameMotion now = m->frame_motion(centre, {f}), after = m->frame_motion(drift(*m, centre, kStep), {f}),
                      before = m->frame_motion(drift(*m, centre, -kStep), {f});
    const auto rate = [](const Vector3& a, const Vector3& b) { return Vector3((a - b) / (2 * kStep)); };
    const Vector3 rotation = rotation_log(Eigen::Quaterniond(after.X_WF.R * before.X_WF.R.transpose())) / (2 * kStep);
    CHECK((rate(after.X_WF.r, before.X_WF.r) - now.v).norm() < kRelative * (1 + now.v.norm()));
    CHECK((rotation - now.omega).norm() < kRelative * (1 + now.omega.norm()));
    CHECK((rate(after.v, before.v) - now.a).norm() < kRelative * (1 + now.a.norm()));
    CHECK((rate(after.omega, before.omega) - now.alpha).norm() < kRelative * (1 + now.alpha.norm()));
  }
}

TEST_CASE("B1AndB2_MatchFiniteDifferences") {
  const Vector3 axis = Vector3(1, -2, 0.5).normalized();
  const Pose X_iI = test::pose({0.3, 0.2, -0.4}, {0.1, 0.5, -0.2}),
             X_jO = test::pose({-0.1, 0.6, 0.2}, {0.3, -0.1, 0.4});
  const Pose X_Wi = test::pose({0.5, -0.3, 0.2}, {1, 2, 3});
  Vector6 Y_i;
  Y_i << 0.3, -0.7, 0.4, 1.1, -0.5, 0.2;
  const std::array<double, 6> start{0.3, -0.4, 0.5, 0.6, -0.2, 0.7}, rates{0.7, 0.4, -0.6, 0.2, 0.9, -0.3};
  constexpr double lead = 0.7;
  for (JointType type :
       {JointType::fixed, JointType::revolute, JointType::prismatic, JointType::cylindrical, JointType::spherical,
        JointType::planar, JointType::free, JointType::universal, JointType::screw}) {
    CAPTURE(std::string(name_of(type)));
    const int dof = degrees_of_freedom(type);
    const std::span<const double> q(start.data(), dof);
    const VectorXd qdot = VectorXd::Map(rates.data(), dof);
    // Pose of j in the world a time s later: i moves with the body velocity Y_i, the joint with qdot.
    const auto X_Wj = [&](double s) {
      std::vector<double> moved(q.begin(), q.end());
      for (int i = 0; i < dof; ++i) moved[i] += s * qdot[i];
      if (const auto orientation = find_coordinate(type, "orientation")) {
        const int o = orientation->offset;
        const Vector3 phi =
            rotation_log(rotation_exp(Vector3::Map(q.data() + o)) * rotation_exp(s * qdot.segment<3>(o)));
        Vector3::Map(moved.data() + o) = phi;
      }
      return X_Wi * pose_exp(s * Y_i) * X_iI * joint_pose(type, axis, moved, lead) * X_jO.inverse();
    };
    const Pose now = X_Wj(0), after = X_Wj(kStep), before = X_Wj(-kStep);
    Vector6 numeric;
    numeric << now.R.transpose() * rotation_log(Eigen::Quaterniond(after.R * before.R.transpose())) / (2 * kStep),
        now.R.transpose() * (after.r - before.r) / (2 * kStep);
    const auto relation = verification::recursive_velocity(type, axis, X_iI, X_jO, q, lead);
    CHECK((relation.B1 * Y_i + relation.B2 * qdot - numeric).norm() < kRelative);
  }
}

TEST_CASE("AcrossEveryJointOfTheTree_VelocitiesObeyB1AndB2") {
  const auto m = test::nasty_mechanism();
  const Observation observation = m->observe(test::wild_state(*m));
  const MechanismSpec& spec = m->spec();
  const std::vector<JointId> closing = m->closing_joints();
  const auto Y = [&](int body) {
    const FrameMotion& motion = observation.bodies[static_cast<std::size_t>(body)];
    return (Vector6() << motion.X_WF.R.transpose() * motion.omega, motion.X_WF.R.transpose() * motion.v).finished();
  };
  int in_tree = 0;
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const JointSpec& joint = spec.joints[j];
    CAPTURE(joint.name);
    const auto is_this = [&](JointId id) { return id.index == static_cast<int>(j); };
    if (std::any_of(closing.begin(), closing.end(), is_this)) continue;  // open: the state is no assembly
    ++in_tree;
    const FrameSpec& I = spec.frames[static_cast<std::size_t>(joint.inboard.index)];
    const FrameSpec& O = spec.frames[static_cast<std::size_t>(joint.outboard.index)];
    const JointValues &q = observation.joints[j].position, &rate = observation.joints[j].rate;
    const auto relation = verification::recursive_velocity(joint.type, joint.axis, I.X_BF, O.X_BF,
                                                           {q.data(), static_cast<std::size_t>(q.size())}, joint.lead);
    const Vector6 expected = relation.B1 * Y(I.body.index) + relation.B2 * rate, found = Y(O.body.index);
    // Round-off of chains of some twenty transformations.
    CHECK((found - expected).norm() < 1000 * std::numeric_limits<double>::epsilon() * (1 + found.norm()));
  }
  CHECK(in_tree > 10);
}

/// Both derivatives of a force between two frames, at a large rotation and a brisk motion.
void check_force_derivatives(TwoBodyForce& force, const Vector3& rotation) {
  RelativeMotion motion;
  motion.X_AB = test::pose(rotation, {0.4, -0.3, 0.2});
  motion.V_AB_A << 0.5, -0.8, 0.3, 0.7, 0.2, -0.6;
  ForceResponse centre;
  force.evaluate(motion, true, centre);
  for (int i = 0; i < 6; ++i) {
    const Vector6 xi = Vector6::Unit(i) * kStep;
    const auto at = [&](double sign, bool velocity) {
      RelativeMotion moved = motion;
      ForceResponse response;
      if (velocity) {
        moved.V_AB_A += sign * xi;
      } else {
        moved.X_AB = pose_exp(sign * xi) * moved.X_AB;
      }
      force.evaluate(moved, false, response);
      return response.W_B_A;
    };
    const double size = centre.dW_dX.cwiseAbs().maxCoeff();
    CHECK(((at(1, false) - at(-1, false)) / (2 * kStep) - centre.dW_dX.col(i)).norm() < kRelative * size);
    CHECK(((at(1, true) - at(-1, true)) / (2 * kStep) - centre.dW_dV.col(i)).norm() < kRelative * size);
  }
}

TEST_CASE("SpringDamper_DerivativesMatchFiniteDifferences") {
  SpringDamper linear(300, 20, 0.3), tabulated(300, 20, 0.3, std::make_shared<test::Quadratic>(5, -40, 700));
  check_force_derivatives(linear, {0.2, -0.4, 0.3});
  check_force_derivatives(tabulated, {0.2, -0.4, 0.3});
}

TEST_CASE("Bushing_DerivativesMatchFiniteDifferences") {
  Matrix6 root;
  for (int i = 0; i < 36; ++i) root(i) = std::sin(1.0 + 2.7 * i);
  Bushing bushing(50 * root * root.transpose(), 4 * root.transpose() * root);
  for (const Vector3& rotation : {Vector3(0, 0, 0), Vector3(1e-5, 2e-5, 0), Vector3(0.02, -0.03, 0.01),
                                  Vector3(0.06, 0, 0.01), Vector3(0.2, -0.4, 0.3), Vector3(1.2, -1.4, 1.3)})
    check_force_derivatives(bushing, rotation);
}

TEST_CASE("Bushing_IsTheGradientOfItsEnergyAndDissipates") {
  Matrix6 root;
  for (int i = 0; i < 36; ++i) root(i) = std::sin(1.0 + 2.7 * i);
  const Matrix6 K = 50 * root * root.transpose(), D = 4 * root.transpose() * root;
  Bushing elastic(K, Matrix6::Zero()), viscous(Matrix6::Zero(), D);
  RelativeMotion motion;
  motion.X_AB = test::pose({1.1, -0.9, 0.8}, {0.4, -0.3, 0.2});
  ForceResponse response;
  elastic.evaluate(motion, false, response);
  for (int i = 0; i < 6; ++i) {
    const auto energy = [&](double sign) {
      RelativeMotion moved = motion;
      moved.X_AB = pose_exp(sign * kStep * Vector6::Unit(i)) * moved.X_AB;
      return elastic.stored_energy(moved);
    };
    // Differences of step 1e-5 of an energy.
    CHECK(std::abs((energy(1) - energy(-1)) / (2 * kStep) + response.W_B_A[i]) < 1e-7 * response.W_B_A.norm());
    motion.V_AB_A = Vector6::Unit(i);
    viscous.evaluate(motion, false, response);
    CHECK(response.W_B_A.dot(motion.V_AB_A) < 0);
    motion.V_AB_A.setZero();
    elastic.evaluate(motion, false, response);
  }
  // A rotation by 180 degrees has no unique rotation vector.
  motion.X_AB = test::pose({0, 0, 3.1}, {0, 0, 0});
  elastic.evaluate(motion, false, response);
  CHECK_FALSE(elastic.domain_error().empty());
}

}  // namespace derivatives_test
}  // namespace hersey::mbd
