#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/mbd/joint_type.h"

namespace hersey::mbd {

/// The motion an elementary joint allows.
enum class Motion { none, revolute, prismatic, ball, screw };

/// A direction of a joint: columns of joint_axes in the inboard frame, or that frame's own.
enum class Along { t1, t2, axis, x, y, z };

[[nodiscard]] Vector3 direction(Along along, const Matrix3& axes);

/// All that makes a joint type what it is: what else is known of one follows.
struct JointKind {
  /// Coordinate that consists of some of the values, in the order of the chain.
  struct Name {
    std::string_view text;
    int steps = 1;  ///< number of elementary joints of the chain that it comprises
  };
  /// An elementary joint of the chain, from the inboard frame on. Prismatic ones come first, so that frames define
  /// their displacement; the axes of two revolute ones are at right angles.
  struct Step {
    Motion motion;
    Along along = Along::axis;
  };
  /// Constraint of a joint outside the tree (mechanisms.14): a position along a; with b the cosine between a of the
  /// inboard and b of the outboard frame.
  struct Row {
    Along a;
    std::optional<Along> b = {};
  };
  JointType type;
  std::string_view name;
  std::vector<Name> coordinates;
  std::vector<Step> chain;
  std::vector<Row> rows;  ///< none: always a chain
};

[[nodiscard]] const std::vector<JointKind>& joint_kinds();
[[nodiscard]] const JointKind& kind_of(JointType type);

/// Values that an elementary joint has.
[[nodiscard]] constexpr int values_of(Motion motion) { return motion == Motion::ball ? 3 : 1; }
[[nodiscard]] constexpr bool is_rotational(Motion motion) {
  return motion != Motion::prismatic && motion != Motion::none;
}

}  // namespace hersey::mbd
