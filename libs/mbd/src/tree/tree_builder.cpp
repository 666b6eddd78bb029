#include "tree/tree_builder.h"

#include <algorithm>
#include <deque>
#include <numbers>
#include <optional>

#include "tree/joint_kind.h"
#include "tree/loose_beams.h"
#include "tree/roots.h"
#include "tree/start_of.h"
#include "tree/tree_motion.h"

namespace hersey::mbd {
namespace {

/// One elementary joint of a chain and the value it belongs to.
struct Element {
  Motion motion;
  Vector3 axis;
  int value;
  double travel = 0;
};

std::vector<Element> elements_of(JointType type, const Vector3& axis, double lead = 0) {
  const Matrix3 axes = joint_axes(axis);
  std::vector<Element> elements;
  int value = 0;
  for (const JointKind::Step& step : kind_of(type).chain) {
    elements.push_back({step.motion, direction(step.along, axes), value,
                        step.motion == Motion::screw ? lead / (2 * std::numbers::pi) : 0});
    value += values_of(step.motion);
  }
  return elements;
}

/// Grows the tree; see build_tree.
class TreeBuilder {
 public:
  /// @param roots  who carries what; null: as joints come in their order
  explicit TreeBuilder(const MechanismSpec& spec, const Roots* roots = nullptr)
      : spec_(spec), roots_(roots), read_(joints_in_use(spec)) {
    const std::size_t n = spec.bodies.size();
    tree_.links.emplace_back();
    tree_.bodies.resize(n);
    tree_.body_parent.assign(n, -1);
    carried_by_.resize(n);
    tree_.joints.resize(spec.joints.size());
    reached_.assign(n, false);
    used_.assign(spec.joints.size(), false);
    deforms_.assign(spec.joints.size(), false);
    for (const JointId j : spec.deforming) deforms_[j.index] = true;
    loose_ = loose_joints(spec);
    at_body_.resize(n);
    for (std::size_t j = 0; j < spec.joints.size(); ++j) {
      const int inboard = body_of(spec.joints[j].inboard), outboard = body_of(spec.joints[j].outboard);
      at_body_[inboard].push_back(static_cast<int>(j));
      if (outboard != inboard) at_body_[outboard].push_back(static_cast<int>(j));
    }
  }

  Tree build() {
    reached_[0] = true;
    grow_from(0);
    for (std::size_t b = 1; b < spec_.bodies.size(); ++b) {
      if (reached_[b]) continue;
      const int body = static_cast<int>(b), root = roots_ ? roots_->carrier(std::nullopt, body) : body;
      if (root != body || (roots_ && roots_->rotates_off_centre(std::nullopt, body)))
        add_own_motion(std::nullopt, 0, root);
      else
        add_free_body(body);
      grow_from(root);
    }
    set_frames();
    // First of all constraints, each has coordinates of its own: none of them is ever found redundant.
    for (const Cut& cut : tree_.cuts) close(cut.joint);
    for (std::size_t j = 0; j < spec_.joints.size(); ++j)
      if (!used_[j]) close(static_cast<int>(j));
    lay_out();
    return std::move(tree_);
  }

 private:
  [[nodiscard]] int body_of(FrameId frame) const { return spec_.frames[frame.index].body.index; }

  void grow_from(int root) {
    std::deque<int> queue;
    absorb(root, queue);
    while (!queue.empty()) {
      const int body = queue.front();
      queue.pop_front();
      for (const int j : at_body_[body]) cross(j, body, queue);
    }
  }

  /// Queues `body` and at once everything that joints of interest connect to it, so that those joints are in the tree.
  void absorb(int body, std::deque<int>& queue) {
    queue.push_back(body);
    for (const int j : at_body_[body])
      if (read_[j]) cross(j, body, queue);
    for (const int j : at_body_[body])
      if (spec_.joints[j].has_given()) cross(j, body, queue);
    for (const int j : at_body_[body])
      if (!spec_.joints[j].initial.empty()) cross(j, body, queue);
  }

