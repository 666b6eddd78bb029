#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/mbd/mechanism.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/spring_damper.h"

/// Mechanisms of the IFToMM library of benchmark problems (University of A Coruna, lim.ii.udc.es/mbsbenchmark), for
/// tests and benchmarks.
namespace hersey::mbd::test {

constexpr double kPi = std::numbers::pi;

/// A01: a point mass of 1 kg on a massless rod of 1 m, released level.
inline std::unique_ptr<Mechanism> simple_pendulum() {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const BodyId bob = b.add_body({.name = "bob", .mass = 1});
  b.add_joint({.name = "pivot",
               .type = JointType::revolute,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.add_frame({.name = "pivot", .body = bob, .X_BF = {Matrix3::Identity(), {0, 1, 0}}}),
               .initial = {0.5 * kPi}});
  return b.finalise();
}

/// Initial state of joint i of `chain`.
inline double chain_angle(int i) { return i == 0 ? -0.3 : 0.05 * std::sin(0.7 * i); }

/// A hanging chain of rods of 0.1 m and 0.1 kg on hinges, the first of them swinging at 1 rad/s, cut wherever more than
/// `longest_path` coordinates move a rod.
/// @param reversed  each rod is the inboard body of its joint
inline std::unique_ptr<Mechanism> chain(int links, int longest_path, bool reversed = false) {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  b.cut_paths(longest_path);
  FrameId end = b.frame_of(b.ground());
  for (int i = 0; i < links; ++i) {
    const std::string name = "rod" + std::to_string(i);
    const BodyId rod = b.add_body(
        {.name = name, .mass = 0.1, .com = {0, -0.05, 0}, .inertia = Vector3(1e-4, 1e-5, 1e-4).asDiagonal()});
    const double sign = reversed ? -1 : 1;
    b.add_joint({.name = "hinge" + std::to_string(i),
                 .type = JointType::revolute,
                 .inboard = reversed ? b.frame_of(rod) : end,
                 .outboard = reversed ? end : b.frame_of(rod),
                 .axis = Vector3(0, 0, sign),
                 .initial = {chain_angle(i)},
                 .initial_rate = {i == 0 ? 1.0 : 0.0}});
    end = b.add_frame({.name = "end", .body = rod, .X_BF = {Matrix3::Identity(), {0, -0.1, 0}}});
  }
  return b.finalise();
}

/// A02: N four-bar loops of uniform rods of 1 m and 1 kg, cranks upright, the first coupler point at 1 m/s. Cylindrical
/// and spherical coupler joints close each loop in space without redundancy.
/// With `hinges` all joints are revolute, and three constraints of each loop redundant.
inline std::unique_ptr<Mechanism> four_bars(int N, bool hinges = false) {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const auto rod = [&](const std::string& name) {
    return b.add_body(
        {.name = name, .mass = 1, .com = {0.5, 0, 0}, .inertia = Vector3(0, 1.0 / 12, 1.0 / 12).asDiagonal()});
  };
  std::vector<FrameId> tops;
  for (int i = 0; i <= N; ++i) {
    const BodyId crank = rod("crank" + std::to_string(i));
    const FrameId foot =
        b.add_frame({.name = "foot", .body = b.ground(), .X_BF = {Matrix3::Identity(), {double(i), 0, 0}}});
    b.add_joint({.name = "foot" + std::to_string(i),
                 .type = JointType::revolute,
                 .inboard = foot,
                 .outboard = b.frame_of(crank),
                 .initial = {0.5 * kPi},
                 .initial_rate = {-1}});
    tops.push_back(b.add_frame({.name = "top", .body = crank, .X_BF = {Matrix3::Identity(), {1, 0, 0}}}));
  }
  for (int i = 0; i < N; ++i) {
    const BodyId coupler = rod("coupler" + std::to_string(i));
    b.add_joint({.name = "left" + std::to_string(i),
                 .type = hinges ? JointType::revolute : JointType::cylindrical,
                 .inboard = tops[i],
                 .outboard = b.frame_of(coupler),
                 .initial = hinges ? std::vector<double>{-0.5 * kPi} : std::vector<double>{0, -0.5 * kPi},
                 .initial_rate = hinges ? std::vector<double>{1} : std::vector<double>{0, 1}});
    b.add_joint({.name = "right" + std::to_string(i),
                 .type = hinges ? JointType::revolute : JointType::spherical,
                 .inboard = b.add_frame({.name = "end", .body = coupler, .X_BF = {Matrix3::Identity(), {1, 0, 0}}}),
                 .outboard = tops[i + 1]});
  }
  return b.finalise();
}

/// A04, Bricard's mechanism: five rods of 1 m and 1 kg and ground in a loop of six hinges, each perpendicular to the
/// one before; one freedom and one redundant constraint.
inline std::unique_ptr<Mechanism> bricard() {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const std::array<Vector3, 5> along{Vector3(1, 0, 0), {0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}};
  FrameId end = b.frame_of(b.ground());
  for (int i = 0; i < 5; ++i) {
    const Vector3 e = along[i];
    const Vector3 inertia = Vector3::Constant(1.0 / 12) - e.cwiseAbs() / 12;
    const BodyId rod =
        b.add_body({.name = "rod" + std::to_string(i), .mass = 1, .com = 0.5 * e, .inertia = inertia.asDiagonal()});
    b.add_joint({.name = "hinge" + std::to_string(i),
                 .type = JointType::revolute,
                 .inboard = end,
                 .outboard = b.frame_of(rod),
                 .axis = Vector3::Unit((i + 1) % 3)});
    end = b.add_frame({.name = "end", .body = rod, .X_BF = {Matrix3::Identity(), e}});
  }
  b.add_joint({.name = "last",
               .type = JointType::revolute,
               .inboard = end,
               .outboard = b.add_frame({.name = "last", .body = b.ground(), .X_BF = {Matrix3::Identity(), {0, 0, 1}}}),
               .axis = Vector3::UnitX()});
  return b.finalise();
}

/// A05: a shaft that rotates freely, two arms hinged 1 m up and 0.05 m off it, a slider on it that stiff spring-dampers
/// hold to the arms' middles. Rods and slider of density 3000 kg/m^3: 0.01 x 0.01 x 1 m and a cube of 0.1 m.
inline std::unique_ptr<Mechanism> governor() {
  MechanismBuilder b;
  b.set_gravity({0, 0, -9.81});
  const auto frame = [&](BodyId body, const Matrix3& R, const Vector3& r) {
    return b.add_frame({.name = "f", .body = body, .X_BF = {R, r}});
  };
  const double rod = 0.3, thin = rod * 0.01 * 0.01 / 6, along = rod * (1 + 0.01 * 0.01) / 12;
  const BodyId shaft = b.add_body(
      {.name = "shaft", .mass = rod, .com = {0, 0, 0.5}, .inertia = Vector3(along, along, thin).asDiagonal()});
  b.add_joint({.name = "axle",
               .type = JointType::revolute,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.frame_of(shaft),
               .initial = {0},
               .initial_rate = {2 * kPi}});
  const BodyId slider =
      b.add_body({.name = "slider", .mass = 3, .inertia = Matrix3(Vector3::Constant(3 * 0.01 / 6).asDiagonal())});
  b.add_joint({.name = "sleeve",
               .type = JointType::prismatic,
               .inboard = b.frame_of(shaft),
               .outboard = b.frame_of(slider),
               .initial = {0.5}});
  // An arm with its tip mass at x = 1 m.
  const double mass = rod + 5, centre = (0.5 * rod + 5) / mass;
  const double across = along + rod * (centre - 0.5) * (centre - 0.5) + 5 * (1 - centre) * (1 - centre);
  for (double side : {1.0, -1.0}) {
    const BodyId arm = b.add_body({.name = side > 0 ? "right" : "left",
                                   .mass = mass,
                                   .com = {centre, 0, 0},
                                   .inertia = Vector3(thin, across, across).asDiagonal()});
    const Matrix3 outward = Eigen::AngleAxisd(side > 0 ? 0 : kPi, Vector3::UnitZ()).toRotationMatrix();
    // Positive angles lower the arm below the horizontal.
    b.add_joint({.name = side > 0 ? "right" : "left",
                 .type = JointType::revolute,
                 .inboard = frame(shaft, outward, {0.05 * side, 0, 1}),
                 .outboard = b.frame_of(arm),
                 .axis = {0, 1, 0},
                 .initial = {kPi / 6}});
    b.add_force(side > 0 ? "right" : "left", frame(arm, Matrix3::Identity(), {0.5, 0, 0}),
                frame(slider, Matrix3::Identity(), {0.05 * side, 0, 0}), std::make_shared<SpringDamper>(8e5, 4e4, 0.5));
  }
  return b.finalise();
}

/// A03: Andrews' squeezer as in the test set for IVP solvers (Mazzia and Magherini, release 2.4, problem "andrews"):
/// seven plane bodies, three loops that meet in one point, a motor torque and a spring; no gravity.
class Squeezer {
 public:
  Squeezer() {
    hinge("beta", JointType::revolute, ground_at(0, 0), add("K1", 0.04325, 2.194e-6, {ra, 0}), -0.06171389001427645);
    // K2 points from the crank's tip backwards: its x axis is minus the direction of beta + Theta.
    add("K2", 0.00365, 4.410e-7, {-da, 0});
    hinge("Theta", JointType::revolute, at(last_ - 1, rr, 0), {last_}, 0);
    const FrameId E = at(last_, -d, 0);
    add("K3", 0.02373, 5.255e-6, {sa, sb});
    hinge("gamma", JointType::cylindrical, ground_at(xb, yb), {last_}, 0.45527981916307037);
    const FrameId D = at(last_, sd, -sc);
    close("E3", E, at(last_, 0, -ss));
    add("K5", 0.07050, 1.169e-5, {ta, tb});
    hinge("delta", JointType::revolute, ground_at(xa, ya), {last_}, 0.48736497954384256);
    const FrameId G = at(last_, zt, 0);
    add("K4", 0.00706, 5.667e-7, {0, -(e - ea)});
    hinge("Phi", JointType::cylindrical, G, {last_}, 0.22266839016588588);
    close("E4", E, at(last_, 0, -e));
    add("K7", 0.05498, 1.912e-5, {ua, ub});
    hinge("epsilon", JointType::revolute, ground_at(xa, ya), {last_}, 1.2305474445498212);
    const FrameId H = at(last_, 0, -u);
    add("K6", 0.00706, 5.667e-7, {zf - fa, 0});
    hinge("Omega", JointType::cylindrical, H, {last_}, -0.22266839016588588);
    close("E6", E, at(last_, zf, 0));
    b_.add_force("spring", ground_at(0.014, 0.072), D, std::make_shared<SpringDamper>(4530, 0, 0.07785));
    b_.add_load(
        {.name = "motor",
         .frame = at(1, 0, 0),
         .axes = LoadAxes::ground,
         .terms = {{(Vector6() << 0, 0, 1, 0, 0, 0).finished(), std::make_shared<ConstantFunction>(0.033), {}}}});
    mechanism = b_.finalise();
  }

