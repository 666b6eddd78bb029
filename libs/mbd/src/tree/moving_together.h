#pragma once

#include <vector>

#include "hersey/mbd/mechanism_spec.h"

namespace hersey::mbd {

/// Finds which bodies move together, ground apart.
class MovingTogether {
 public:
  explicit MovingTogether(const MechanismSpec& spec);

  [[nodiscard]] int root_of(int body) const {
    while (group_[body] != body) body = group_[body];
    return body;
  }
  /// The group that a joint moves in.
  [[nodiscard]] int of(const JointSpec& joint) const;

  /// Per group, by its root: whether its joints close no loop and no drive or coupling moves any of them.
  [[nodiscard]] std::vector<bool> free_trees() const;

 private:
  [[nodiscard]] int body_of(FrameId frame) const { return spec_.frames[frame.index].body.index; }

  const MechanismSpec& spec_;
  std::vector<int> group_;
};

}  // namespace hersey::mbd