  /// Takes joint j into the tree if it leads from `body` to a body not yet reached.
  void cross(int j, int body, std::deque<int>& queue) {
    const JointSpec& joint = spec_.joints[j];
    const int inboard = body_of(joint.inboard), outboard = body_of(joint.outboard);
    if (used_[j] || (inboard != body && outboard != body)) return;
    const bool reversed = outboard == body;
    const int next = reversed ? inboard : outboard;
    if (reached_[next]) return;
    used_[j] = true;
    if (roots_ && roots_->may_leave(j)) {
      const int root = roots_->carrier(j, next), base = base_of(j, body, next);
      if (root != next || base != body || roots_->rotates_off_centre(j, next)) {
        add_own_motion(j, base, root);
        absorb(root, queue);
        return;
      }
    }
    if (loose_[static_cast<std::size_t>(j)]) {
      tree_.loosened.push_back({j, next, reversed});
      tree_.bodies[next] =
          add_chain(j, next, elements_of(JointType::free, Vector3::UnitZ()), false, Attachment{}, false);
      reach(next, 0);
    } else if (is_cut(j, body)) {
      tree_.cuts.push_back({j, next, reversed});
      add_free_body(next);
    } else {
      add_joint(j, reversed);
      reach(next, body);
      carried_by_[next] = {body, j};
    }
    absorb(next, queue);
  }

  /// The body that carries what joint j brings along with `next`: `body`, or inboard of it the first one whose moment
  /// of inertia is not too small, as far as the joints between keep the motions of j.
  [[nodiscard]] int base_of(int j, int body, int next) const {
    while (body != 0 && roots_->is_too_light(body, next) && roots_->keeps_motions(carried_by_[body].joint, j))
      body = carried_by_[body].parent;
    return body;
  }

  /// Body `root` moves against `base` as joint j (none: freely) lets it, by coordinates about its centre of mass.
  void add_own_motion(std::optional<int> j, int base, int root) {
    const bool is_planar = j && spec_.joints[*j].type == JointType::planar;
    Pose X_WM = roots_->pose(root);
    X_WM.r = roots_->centre(root);
    if (is_planar) X_WM.R = roots_->axes(*j);
    const Attachment& carrier = tree_.bodies[base];
    const Pose X_BF = roots_->pose(base).inverse() * X_WM;
    OwnMotion own{.body = root, .joint = j.value_or(-1)};
    own.first_link = static_cast<int>(tree_.links.size());
    const Attachment end =
        add_chain(-1, root, elements_of(is_planar ? JointType::planar : JointType::free, Vector3::UnitZ()), false,
                  {carrier.link, carrier.X_LF * X_BF});
    const Vector6 V = roots_->velocity(root) - roots_->velocity(base);
    const Vector3 omega = X_WM.R.transpose() * V.head<3>(),
                  v = X_WM.R.transpose() * (V.tail<3>() + V.head<3>().cross(X_WM.r));
    if (is_planar)
      own.velocity = Vector3(v.x(), v.y(), omega.z());
    else
      own.velocity = (Vector6() << v, omega).finished();
    tree_.own_motions.push_back(std::move(own));
    tree_.bodies[root] = {end.link, X_WM.inverse() * roots_->pose(root)};
    reach(root, base);
    carried_by_[root] = {base, j};
  }

  /// True if the path from ground would become too long beyond `body`. Deformations are not cut from their bodies.
  [[nodiscard]] bool is_cut(int j, int body) const {
    const int more = degrees_of_freedom(spec_.joints[j].type);
    return !deforms_[j] && depth_[tree_.bodies[body].link] + more > spec_.longest_path;
  }

  void reach(int body, int parent) {
    reached_[body] = true;
    tree_.body_parent[body] = parent;
    tree_.body_order.push_back(body);
    add_inertia(body);
  }

  void add_joint(int j, bool reversed) {
    const JointSpec& joint = spec_.joints[j];
    const FrameSpec& near = spec_.frames[(reversed ? joint.outboard : joint.inboard).index];
    const FrameSpec& far = spec_.frames[(reversed ? joint.inboard : joint.outboard).index];
    const Attachment& base = tree_.bodies[near.body.index];
    const Attachment end =
        add_chain(j, -1, elements_of(joint.type, joint.axis, joint.lead), reversed, {base.link, base.X_LF * near.X_BF});
    tree_.bodies[far.body.index] = {end.link, end.X_LF * far.X_BF.inverse()};
    tree_.joints[j].reversed = reversed;
    tree_.joints[j].outboard_body = far.body.index;
  }

