#include "tree/roots.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "hersey/mbd/joint.h"
#include "tree/moving_together.h"
#include "tree/start_of.h"
#include "tree/tree_motion.h"

namespace hersey::mbd {
namespace {

/// A body with less than a tenth of the moment of inertia of others does not carry them.
constexpr double kFar = 10;

/// Sine of the angle between axes that are parallel but for round-off.
constexpr double kParallel = 1e-12;

/// Distance of coincident points by round-off, relative to the mechanism's size.
constexpr double kOffCentre = 1e-9;

bool is_whole_motion(JointType type) { return type == JointType::free || type == JointType::planar; }

}  // namespace

std::vector<bool> joints_in_use(const MechanismSpec& spec) {
  std::vector<bool> used(spec.joints.size(), false);
  const auto use = [&](const CoordinateRef& coordinate) { used[coordinate.joint.index] = true; };
  for (const DriveSpec& d : spec.drives) use(d.coordinate);
  for (const CoordinateSpringSpec& s : spec.springs) use(s.coordinate);
  for (const MechanismSpec::CoordinateForce& f : spec.coordinate_forces) use(f.coordinate);
  for (const MechanismSpec::Shared& s : spec.shared)
    for (const CoordinateRef& coordinate : s.coordinates) use(coordinate);
  for (const CouplingSpec& c : spec.couplings) {
    use(c.output);
    for (const CouplingSpec::Term& term : c.terms) use(term.input);
  }
  for (const LoadSpec& load : spec.loads)
    for (const LoadTerm& term : load.terms)
      for (const Variable& x : term.variables)
        if (x.kind != Variable::Kind::time) use(x.coordinate);
  return used;
}

Roots::Roots(const MechanismSpec& spec, const Tree& tree)
    : spec_(spec), length_(tree.length), at_body_(spec.bodies.size()) {
  TreeMotion start(tree, spec.gravity);
  const solver::State state = start_of(spec, tree);
  start.update_positions(state);
  start.update_velocities(state);
  for (const Attachment& body : tree.bodies) {
    poses_.push_back(start.pose(body));
    velocities_.push_back(start.V(body.link));
  }
  for (std::size_t j = 0; j < spec.joints.size(); ++j)
    for (const FrameId end : {spec.joints[j].inboard, spec.joints[j].outboard})
      at_body_[body_of(end)].push_back(static_cast<int>(j));
  find_leavable_joints();
  weigh();
}

/// Groups of bodies that close no loop and that nothing prescribes; short enough to be cut nowhere. Beams have rules of
/// their own.
void Roots::find_leavable_joints() {
  const MovingTogether groups(spec_);
  std::vector<bool> may = groups.free_trees(), has_elastic(spec_.bodies.size(), false);
  for (const MechanismSpec::Elastic& elastic : spec_.elastics) {
    const bool is_segment = elastic.frames.size() != elastic.freedoms.size() + 1;
    for (const FrameId frame : elastic.frames) {
      const int group = groups.root_of(body_of(frame));
      has_elastic[group] = true;
      if (is_segment) may[group] = false;
    }
  }
  std::vector<int> room(spec_.bodies.size(), spec_.longest_path - degrees_of_freedom(JointType::free));
  for (const JointSpec& joint : spec_.joints) room[groups.of(joint)] -= degrees_of_freedom(joint.type);
  eligible_.assign(spec_.bodies.size(), false);
  rigid_.assign(spec_.bodies.size(), true);
  for (std::size_t b = 1; b < spec_.bodies.size(); ++b) {
    const int group = groups.root_of(static_cast<int>(b));
    eligible_[b] = may[group] && room[group] >= 0;
    rigid_[b] = !has_elastic[group];
  }
  const std::vector<bool> used = joints_in_use(spec_);
  leavable_.assign(spec_.joints.size(), false);
  for (std::size_t j = 0; j < spec_.joints.size(); ++j) {
    const JointSpec& joint = spec_.joints[j];
    leavable_[j] =
        is_whole_motion(joint.type) && !used[j] && eligible_[std::max(body_of(joint.inboard), body_of(joint.outboard))];
  }
  for (const JointId j : spec_.deforming) leavable_[j.index] = false;
}

bool Roots::may_matter() const { return std::find(eligible_.begin(), eligible_.end(), true) != eligible_.end(); }

void Roots::Weight::add(const Weight& other) {
  const double sum = mass + other.mass;
  const Vector3 at = sum > 0 ? Vector3((mass * centre + other.mass * other.centre) / sum) : other.centre;
  inertia = inertia_about(at) + other.inertia_about(at);
  mass = sum;
  centre = at;
}

double Roots::Weight::inertia_about(const Vector3& point) const {
  return inertia + mass * (centre - point).squaredNorm();
}

int Roots::fixed_root(int body) const {
  while (fixed_to_[body] != body) body = fixed_to_[body];
  return body;
}

void Roots::weigh() {
  fixed_to_.resize(spec_.bodies.size());
  std::iota(fixed_to_.begin(), fixed_to_.end(), 0);
  for (const JointSpec& joint : spec_.joints) {
    if (joint.type != JointType::fixed) continue;
    const int a = fixed_root(body_of(joint.inboard)), b = fixed_root(body_of(joint.outboard));
    fixed_to_[std::max(a, b)] = std::min(a, b);
  }
  whole_.resize(spec_.bodies.size());
  for (std::size_t b = 0; b < spec_.bodies.size(); ++b) {
    const BodySpec& body = spec_.bodies[b];
    own_.push_back({body.mass, body.inertia.trace() / 2, poses_[b] * body.com});
  }
  for (const MechanismSpec::Elastic& elastic : spec_.elastics) {
    const int body = body_of(elastic.frames.front());
    own_[body].add({elastic.body->mass(), 0, poses_[body] * elastic.body->centre()});
  }
  for (std::size_t b = 0; b < spec_.bodies.size(); ++b) whole_[fixed_root(static_cast<int>(b))].add(own_[b]);
}

int Roots::other_end(int j, int body) const {
  const int inboard = body_of(spec_.joints[j].inboard);
  return inboard == body ? body_of(spec_.joints[j].outboard) : inboard;
}

/// Bodies that joints which stay in paths connect with `first`, itself among them.
std::vector<int> Roots::cluster(int first) const {
  std::vector<int> members{first};
  for (std::size_t i = 0; i < members.size(); ++i)
    for (const int j : at_body_[members[i]]) {
      const int next = other_end(j, members[i]);
      if (may_leave(j) || next == 0 || std::find(members.begin(), members.end(), next) != members.end()) continue;
      members.push_back(next);
    }
  return members;
}

/// Returns the bodies of the cluster that joints compatible with the motions of joint `j` connect to `first`.
std::vector<int> Roots::candidates(std::optional<int> j, int first) const {
  std::vector<int> members{first};
  for (std::size_t i = 0; i < members.size(); ++i)
    for (const int k : at_body_[members[i]]) {
      const int next = other_end(k, members[i]);
      if (may_leave(k) || next == 0 || (j && !keeps_motions(k, *j)) ||
          std::find(members.begin(), members.end(), next) != members.end())
        continue;
      members.push_back(next);
    }
  return members;
}

/// Returns the moment of inertia of `carried` about the body's centre over that of the body itself with all bodies
/// fixed to it.
double Roots::share_of(const std::vector<int>& carried, int body) const {
  const int whole = fixed_root(body);
  double inertia = 0;
  for (const int b : carried)
    if (fixed_root(b) != whole) inertia += own_[b].inertia_about(whole_[whole].centre);
  if (inertia == 0) return 0;
  const double own = whole_[whole].inertia;
  return own > 0 ? inertia / own : std::numeric_limits<double>::infinity();
}

int Roots::carrier(std::optional<int> j, int first) const {
  if (!eligible_[first] || !rigid_[first]) return first;
  const std::vector<int> members = cluster(first);
  const double share = share_of(members, first);
  if (share <= kFar) return first;
  int best = first;
  double least = share / kFar;
  for (const int body : candidates(j, first)) {
    const double of_body = share_of(members, body);
    if (of_body >= least) continue;
    best = body;
    least = of_body;
  }
  return best;
}

bool Roots::is_too_light(int body, int first) const {
  return rigid_[body] && fixed_root(body) != 0 && share_of(cluster(first), body) > kFar;
}

Vector3 Roots::centre(int body) const {
  Weight weight = whole_[fixed_root(body)];
  if (weight.mass == 0)
    for (const int b : cluster(body)) weight.add(own_[b]);
  return weight.mass > 0 ? weight.centre : poses_[body].r;
}

bool Roots::rotates_off_centre(std::optional<int> j, int body) const {
  if (!eligible_[body]) return false;
  Vector3 at = poses_[body].r;
  if (j) {
    const JointSpec& joint = spec_.joints[*j];
    if (joint.type != JointType::free) return false;
    const FrameId end = body_of(joint.outboard) == body ? joint.outboard : joint.inboard;
    at = poses_[body] * spec_.frames[end.index].X_BF.r;
  }
  return (centre(body) - at).norm() > kOffCentre * length_;
}

Matrix3 Roots::axes(int j) const {
  const JointSpec& joint = spec_.joints[j];
  const FrameSpec& inboard = spec_.frames[joint.inboard.index];
  return poses_[inboard.body.index].R * inboard.X_BF.R * joint_axes(joint.axis);
}

bool Roots::keeps_motions(std::optional<int> other, int j) const {
  if (spec_.joints[j].type == JointType::free) return true;
  if (!other) return false;
  const Vector3 normal = axes(j).col(2), axis = axes(*other).col(2);
  switch (spec_.joints[*other].type) {
    case JointType::fixed:
      return true;
    case JointType::revolute:
    case JointType::planar:
      return normal.cross(axis).norm() < kParallel;
    case JointType::prismatic:
      return std::abs(normal.dot(axis)) < kParallel;
    default:
      return false;
  }
}

}  // namespace hersey::mbd