  /// Angle of the named joint: the last of its values.
  [[nodiscard]] double angle(const Observation& observation, const std::string& name) const {
    for (std::size_t j = 0; j < observation.joints.size(); ++j)
      if (mechanism->spec().joints[j].name == name) return observation.joints[j].position.tail<1>()[0];
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::unique_ptr<Mechanism> mechanism;

 private:
  BodyId add(const char* name, double mass, double inertia, const Eigen::Vector2d& com) {
    // Transverse moments do not matter to a plane motion.
    const BodyId id = b_.add_body({.name = name,
                                   .mass = mass,
                                   .com = {com.x(), com.y(), 0},
                                   .inertia = Vector3(0.6, 0.6, 1).asDiagonal() * inertia});
    last_ = id.index;
    return id;
  }
  FrameId at(int body, double x, double y) {
    return b_.add_frame({.name = "f", .body = {body}, .X_BF = {Matrix3::Identity(), {x, y, 0}}});
  }
  FrameId ground_at(double x, double y) { return at(0, x, y); }
  JointId hinge(const char* name, JointType type, FrameId inboard, BodyId body, double angle) {
    return b_.add_joint(
        {.name = name,
         .type = type,
         .inboard = inboard,
         .outboard = b_.frame_of(body),
         .initial = type == JointType::revolute ? std::vector<double>{angle} : std::vector<double>{0, angle}});
  }
  void close(const char* name, FrameId a, FrameId b) {
    b_.add_joint({.name = name, .type = JointType::spherical, .inboard = a, .outboard = b});
  }

  static constexpr double xa = -0.06934, ya = -0.00227, xb = -0.03635, yb = 0.03273, d = 0.028, da = 0.0115, e = 0.02,
                          ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035, sa = 0.01874, sb = 0.01043, sc = 0.018,
                          sd = 0.02, ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449, zf = 0.02,
                          zt = 0.04, fa = 0.01421;
  MechanismBuilder b_;
  int last_ = 0;
};

}  // namespace hersey::mbd::test
