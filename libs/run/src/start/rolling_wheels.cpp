#include "start/rolling_wheels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kOneAxis = 1e-6;      // of an angular velocity across the wheel's axis; its centre's over the radius
constexpr double kStandsStill = 1e-9;  // of the other wheel's speed at the base circle
constexpr double kOutOfRatio = 0.01;   // of the speed at the base circle

/// A gear mesh with the frames of its wheels.
struct Wheels {
  const model::BuiltMesh& mesh;
  mbd::Mechanism& mechanism;

  [[nodiscard]] mbd::FrameId frame(int wheel) const {
    const mbd::MechanismSpec::Force& force = mechanism.spec().forces[static_cast<std::size_t>(mesh.force.index)];
    return wheel == 0 ? force.a : force.b;
  }
  [[nodiscard]] double radius(int wheel) const {
    return mesh.mesh->data().base_radius[static_cast<std::size_t>(wheel)];
  }
  /// Angular velocity about its axis [rad/s].
  [[nodiscard]] double speed(const solver::State& state, int wheel) const {
    const mbd::FrameMotion motion = mechanism.frame_motion(state, frame(wheel));
    return motion.omega.dot(motion.X_WF.R.col(2));
  }
  /// Rate at which the flanks press into each other [m/s].
  [[nodiscard]] double approach(const solver::State& state) const {
    return mesh.mesh->approach(mechanism.relative_motion(state, mesh.force));
  }
};

/// Velocity components of one joint that rotate bodies: one, or three of a rotation in space; from ground outwards.
std::vector<std::vector<Index>> rotations_of(const mbd::Mechanism& mechanism) {
  std::vector<std::vector<Index>> rotations;
  for (const Index k : mechanism.revolutions()) rotations.push_back({k});
  for (const Index k : mechanism.rotations_in_space()) rotations.push_back({k, k + 1, k + 2});
  std::sort(rotations.begin(), rotations.end());
  return rotations;
}

/// Velocities by which a joint rotates a wheel about its axis at 1 rad/s; empty if it does not.
VectorXd rotation_of_wheel(const Wheels& wheels, int wheel, const std::vector<Index>& columns,
                           const solver::State& state) {
  const auto count = static_cast<Index>(columns.size());
  Eigen::Matrix3Xd omega(3, count), v(3, count);
  solver::State moving = state;
  Vector3 axis;
  for (Index i = 0; i < count; ++i) {
    moving.v = VectorXd::Unit(state.v.size(), columns[static_cast<std::size_t>(i)]);
    const mbd::FrameMotion motion = wheels.mechanism.frame_motion(moving, wheels.frame(wheel));
    omega.col(i) = motion.omega, v.col(i) = motion.v, axis = motion.X_WF.R.col(2);
  }
  const VectorXd rates = omega.colPivHouseholderQr().solve(axis);
  if (!rates.allFinite() || (omega * rates - axis).norm() > kOneAxis) return {};
  if ((v * rates).norm() > kOneAxis * wheels.radius(wheel)) return {};
  VectorXd all = VectorXd::Zero(state.v.size());
  for (Index i = 0; i < count; ++i) all[columns[static_cast<std::size_t>(i)]] = rates[i];
  return all;
}

/// Lets the wheel roll by the first joint from ground that can; returns false if none does.
bool roll(const Wheels& wheels, int wheel, solver::State& state) {
  for (const std::vector<Index>& columns : rotations_of(wheels.mechanism)) {
    const VectorXd rotation = rotation_of_wheel(wheels, wheel, columns, state);
    if (rotation.size() == 0) continue;
    solver::State rotating = state;
    rotating.v = rotation;
    const double by_rotation = wheels.approach(rotating);
    if (std::abs(by_rotation) < 0.5 * std::abs(wheels.radius(wheel) * std::cos(wheels.mesh.mesh->data().base_helix)))
      continue;  // both wheels rotate with it
    state.v -= wheels.approach(state) / by_rotation * rotation;
    return true;
  }
  return false;
}

}  // namespace

void roll_wheels(const model::Machine& machine, solver::State& state) {
  for (std::size_t pass = 0; pass < machine.meshes.size(); ++pass) {
    bool any = false;
    for (const model::BuiltMesh& mesh : machine.meshes) {
      const Wheels wheels{mesh, *machine.mechanism};
      const double first = std::abs(wheels.speed(state, 0) * wheels.radius(0)),
                   second = std::abs(wheels.speed(state, 1) * wheels.radius(1));
      if (second < kStandsStill * first) any = roll(wheels, 1, state) || any;
      if (first < kStandsStill * second) any = roll(wheels, 0, state) || any;
    }
    if (!any) return;
  }
}

void require_rolling_wheels(const model::Model& model, const model::Machine& machine, const solver::State& state) {
  std::vector<Fault> faults;
  for (const model::BuiltMesh& mesh : machine.meshes) {
    const Wheels wheels{mesh, *machine.mechanism};
    const double first = wheels.speed(state, 0), second = wheels.speed(state, 1);
    const double size = std::max(std::abs(first * wheels.radius(0)), std::abs(second * wheels.radius(1)));
    const double approach = wheels.approach(state);
    if (std::abs(approach) <= kOutOfRatio * size) continue;
    const std::array<int, 2>& teeth = mesh.mesh->data().teeth;
    constexpr double kRpm = std::numbers::pi / 30;
    const std::string path = "forces." + mesh.name;
    faults.push_back({model.position_of(path), path,
                      fmt::format("wheels that do not roll in their ratio at the start: the first at {:.6g} rpm, the "
                                  "second at {:.6g} rpm",
                                  first / kRpm, second / kRpm),
                      fmt::format("speeds in the ratio of the teeth: {:.6g} rpm of the second, or {:.6g} rpm of the "
                                  "first wheel",
                                  -first / kRpm * teeth[0] / teeth[1], -second / kRpm * teeth[1] / teeth[0]),
                      "give the joint of the wheel that no drive rotates its speed under `initial`, as "
                      "`rotation_rate`, or let the drive start from rest by `ramp`"});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace hersey::run
