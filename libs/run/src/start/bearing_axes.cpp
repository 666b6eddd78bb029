#include "start/bearing_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "hersey/bearing/clearance.h"

namespace hersey::run {
namespace {

// A journal may be tilted within its clearance, and may rock there; a larger rotation means that it rotates about
// another axis.
constexpr double kRocking = 10;        // times that tilt, which a start's velocity reaches within the run
constexpr double kShareOfSpeed = 0.1;  // across the axis, of the velocity about it

/// Bodies that fixed joints make one.
class RigidGroups {
 public:
  explicit RigidGroups(const mbd::MechanismSpec& spec) : group_(spec.bodies.size()) {
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    for (const mbd::JointSpec& joint : spec.joints)
      if (joint.type == mbd::JointType::fixed) unite(body_of(spec, joint.inboard), body_of(spec, joint.outboard));
  }

  [[nodiscard]] std::size_t of(std::size_t body) const { return group_[body]; }

  static std::size_t body_of(const mbd::MechanismSpec& spec, mbd::FrameId frame) {
    return static_cast<std::size_t>(spec.frames[static_cast<std::size_t>(frame.index)].body.index);
  }

 private:
  void unite(std::size_t a, std::size_t b) {
    const std::size_t from = group_[a], to = group_[b];
    std::replace(group_.begin(), group_.end(), from, to);
  }

  std::vector<std::size_t> group_;
};

/// One bearing against the joints and the velocities of the start.
class AxisCheck {
 public:
  AxisCheck(const model::Model& model, const mbd::MechanismSpec& spec, const mbd::Observation& start)
      : model_(model), spec_(spec), start_(start), groups_(spec) {}

  void look_at(const model::Bearing& bearing, const mbd::MechanismSpec::Force& force, std::vector<Fault>& warnings) {
    const std::size_t shell = RigidGroups::body_of(spec_, force.a), journal = RigidGroups::body_of(spec_, force.b);
    const Vector3 axis = in_ground(force.a, Vector3::UnitZ());
    const double most = 2 * bearing::clearance(bearing.film) / bearing.film.L;  // the tilt by which the surfaces touch
    for (const mbd::JointSpec& joint : spec_.joints) {
      if (!mbd::rotates_about_one_axis(joint.type) || !joins(joint, shell, journal)) continue;
      const double angle = std::acos(std::min(1.0, std::abs(in_ground(joint.inboard, joint.axis).dot(axis))));
      if (slides_along(joint, angle, most)) continue;
      if (angle > most) return warnings.push_back(across(bearing, joint.name, angle));
    }
    const Vector3 relative = start_.bodies[journal].omega - start_.bodies[shell].omega;
    const double along = relative.dot(axis), side = (relative - along * axis).norm();
    if (side > kShareOfSpeed * std::abs(along) && side * model_.simulation.duration > kRocking * most)
      warnings.push_back(turning_across(bearing, side, most / side));
  }

 private:
  [[nodiscard]] bool joins(const mbd::JointSpec& joint, std::size_t a, std::size_t b) const {
    const std::size_t in = groups_.of(RigidGroups::body_of(spec_, joint.inboard));
    const std::size_t out = groups_.of(RigidGroups::body_of(spec_, joint.outboard));
    return std::minmax(in, out) == std::minmax(groups_.of(a), groups_.of(b));
  }

  /// True of a planar joint whose plane contains the bearing's axis: along it a rod slides through its guide, in which
  /// it rocks.
  static bool slides_along(const mbd::JointSpec& joint, double angle, double most) {
    return joint.type == mbd::JointType::planar && std::abs(angle - 0.5 * std::numbers::pi) <= most;
  }

  [[nodiscard]] Vector3 in_ground(mbd::FrameId frame, const Vector3& direction) const {
    const mbd::FrameSpec& on_body = spec_.frames[static_cast<std::size_t>(frame.index)];
    const Vector3 turned =
        start_.bodies[static_cast<std::size_t>(on_body.body.index)].X_WF.R * on_body.X_BF.R * direction;
    return turned.normalized();
  }

  [[nodiscard]] Fault across(const model::Bearing& bearing, const std::string& joint, double angle) const {
    const std::string path = "joints." + joint + ".axis";
    return {model_.position_of(path), path,
            fmt::format("the joint rotates the journal of bearing {} about an axis {:.3g} deg off the bearing's",
                        bearing.name, angle * 180 / std::numbers::pi),
            "the bearing's axis, which is z of its shell's frame",
            "give the joint that `axis`, or rotate the bearing's frames: the journal would touch the shell"};
  }

  [[nodiscard]] Fault turning_across(const model::Bearing& bearing, double speed, double touches_after) const {
    const std::string path = "bearings." + bearing.name;
    return {model_.position_of(path), path,
            fmt::format("at the start the journal rotates across the bearing's axis, with {:.3g} rad/s; so its edges "
                        "touch the shell within {:.2g} s",
                        speed, touches_after),
            "a journal that rotates about the bearing's axis, z of its shell's frame",
            "check the `axis` of the joints, the bearing's frames and the initial rates"};
  }

  const model::Model& model_;
  const mbd::MechanismSpec& spec_;
  const mbd::Observation& start_;
  RigidGroups groups_;
};

}  // namespace

std::vector<Fault> axis_warnings(const model::Model& model, const model::Machine& machine,
                                 const mbd::Observation& start) {
  std::vector<Fault> warnings;
  const mbd::MechanismSpec& spec = machine.mechanism->spec();
  AxisCheck check(model, spec, start);
  for (std::size_t i = 0; i < model.bearings.size(); ++i)
    if (model.bearings[i].kind->has_axis())
      check.look_at(model.bearings[i], spec.forces[static_cast<std::size_t>(machine.bearings[i].force.index)],
                    warnings);
  return warnings;
}

}  // namespace hersey::run
