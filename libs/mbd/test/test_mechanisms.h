#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <span>

#include "hersey/core/scalar_function.h"
#include "hersey/mbd/beam_segment.h"
#include "hersey/mbd/coordinate_laws.h"
#include "hersey/mbd/mechanism.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/modal_body.h"
#include "hersey/mbd/spring_damper.h"

/// Mechanisms and functions that several tests use.
namespace hersey::mbd::test {

/// a + b x + c sin(d x) + ... of each argument, multiplied: smooth and sensitive to every argument.
class WavyFunction final : public ScalarFunction {
 public:
  explicit WavyFunction(double size) : size_(size) {}
  [[nodiscard]] double value(std::span<const double> x) const override {
    double product = size_;
    for (double xi : x) product *= factor(xi);
    return product;
  }
  void gradient(std::span<const double> x, std::span<double> gradient) const override {
    for (std::size_t i = 0; i < x.size(); ++i) gradient[i] = value(x) / factor(x[i]) * 0.6 * std::cos(1.5 * x[i] + 0.3);
  }
  [[nodiscard]] double second_derivative(std::span<const double> x) const override {
    return value(x) / factor(x[0]) * -0.9 * std::sin(1.5 * x[0] + 0.3);
  }

 private:
  static double factor(double x) { return 2 + 0.4 * std::sin(1.5 * x + 0.3); }
  double size_;
};

/// A function of time given by its value, derivative and second derivative.
template <class F, class D, class D2>
class TimeFunction final : public ScalarFunction {
 public:
  TimeFunction(F f, D d, D2 d2) : f_(f), d_(d), d2_(d2) {}
  [[nodiscard]] double value(std::span<const double> x) const override { return f_(x[0]); }
  void gradient(std::span<const double> x, std::span<double> gradient) const override { gradient[0] = d_(x[0]); }
  [[nodiscard]] double second_derivative(std::span<const double> x) const override { return d2_(x[0]); }

 private:
  F f_;
  D d_;
  D2 d2_;
};

template <class F, class D, class D2>
std::shared_ptr<const ScalarFunction> time_function(F f, D d, D2 d2) {
  return std::make_shared<TimeFunction<F, D, D2>>(f, d, d2);
}

inline std::shared_ptr<const ScalarFunction> constant(double value) {
  return std::make_shared<ConstantFunction>(value);
}

/// A quadratic function: every derivative known.
class Quadratic final : public ScalarFunction {
 public:
  Quadratic(double constant, double linear, double quadratic) : a_(constant), b_(linear), c_(quadratic) {}
  [[nodiscard]] double value(std::span<const double> x) const override { return a_ + (b_ + c_ * x[0]) * x[0]; }
  void gradient(std::span<const double> x, std::span<double> g) const override { g[0] = b_ + 2 * c_ * x[0]; }
  [[nodiscard]] double second_derivative(std::span<const double>) const override { return 2 * c_; }

 private:
  double a_, b_, c_;
};

/// A linear force between two frames in all six directions, neither symmetric nor conservative but for its inertia: the
/// hardest case a film can present to the assembly.
class FullBushing final : public TwoBodyForce {
 public:
  FullBushing() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 36; ++i) {
      K_(i) = 40 * uniform(random);
      D_(i) = 7 * uniform(random);
    }
    Matrix6 root;
    for (int i = 0; i < 36; ++i) root(i) = 0.3 * uniform(random);
    M_ = root * root.transpose();
  }
  void evaluate(const RelativeMotion& motion, bool, ForceResponse& response) override {
    // A function of the pose whose derivative with respect to a twist is known: its columns R e_1, and r.
    const Vector3 d = motion.X_AB.R.col(0), r = motion.X_AB.r;
    Vector6 x;
    x << d, r;
    Matrix6 dx;  // dx/dxi: d' = phi x d, r' = rho + phi x r
    dx << -skew(d), Matrix3::Zero(), -skew(r), Matrix3::Identity();
    response.W_B_A = K_ * x + D_ * motion.V_AB_A - M_ * motion.A_AB_A;
    response.dW_dX = K_ * dx;
    response.dW_dV = D_;
    response.dW_dA = -M_;
  }

 private:
  Matrix6 K_, D_, M_;
};