  /// A chain of elementary joints from `base`; returns the frame at its far end. `has_values`: they are the joint's.
  Attachment add_chain(int joint, int body, std::vector<Element> elements, bool reversed, Attachment base,
                       bool has_values = true) {
    if (reversed) std::reverse(elements.begin(), elements.end());
    JointIndices* const where = joint >= 0 && has_values ? &tree_.joints[joint] : nullptr;
    if (where) where->value_count = degrees_of_freedom(spec_.joints[joint].type);
    for (const Element& e : elements) {
      Link link;
      link.parent = base.link;
      link.motion = e.motion;
      link.X_PF = base.X_LF;
      link.axis = reversed ? Vector3(-e.axis) : e.axis;
      link.travel = e.travel;
      link.columns = values_of(e.motion);
      link.joint = joint;
      link.body = body;
      link.value = e.value;
      link.reversed = reversed;
      const int index = static_cast<int>(tree_.links.size());
      for (int c = 0; where && c < link.columns; ++c) where->values[e.value + c] = {index, c};
      tree_.links.push_back(link);
      depth_.push_back(depth_[link.parent] + link.columns);
      base = {index, Pose{}};
    }
    return base;
  }

  void add_free_body(int body) {
    tree_.bodies[body] = add_chain(-1, body, elements_of(JointType::free, Vector3::UnitZ()), false, Attachment{});
    reach(body, 0);
  }

  /// Adds the body's inertia to its link's (parallel axes).
  void add_inertia(int body) {
    const BodySpec& b = spec_.bodies[body];
    if (b.mass == 0 && b.inertia.isZero(0)) return;
    const Attachment& at = tree_.bodies[body];
    Link& link = tree_.links[at.link];
    const Vector3 c = at.X_LF * b.com;
    const double mass = link.mass + b.mass;
    const Vector3 com = mass > 0 ? Vector3((link.mass * link.com + b.mass * c) / mass) : Vector3::Zero();
    const auto about = [&](double m, const Vector3& from) {
      const Matrix3 d = skew(from - com);
      return Matrix3(-m * d * d);
    };
    link.inertia =
        link.inertia + about(link.mass, link.com) + at.X_LF.R * b.inertia * at.X_LF.R.transpose() + about(b.mass, c);
    link.mass = mass;
    link.com = com;
  }

  void set_frames() {
    for (const FrameSpec& f : spec_.frames) {
      const Attachment& body = tree_.bodies[f.body.index];
      tree_.frames.push_back({body.link, body.X_LF * f.X_BF});
    }
  }

  /// A deformation has its initial values from the body, not from the user.
  [[nodiscard]] bool starts_as_given(int j) const { return spec_.joints[j].has_given() && !deforms_[j]; }

  /// Joint j closes a loop, or a cut. If something reads its coordinates, they have initial values, or count
  /// revolutions as those of a cut do, it becomes a chain from its inboard frame to a massless link welded to its
  /// outboard frame, so that the coordinates exist.
  void close(int j) {
    const JointSpec& joint = spec_.joints[j];
    Closure closure;
    closure.joint = j;
    closure.pair.a = tree_.frames[joint.inboard.index];
    closure.pair.b = tree_.frames[joint.outboard.index];
    if (used_[j] || read_[j] || starts_as_given(j) || kind_of(joint.type).rows.empty()) {
      closure.pair.a = add_chain(j, -1, elements_of(joint.type, joint.axis, joint.lead), false, closure.pair.a);
      closure.rows = constraint_rows(JointType::fixed, joint.axis);
    } else {
      closure.rows = constraint_rows(joint.type, joint.axis);
    }
    closure.first_row = tree_.nclosure;
    tree_.nclosure += static_cast<int>(closure.rows.size());
    tree_.joints[j].closure = static_cast<int>(tree_.closures.size());
    tree_.closures.push_back(std::move(closure));
  }

  /// Numbers coordinates and finds who moves what.
  void lay_out() {
    const std::size_t n = tree_.links.size();
    tree_.path.resize(n);
    number_subtrees();
    for (std::size_t l = 0; l < n; ++l) {
      Link& link = tree_.links[l];
      link.first_q = tree_.nq;
      link.first_v = tree_.nv;
      tree_.nq += link.motion == Motion::ball ? 4 : link.columns;
      tree_.nv += link.columns;
      if (link.parent >= 0) tree_.path[l] = tree_.path[link.parent];
      for (int c = 0; c < link.columns; ++c) {
        tree_.path[l].push_back(static_cast<int>(tree_.columns.size()));
        tree_.columns.push_back({static_cast<int>(l), c});
      }
    }
    for (Closure& closure : tree_.closures) find_columns(closure.pair);
    for (const MechanismSpec::Force& f : spec_.forces) {
      Pair pair{tree_.frames[f.a.index], tree_.frames[f.b.index], {}};
      find_columns(pair);
      tree_.forces.push_back(std::move(pair));
    }
    double length = 0;
    for (const Link& link : tree_.links) length = std::max(length, link.X_PF.r.norm());
    for (const Attachment& f : tree_.frames) length = std::max(length, f.X_LF.r.norm());
    // Frames of a flexible body may coincide with its axes and then do not define its size.
    for (const MechanismSpec::Elastic& elastic : spec_.elastics)
      length = std::max(length, elastic.body->centre().norm());
    if (length > 0) tree_.length = length;
  }

