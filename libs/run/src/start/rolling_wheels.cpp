#include "start/rolling_wheels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::run {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kOneAxis = 1e-6;  // of an angular velocity across the wheel's axis; its centre's over the radius
constexpr double kFollows = 1e-9;  // of a rotation that constraints let other coordinates follow: round-off
constexpr double kInRatio = 1e-9;  // of the speed at the base circle: round-off of a few rotations
constexpr double kRpm = std::numbers::pi / 30;

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
  /// The larger of the wheels' speeds at the base circles [m/s].
  [[nodiscard]] double rolling_speed(const solver::State& state) const {
    return std::max(std::abs(speed(state, 0) * radius(0)), std::abs(speed(state, 1) * radius(1)));
  }
  [[nodiscard]] bool is_first_faster(const solver::State& state) const {
    return std::abs(speed(state, 0) * radius(0)) > std::abs(speed(state, 1) * radius(1));
  }
  /// Rate at which the flanks press into each other [m/s].
  [[nodiscard]] double approach(const solver::State& state) const {
    return mesh.mesh->approach(mechanism.relative_motion(state, mesh.force));
  }
};

/// Velocity components of one joint that rotate bodies: one, or three of a rotation in space; from ground outwards.
/// Those that a spring holds are left out: nothing rotates on by them.
std::vector<std::vector<Index>> rotations_of(const mbd::Mechanism& mechanism) {
  const std::vector<Index> held = mechanism.sprung_coordinates();
  std::vector<std::vector<Index>> rotations;
  for (const Index k : mechanism.revolutions())
    if (std::find(held.begin(), held.end(), k) == held.end()) rotations.push_back({k});
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

/// How a wheel may roll.
struct Rolling {
  std::vector<Index> columns;  ///< of the joint by which it rotates; empty: no joint lets it
  VectorXd rotation;           ///< velocities of the joint at which the wheel rotates at 1 rad/s
  double approach = 0;         ///< of the flanks then [m/s]
  bool deforms = false;        ///< only a node of a flexible shaft rotates then
  bool is_driven = false;      ///< constraints prescribe the rotation

  /// In a run in time the nodes of flexible shafts may move by coordinates of their own, and a joint with them by none.
  [[nodiscard]] bool may_roll() const { return !columns.empty() && !is_driven; }
  [[nodiscard]] bool can_roll() const { return may_roll() && !deforms; }
};

/// True unless the constraints let the columns move by `rotation` while all others follow.
bool do_constraints_prescribe(mbd::Mechanism& mechanism, const solver::State& state, const std::vector<Index>& columns,
                              const VectorXd& rotation) {
  if (mechanism.nlambda() == 0) return false;
  VectorXd phi, scale;
  solver::Equations::SparseMatrix G;
  mechanism.constraints(state, phi, scale, &G);
  const VectorXd open = G * rotation;
  if (open.isZero(0)) return false;
  Eigen::MatrixXd others(G);
  for (const Index column : columns) others.col(column).setZero();
  const VectorXd following = others.completeOrthogonalDecomposition().solve(open);
  return (others * following - open).norm() > kFollows * open.norm();
}

/// By the first joint from ground that can, one about one axis before one in space, as housings have them on their
/// mounts; driven if any that can is.
Rolling rolling_of(const Wheels& wheels, int wheel, const solver::State& state) {
  const std::vector<Index> elastic = wheels.mechanism.elastic_coordinates();
  const double whole = std::abs(wheels.radius(wheel) * std::cos(wheels.mesh.mesh->data().base_helix));
  const auto rank = [](const Rolling& one) { return std::pair(one.deforms, one.columns.size()); };
  Rolling best;
  bool is_driven = false;
  for (const std::vector<Index>& columns : rotations_of(wheels.mechanism)) {
    Rolling one;
    one.columns = columns;
    one.rotation = rotation_of_wheel(wheels, wheel, columns, state);
    if (one.rotation.size() == 0) continue;
    solver::State rotating = state;
    rotating.v = one.rotation;
    one.approach = wheels.approach(rotating);
    if (std::abs(one.approach) < 0.5 * whole) continue;  // both wheels rotate with it
    one.deforms = std::find(elastic.begin(), elastic.end(), columns.front()) != elastic.end();
    if (!one.deforms && do_constraints_prescribe(wheels.mechanism, state, columns, one.rotation)) is_driven = true;
    if (best.columns.empty() || rank(one) < rank(best)) best = std::move(one);
  }
  best.is_driven = is_driven;
  return best;
}

/// A mesh and how its wheels may roll.
struct RollingMesh {
  RollingMesh(const model::BuiltMesh& mesh, mbd::Mechanism& mechanism, const solver::State& state)
      : wheels{mesh, mechanism}, rolling{rolling_of(wheels, 0, state), rolling_of(wheels, 1, state)} {}

  [[nodiscard]] bool may_roll() const { return rolling[0].may_roll() || rolling[1].may_roll(); }
  [[nodiscard]] bool misses(const solver::State& state, double share) const {
    return std::abs(wheels.approach(state)) > share * wheels.rolling_speed(state);
  }

  Wheels wheels;
  std::array<Rolling, 2> rolling;
};

/// Lets wheels roll one after the other, from those that drives rotate outwards.
class Roller {
 public:
  Roller(const model::Machine& machine, solver::State& state, double largest) : state_(state), largest_(largest) {
    for (const model::BuiltMesh& mesh : machine.gear_meshes) pending_.emplace_back(mesh, *machine.mechanism, state);
  }

  std::vector<Index> roll_all() {
    while (!pending_.empty()) {
      auto next = std::find_if(pending_.begin(), pending_.end(),
                               [&](const RollingMesh& mesh) { return is_settled(mesh, 0) || is_settled(mesh, 1); });
      if (next == pending_.end()) {  // no drive rotates any of them: the faster wheel keeps its speed
        next = std::max_element(pending_.begin(), pending_.end(), [&](const RollingMesh& a, const RollingMesh& b) {
          return a.wheels.rolling_speed(state_) < b.wheels.rolling_speed(state_);
        });
        settle(next->rolling[next->wheels.is_first_faster(state_) ? 0 : 1]);
      }
      for (const int wheel : {1, 0})
        if (!is_settled(*next, wheel)) roll(*next, next->rolling[static_cast<std::size_t>(wheel)]);
      pending_.erase(next);
    }
    return changed_;
  }

 private:
  [[nodiscard]] bool is_settled(const RollingMesh& mesh, int wheel) const {
    const Rolling& rolling = mesh.rolling[static_cast<std::size_t>(wheel)];
    return !rolling.can_roll() || settled_.contains(rolling.columns.front());
  }

  void settle(const Rolling& rolling) { settled_.insert(rolling.columns.front()); }

  void roll(const RollingMesh& mesh, const Rolling& rolling) {
    settle(rolling);
    const double approach = mesh.wheels.approach(state_);
    if (!mesh.misses(state_, kInRatio) || mesh.misses(state_, largest_)) return;
    state_.v -= approach / rolling.approach * rolling.rotation;
    changed_.insert(changed_.end(), rolling.columns.begin(), rolling.columns.end());
  }

  solver::State& state_;
  double largest_;
  std::list<RollingMesh> pending_;
  std::set<Index> settled_;  // first components of joints whose wheels have their speeds
  std::vector<Index> changed_;
};

constexpr std::array<const char*, 2> kWheelNames{"first", "second"};

/// Speed at which a wheel would roll while all else moves as it does [rpm].
double speed_to_roll(const RollingMesh& mesh, int wheel, const solver::State& state) {
  const Rolling& rolling = mesh.rolling[static_cast<std::size_t>(wheel)];
  return (mesh.wheels.speed(state, wheel) - mesh.wheels.approach(state) / rolling.approach) / kRpm;
}

/// Of a mesh with a wheel that can roll: which speeds to give.
void advise_speeds(const RollingMesh& mesh, const solver::State& state, Fault& fault) {
  std::vector<std::string> speeds, rates;
  for (const int wheel : {1, 0}) {
    const Rolling& rolling = mesh.rolling[static_cast<std::size_t>(wheel)];
    if (!rolling.may_roll()) continue;
    speeds.push_back(fmt::format("{:.6g} rpm of the {}", speed_to_roll(mesh, wheel, state),
                                 kWheelNames[static_cast<std::size_t>(wheel)]));
    const Index column = rolling.columns.front();
    const std::string name = mesh.wheels.mechanism.name_of_row(column);
    const double rate = state.v[column] - mesh.wheels.approach(state) / rolling.approach * rolling.rotation[column];
    if (rolling.deforms)
      rates.emplace_back("the joint of the shaft this speed");
    else if (rolling.columns.size() == 1)
      rates.push_back(fmt::format("{} {:.6g} rpm", name, rate / kRpm));
    else
      rates.push_back(name.substr(0, name.find(',')) + " this speed");
  }
  fault.expected = fmt::format("speeds at which they roll: {}", fmt::join(speeds, ", or "));
  fault.suggestion = fmt::format(
      "give {} under `initial`, as `rotation_rate` or `angular_velocity`, or let the drive start from rest by `ramp`",
      fmt::join(rates, ", or "));
}

/// Of a mesh whose wheels have to move as they do.
void advise_freedom(const RollingMesh& mesh, const solver::State& state, Fault& fault) {
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    if (!mesh.rolling[wheel].columns.empty()) continue;
    fault.found += fmt::format("; no joint lets the {} wheel rotate", kWheelNames[wheel]);
    fault.expected = "wheels that can rotate about the z-axes of their frames";
    fault.suggestion =
        "name the body and frame of the wheel under `between`, and give it a joint that lets it rotate and that no "
        "spring holds";
  }
  if (!fault.expected.empty()) return;
  fault.found += "; drives rotate both";
  fault.expected =
      fmt::format("speeds in the ratio of the teeth: {:.10g} rpm of the second, or {:.10g} rpm of the first",
                  speed_to_roll(mesh, 1, state), speed_to_roll(mesh, 0, state));
  fault.suggestion = "remove one of the drives: the teeth drive the other wheel";
}

}  // namespace

std::vector<Index> roll_wheels(const model::Machine& machine, solver::State& state, double largest) {
  return Roller(machine, state, largest).roll_all();
}

void require_rolling_wheels(const model::Model& model, const model::Machine& machine, const solver::State& state) {
  std::vector<Fault> faults;
  for (const model::BuiltMesh& built : machine.gear_meshes) {
    const RollingMesh mesh(built, *machine.mechanism, state);
    if (!mesh.misses(state, mesh.may_roll() ? kRoundedSpeed : kInRatio)) continue;
    Fault fault;
    fault.path = "forces." + built.name;
    fault.position = model.position_of(fault.path);
    const auto shown = [&](int wheel) { return mesh.wheels.speed(state, wheel) / kRpm + 0.0; };  // no -0
    fault.found = fmt::format(
        "wheels that do not roll in their ratio at the start: the first at {:.6g} rpm, the second at {:.6g} rpm",
        shown(0), shown(1));
    if (mesh.may_roll())
      advise_speeds(mesh, state, fault);
    else
      advise_freedom(mesh, state, fault);
    faults.push_back(std::move(fault));
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace hersey::run