/// A force that depends on the shapes of elastic bodies and acts on them: every component depends on everything.
class FullMembrane final : public TwoBodyForce {
 public:
  explicit FullMembrane(Eigen::Index amplitudes) : count_(amplitudes), c_(9 + 2 * amplitudes) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> uniform(-1, 1);
    A_.resize(6 + count_, c_.size());
    B_.resize(6 + count_);
    for (Eigen::Index i = 0; i < A_.size(); ++i) A_.data()[i] = 3 * uniform(random);
    for (auto& x : B_) x = 2 * uniform(random);
    for (auto& x : c_) x = 0.5 * uniform(random);
  }
  void evaluate(const RelativeMotion& motion, bool, ForceResponse& response) override {
    const Vector3 r = motion.X_AB.r;
    Eigen::VectorXd z(c_.size());
    z << r, motion.V_AB_A, motion.s, motion.s_rate;
    const Eigen::VectorXd F = A_ * z + B_ * std::sin(c_.dot(z));
    const Eigen::MatrixXd dF = A_ + B_ * std::cos(c_.dot(z)) * c_.transpose();
    Eigen::Matrix<double, 3, 6> dr;
    dr << -skew(r), Matrix3::Identity();
    response.set_zero(count_);
    response.W_B_A = F.head<6>();
    response.dW_dX = dF.topLeftCorner<6, 3>() * dr;
    response.dW_dV = dF.block<6, 6>(0, 3);
    response.dW_ds = dF.block(0, 9, 6, count_);
    response.dW_dr = dF.topRightCorner(6, count_);
    response.Q = F.tail(count_);
    response.dQ_dX = dF.bottomLeftCorner(count_, 3) * dr;
    response.dQ_dV = dF.block(6, 3, count_, 6);
    response.dQ_ds = dF.block(6, 9, count_, count_);
    response.dQ_dr = dF.bottomRightCorner(count_, count_);
  }

 private:
  Eigen::Index count_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd B_, c_;
};

inline Pose pose(const Vector3& rotation, const Vector3& r) { return {rotation_exp(rotation).toRotationMatrix(), r}; }

/// A modal body of random points, shapes and stiffness: nothing about it is symmetric, so no term hides. Three frames
/// and two shapes beyond them.
inline ModalBodyData random_modal_data() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto fill = [&](auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = uniform(random);
  };
  constexpr Eigen::Index nodes = 9, shapes = 14;
  Eigen::Matrix3Xd x(3, nodes);
  fill(x);
  Eigen::MatrixXd Phi(3 * nodes, shapes), root(nodes, nodes), K(shapes, shapes);
  fill(Phi);
  fill(root);
  fill(K);
  const Eigen::MatrixXd mass = 0.2 * (root * root.transpose() + Eigen::MatrixXd::Identity(nodes, nodes));
  ModalBodyData data;
  data.rest = {Pose{}, pose({0.3, -0.2, 0.5}, {0.7, 0.2, -0.1}), pose({-1.1, 0.4, 0.2}, {-0.3, 0.5, 0.4})};
  set_moments(data, mass.sparseView(), x, 0.3 * Phi);
  data.stiffness = 40 * K * K.transpose();
  data.damping = 0.02 * data.stiffness + 0.1 * Eigen::MatrixXd::Identity(shapes, shapes);
  return data;
}

/// A soft, damped piece of a beam with rotated section axes.
inline std::shared_ptr<BeamSegment> random_segment(double length) {
  BeamSegmentData data;
  data.element = {.length = length, .stiffness = {50, 30, 20, 3, 5, 7}};
  data.element.frame = rotation_exp({0.4, -0.9, 0.3}).toRotationMatrix();
  data.mass_per_length = 1.5;
  data.inertia_per_length = {0.7, 0.5, 0.3};
  data.damping = 0.1;
  return std::make_shared<BeamSegment>(data);
}

