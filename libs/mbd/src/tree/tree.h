#pragma once

#include <array>
#include <utility>
#include <vector>

#include "hersey/mbd/mechanism_spec.h"
#include "tree/constraint_row.h"
#include "tree/joint_kind.h"

namespace hersey::mbd {

/// A link of the spanning tree and the elementary joint that carries it on its parent: every joint is a chain of
/// elementary joints (theory manual, section "Joints"), whose inner links are massless. Link 0 is ground. A link's
/// frame is the moving frame M of its elementary joint, whose fixed frame F is fixed on the parent P: X_WL = X_WP X_PF
/// X_FM(q).
struct Link {
  int parent = -1;
  Motion motion = Motion::none;
  Pose X_PF;
  Vector3 axis = Vector3::UnitZ();  ///< axis of a revolute, prismatic or screw motion, in F
  double travel = 0;                ///< travel of a screw [m/rad]
  int first_q = 0;                  ///< index of its coordinate in q; a ball's quaternion (w, x, y, z)
  int first_v = 0;                  ///< and in v
  int columns = 0;                  ///< 0 (ground), 1, or 3 (ball)
  int joint = -1;                   ///< the user's joint it is part of; -1: the automatic free joint of `body`
  int body = -1;                    ///< the body whose automatic free joint this is
  int value = 0;                    ///< first index in the joint's list of values
  bool reversed = false;            ///< the tree runs through the joint from outboard to inboard

  // The rigid bodies fixed on this link together: mass, centre of mass and inertia about it, in the link's frame.
  double mass = 0;
  Vector3 com = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
};

/// One velocity component: column of the velocity transformation B.
struct Column {
  int link = 0;
  int component = 0;  ///< 0, or 0..2 of a ball
};

/// A frame fixed on a link.
struct Attachment {
  int link = 0;
  Pose X_LF;
};

/// A velocity component that moves frame b relative to frame a: +1 if it moves b alone, -1 if it moves a alone.
struct SignedColumn {
  int column = 0;
  double sign = 1;
};

/// Two frames and the velocity components that change their relative pose.
struct Pair {
  Attachment a, b;
  std::vector<SignedColumn> columns;
};

/// A joint outside the spanning tree: constraint rows between its frames.
struct Closure {
  int joint = 0;
  Pair pair;
  std::vector<ConstraintRow> rows;
  int first_row = 0;                   ///< among the multipliers
  std::vector<ConstraintRow> dropped;  ///< rows that follow from the others, see redundancy.h
};

/// A joint at which a long path from ground is cut: the body beyond it has coordinates of its own, and the joint closes
/// the cut (theory manual eq. (mechanisms.17)).
struct Cut {
  int joint = 0;
  int body = 0;           ///< the body beyond the joint along the path
  bool reversed = false;  ///< it is the inboard one
};

/// A free joint of a loose beam, whose node has coordinates of its own: the joint is in no path, and where the node
/// starts follows from it.
struct Loosened {
  int joint = 0;
  int body = 0;           ///< the node beyond the joint along the path
  bool reversed = false;  ///< it is the inboard one
};

/// Motion of a body that no joint carries, because the carrying body would be too light (theory manual, section "Light
/// bodies carry nothing"): a chain of its own from what carries it, all values zero at the start, in space or in a
/// plane.
struct OwnMotion {
  int body = 0;
  int joint = -1;  ///< the joint that it replaces, which is in no path; -1: no joint connects the body
  int first_link = 0;
  Eigen::VectorXd velocity;  ///< at the start
  /// Rotation of a planar joint: offset + sum of weight times values of scalar links, revolutions included.
  std::vector<std::pair<int, double>> weights;
  double offset = 0;
};

/// Link and component of a joint's value.
struct ValueIndex {
  int link = 0, component = 0;
};

/// Indices of a joint of the specification in the tree, without heap memory for fast access to thousands of joints.
struct JointIndices {
  std::array<ValueIndex, 6> values;
  int value_count = 0;     ///< none of a plain closing joint
  int closure = -1;        ///< index of its constraints if it closes a loop
  bool reversed = false;   ///< the path from ground leads through it to its inboard body
  int outboard_body = -1;  ///< for joints that close no loop: index of the body beyond along this path
};

/// Spanning tree of a mechanism: constant.
struct Tree {
  std::vector<Link> links;
  std::vector<Column> columns;
  std::vector<Attachment> bodies;  ///< body frames
  std::vector<Attachment> frames;
  std::vector<Closure> closures;
  std::vector<JointIndices> joints;
  std::vector<int> body_order;         ///< bodies from ground outwards as joints lead, ground excluded
  std::vector<int> body_parent;        ///< the body each hangs on by its joint, -1 for ground
  std::vector<std::vector<int>> path;  ///< per link: columns that move it, from ground outwards
  std::vector<Cut> cuts;               ///< from ground outwards
  std::vector<Loosened> loosened;      ///< from the node where each beam is entered outwards
  std::vector<OwnMotion> own_motions;  ///< from ground outwards
  std::vector<int> enter, leave;       ///< per link: numbers of the links it carries, itself the first
  std::vector<Pair> forces;            ///< frames of the two-body forces
  int nq = 0;
  int nv = 0;
  int nclosure = 0;   ///< constraint rows of all closures
  double length = 1;  ///< size of the mechanism [m]: scale of positional constraints

  /// True if column k moves link l.
  [[nodiscard]] bool moves(int k, int l) const {
    const int link = columns[k].link;
    return enter[link] <= enter[l] && enter[l] < leave[link];
  }
};

/// The scalar column of a joint coordinate.
[[nodiscard]] int column_of(const Tree& tree, const CoordinateRef& coordinate);

}  // namespace hersey::mbd