  /// Numbers links so that those of a subtree follow each other.
  void number_subtrees() {
    const std::size_t n = tree_.links.size();
    std::vector<int> size(n, 1), next(n, 0);
    for (std::size_t l = n; l-- > 1;) size[tree_.links[l].parent] += size[l];
    tree_.enter.assign(n, 0);
    tree_.leave.assign(n, static_cast<int>(n));
    for (std::size_t l = 0; l < n; ++l) {
      if (l > 0) {
        int& free = next[tree_.links[l].parent];
        tree_.enter[l] = free;
        free += size[l];
      }
      tree_.leave[l] = tree_.enter[l] + size[l];
      next[l] = tree_.enter[l] + 1;
    }
  }

  void find_columns(Pair& pair) const {
    for (int k : tree_.path[pair.a.link])
      if (!tree_.moves(k, pair.b.link)) pair.columns.push_back({k, -1.0});
    for (int k : tree_.path[pair.b.link])
      if (!tree_.moves(k, pair.a.link)) pair.columns.push_back({k, +1.0});
  }

  /// Last element of a body's path.
  struct Carried {
    int parent = 0;
    std::optional<int> joint;  ///< none: it moves freely
  };

  const MechanismSpec& spec_;
  const Roots* roots_;
  Tree tree_;
  std::vector<Carried> carried_by_;        ///< carrier of each body
  std::vector<bool> reached_;              ///< bodies
  std::vector<bool> used_;                 ///< joints in the tree
  std::vector<bool> read_;                 ///< joints whose coordinates something needs
  std::vector<bool> deforms_;              ///< joints inside elastic bodies
  std::vector<bool> loose_;                ///< joints of loose beams
  std::vector<std::vector<int>> at_body_;  ///< joints of each body, in order of declaration
  std::vector<int> depth_{0};              ///< number of columns that move each link
};

/// Finds the rotations of planar joints that are in no path from those of links, full revolutions included.
void find_rotations(const MechanismSpec& spec, Tree& tree) {
  const solver::State start = start_of(spec, tree);
  TreeMotion at(tree, Vector3::Zero());
  at.update_positions(start);
  for (OwnMotion& own : tree.own_motions) {
    if (own.joint < 0 || spec.joints[own.joint].type != JointType::planar) continue;
    const JointSpec& joint = spec.joints[own.joint];
    const Attachment &inboard = tree.frames[joint.inboard.index], &outboard = tree.frames[joint.outboard.index];
    const Vector3 normal = at.pose(inboard).R * joint_axes(joint.axis).col(2);
    own.offset = joint.initial.empty() ? 0 : joint.initial[2];
    const auto add = [&](int to, int other, double sign) {
      for (const int k : tree.path[to]) {
        const int link = tree.columns[k].link;
        if (tree.moves(k, other) || tree.links[link].motion != Motion::revolute) continue;
        const double weight = at.J(k).head<3>().dot(normal) > 0 ? sign : -sign;
        own.weights.emplace_back(link, weight);
        own.offset -= weight * start.q[tree.links[link].first_q];
      }
    };
    add(outboard.link, inboard.link, 1);
    add(inboard.link, outboard.link, -1);
  }
}

/// Reactions are summed along the joints, independent of the tree.
void follow_joints_of(const Tree& as_declared, Tree& tree) {
  tree.body_order = as_declared.body_order;
  tree.body_parent = as_declared.body_parent;
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    tree.joints[j].reversed = as_declared.joints[j].reversed;
    tree.joints[j].outboard_body = as_declared.joints[j].outboard_body;
  }
}

}  // namespace

Tree build_tree(const MechanismSpec& spec) {
  Tree as_declared = TreeBuilder(spec).build();
  if (!spec.chooses_roots) return as_declared;
  const Roots roots(spec, as_declared);
  if (!roots.may_matter()) return as_declared;
  Tree tree = TreeBuilder(spec, &roots).build();
  if (tree.own_motions.empty()) return as_declared;
  follow_joints_of(as_declared, tree);
  find_rotations(spec, tree);
  return tree;
}

}  // namespace hersey::mbd