/// A mechanism with every joint type, in the tree and as a cut joint, in both directions; balls; loads of joint angles;
/// springs; drives; a force. @param membranes  with forces that depend on deformation, whose dense blocks are made anew
/// each time
inline std::unique_ptr<Mechanism> nasty_mechanism(bool membranes = true) {
  MechanismBuilder b;
  b.set_gravity({0.3, -9.81, 1.2});
  const auto body = [&](const char* name, double mass) {
    Matrix3 J;
    J << 0.11, 0.01, 0.02, 0.01, 0.13, -0.015, 0.02, -0.015, 0.09;
    return b.add_body({.name = name, .mass = mass, .com = {0.1, -0.05, 0.07 * mass}, .inertia = mass * J});
  };
  const BodyId arm = body("arm", 1.3), slider = body("slider", 0.7), plate = body("plate", 2.1), top = body("top", 0.9),
               hand = body("hand", 0.4), bob = body("bob", 0.6), flyer = body("flyer", 1.1),
               welded = body("welded", 0.5);
  const auto at = [&](BodyId id, const Vector3& rotation, const Vector3& r) {
    return b.add_frame({.name = "f", .body = id, .X_BF = pose(rotation, r)});
  };
  const auto join = [&](const char* name, JointType type, FrameId i, FrameId o, const Vector3& axis = {0, 0, 1},
                        const std::vector<double>& initial = {}, const std::vector<double>& rate = {}) {
    return b.add_joint({.name = name,
                        .type = type,
                        .inboard = i,
                        .outboard = o,
                        .axis = axis,
                        .initial = initial,
                        .initial_rate = rate,
                        .loose = std::vector<bool>(initial.size(), true),
                        .loose_rate = std::vector<bool>(rate.size(), true)});
  };
  // Every start is a guess that does not close the loops.
  const JointId pivot = join("pivot", JointType::revolute, at(b.ground(), {0.2, 0.1, 0}, {0.1, 0.2, 0.3}),
                             at(arm, {0, 0.3, 0.1}, {0.05, 0, 0}), {1, 2, 2}, {0.4}, {1.1});
  const JointId rail = join("rail", JointType::cylindrical, at(arm, {0, 0, 0.4}, {0.4, 0, 0.1}),
                            at(slider, {0.1, 0, 0}, {0, 0.1, 0}), {0, 1, 0}, {0.2, -0.5}, {0.3, -0.7});
  // Reversed: plate is reached from the slider, though it is the inboard body.
  join("ball", JointType::spherical, at(plate, {0.3, 0, 0.2}, {0.2, 0.1, 0}), at(slider, {0, 0.2, 0}, {0.3, 0, 0.1}),
       {0, 0, 1}, {0.3, -0.2, 0.5}, {0.5, 0.6, -0.4});
  join("table", JointType::planar, at(plate, {0, 0, 0}, {0, 0.2, 0.1}), at(top, {0.1, 0.1, 0}, {0, 0, 0.1}), {1, 0, 0},
       {0.1, -0.2, 0.6}, {0.2, 0.1, -0.9});
  join("guide", JointType::prismatic, at(hand, {0.2, 0, 0}, {0.1, 0, 0}), at(top, {0, 0.4, 0}, {0.1, 0.2, 0}),
       {0, 0.6, 0.8}, {0.15}, {-0.4});
  join("flight", JointType::free, at(flyer, {0.1, 0.2, 0.3}, {0.1, 0, 0}), at(b.ground(), {0, 0, 0.5}, {0.5, 0.1, 0}),
       {0, 0, 1}, {0.3, 0.2, -0.1, 0.4, 0.3, -0.6}, {0.1, -0.2, 0.3, 0.8, -0.5, 0.7});
  join("weld", JointType::fixed, at(flyer, {0.4, 0, 0}, {0, 0, 0.3}), at(welded, {0, 0.1, 0}, {0.1, 0, 0}));
  // A universal joint and a screw in the tree, both reversed or not, and both again closing loops.
  const BodyId cross = body("cross", 0.8), nut = body("nut", 0.3), drifter = body("drifter", 0.7);
  const JointId cardan = join("cardan", JointType::universal, at(cross, {0.1, 0.2, 0}, {0.1, 0, 0.2}),
                              at(welded, {0, 0.1, 0.2}, {0.2, 0.1, 0}), {0.3, 0, 1}, {0.4, -0.3}, {0.6, 0.5});
  const JointId spindle = b.add_joint({.name = "spindle",
                                       .type = JointType::screw,
                                       .inboard = at(cross, {0, 0.2, 0.1}, {0.1, 0.3, 0}),
                                       .outboard = at(nut, {0.2, 0, 0}, {0, 0.1, 0.1}),
                                       .axis = {0, 1, 1},
                                       .lead = 0.4,
                                       .initial = {0.7},
                                       .initial_rate = {-0.8},
                                       .loose = {true},
                                       .loose_rate = {true}});
  join("drift", JointType::free, b.frame_of(b.ground()), at(drifter, {0, 0.1, 0}, {0.1, 0, 0}), {0, 0, 1},
       {0.2, 0.1, 0.3, -0.2, 0.1, 0.3}, {0.3, 0.1, -0.2, 0.2, 0.4, -0.3});
  join("cardan_loop", JointType::universal, at(nut, {0.1, 0, 0}, {0, 0.2, 0}), at(drifter, {0, 0.1, 0}, {0.1, 0.1, 0}),
       {0, 0.5, 1});
  b.add_joint({.name = "screw_loop",
               .type = JointType::screw,
               .inboard = at(top, {0, 0.1, 0.1}, {0.1, 0, 0}),
               .outboard = at(drifter, {0, 0, 0.3}, {0, 0.2, 0.1}),
               .lead = -0.3});
  const JointId swing = join("swing", JointType::revolute, b.frame_of(b.ground()), at(bob, {0, 0, 0}, {0, 0.4, 0}),
                             {0, 1, 1}, {0.2}, {0.9});
  // A flexible body entered through its second frame, in a loop through its third; its first hangs on them.
  const FlexibleBodyIds bow =
      b.add_flexible_body("bow", {"grip", "tip"}, std::make_shared<ModalBody>(random_modal_data()));
  for (const LoadAxes axes : {LoadAxes::body, LoadAxes::ground})
    b.add_nodal_load(bow.elastic, {"gust", axes, Eigen::Matrix3Xd::Constant(3, 9, 0.7)},
                     std::make_shared<WavyFunction>(1.0));
  join("grip_hinge", JointType::revolute, at(slider, {0.2, 0, 0.3}, {0.1, 0.2, 0}),
       at(bow.bodies[1], {0, 0.2, 0}, {0, 0.1, 0.1}), {0, 1, 0.5}, {0.3}, {-0.4});
  join("tip_ball", JointType::spherical, at(bow.bodies[2], {0.1, 0, 0.1}, {0.1, 0, 0}),
       at(nut, {0, 0.1, 0.2}, {0.2, 0, 0.1}));
  const FlexibleBodyIds fin =
      b.add_flexible_body("fin", {"root", "edge"}, std::make_shared<ModalBody>(random_modal_data()));
  join("fin_hinge", JointType::revolute, at(drifter, {0.1, 0, 0.2}, {0, 0.2, 0.1}),
       at(fin.bodies[0], {0, 0.1, 0}, {0.1, 0.1, 0}), {0.2, 1, 0}, {0.2}, {0.6});
  if (membranes) {
    b.add_force("membrane", at(bow.bodies[2], {0.2, 0, 0.1}, {0.1, 0, 0.2}),
                at(fin.bodies[1], {0, 0.2, 0}, {0.1, 0.2, 0}), std::make_shared<FullMembrane>(28),
                {bow.elastic, fin.elastic});
    b.add_force("skin", at(hand, {0.2, 0, 0.1}, {0.1, 0, 0.2}), at(bow.bodies[0], {0, 0.2, 0}, {0.1, 0.2, 0}),
                std::make_shared<FullMembrane>(14), {.a = {}, .b = bow.elastic});
  }
  // A beam entered through its second node, in a loop through its last.
  const BeamBodyIds reed =
      b.add_beam_body("reed", {"1", "2", "3"}, {random_segment(0.4), random_segment(0.3), random_segment(0.5)});
  join("reed_hinge", JointType::revolute, at(plate, {0.1, 0, 0.2}, {0, 0.2, 0.1}),
       at(reed.bodies[1], {0, 0.3, 0}, {0.1, 0, 0}), {1, 0, 0.5}, {0.2}, {0.5});
  join("reed_ball", JointType::spherical, at(reed.bodies[3], {0.2, 0, 0.1}, {0, 0.1, 0}),
       at(hand, {0, 0.1, 0.2}, {0.1, 0, 0.2}));
  // Closing: one plain, one with a coordinate that a spring reads.
  join("loop", JointType::cylindrical, at(hand, {0, 0, 0.1}, {0.1, 0.1, 0.2}), at(bob, {0.2, 0.1, 0}, {0, -0.3, 0.1}),
       {1, 0, 1});
  const JointId tie = join("tie", JointType::revolute, at(top, {0, 0.1, 0}, {0.1, 0, 0}),
                           at(flyer, {0.2, 0.1, 0}, {0.1, 0.2, 0}), {0, 0, 1});
  b.add_spring({.name = "torsion", .coordinate = {tie, 0}, .stiffness = 30, .damping = 2, .free_position = 0.1});
  b.add_spring({.name = "coil", .coordinate = {rail, 0}, .stiffness = 500, .damping = 3, .free_position = 0.1});
  b.add_force("strut", at(arm, {0, 0, 0}, {0.2, 0.3, 0}), at(top, {0, 0, 0}, {0, 0.2, 0.2}),
              std::make_shared<SpringDamper>(200, 15, 0.2));
  b.add_force("bushing", at(slider, {0.4, 0, 0.1}, {0, 0.3, 0}), at(welded, {0, 0.2, 0}, {0.3, 0, 0}),
              std::make_shared<FullBushing>());
  const auto wavy = std::make_shared<WavyFunction>(3.0);
  Vector6 direction;
  direction << 0.3, -0.2, 0.5, 1.0, 0.4, -0.8;
  const std::vector<Variable> all{{Variable::Kind::time, {}},
                                  {Variable::Kind::position, {swing, 0}},
                                  {Variable::Kind::rate, {rail, 1}},
                                  {Variable::Kind::position, {pivot, 0}}};
  b.add_load({.name = "wind",
              .frame = at(hand, {0.1, 0, 0}, {0.2, 0, 0.1}),
              .axes = LoadAxes::ground,
              .terms = {{direction, wavy, all}}});
  b.add_load({.name = "jet",
              .frame = at(welded, {0.1, 0, 0}, {0.2, 0, 0.1}),
              .axes = LoadAxes::body,
              .terms = {{direction, wavy, all}, {2 * direction.reverse(), wavy, {}}}});
  b.add_coordinate_force("friction", {cardan, 1}, std::make_shared<JointFriction>(3, 0.5, 0.4));
  b.add_coordinate_force("stop", {spindle, 0},
                         std::make_shared<FunctionSpring>(std::make_shared<Quadratic>(1, 20, 30), 0.2));
  b.add_coordinate_force("governor", {swing, 0}, std::make_shared<SpeedController>(wavy, 2.0, 5.0, 1e3));
  b.add_coupling({.name = "gears",
                  .output = {cardan, 0},
                  .terms = {{{swing, 0}, std::make_shared<Quadratic>(0.1, -1.5, 0.4)},
                            {{rail, 0}, std::make_shared<Quadratic>(0, 2.5, 0)}}});
  b.add_drive({.name = "motor", .coordinate = {pivot, 0}, .kind = DriveSpec::Kind::speed, .function = wavy});
  return b.finalise();
}

/// A state of the nasty mechanism with nothing zero; not consistent, which derivatives do not need.
inline solver::State wild_state(const Mechanism& mechanism) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  solver::State s = mechanism.initial_state();
  s.t = 0.17;
  Eigen::VectorXd dq(mechanism.nv());
  for (auto& x : dq) x = 0.3 * uniform(random);
  const Eigen::VectorXd q0 = s.q;
  mechanism.retract(q0, dq, s.q);
  for (auto& x : s.v) x += uniform(random);
  for (auto& x : s.vdot) x = 3 * uniform(random);
  for (auto& x : s.lambda) x = 5 * uniform(random);
  return s;
}

}  // namespace hersey::mbd::test
