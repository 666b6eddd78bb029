#include "tree/moving_together.h"

#include <numeric>

namespace hersey::mbd {

MovingTogether::MovingTogether(const MechanismSpec& spec) : spec_(spec), group_(spec.bodies.size()) {
  std::iota(group_.begin(), group_.end(), 0);
  for (const JointSpec& joint : spec.joints) {
    const int a = body_of(joint.inboard), b = body_of(joint.outboard);
    if (a != 0 && b != 0) group_[root_of(b)] = root_of(a);
  }
}

int MovingTogether::of(const JointSpec& joint) const {
  const int a = body_of(joint.inboard);
  return root_of(a != 0 ? a : body_of(joint.outboard));
}

std::vector<bool> MovingTogether::free_trees() const {
  // As many joints as bodies close no loop: each body has one that carries it, or none. Where no joint leads to ground
  // one body hangs on nothing.
  const std::size_t n = spec_.bodies.size();
  std::vector<int> room(n, 0);
  std::vector<bool> touches_ground(n, false);
  for (std::size_t b = 1; b < n; ++b) ++room[root_of(static_cast<int>(b))];
  for (const JointSpec& joint : spec_.joints) {
    --room[of(joint)];
    if (body_of(joint.inboard) == 0 || body_of(joint.outboard) == 0) touches_ground[of(joint)] = true;
  }
  std::vector<bool> is_free(n, false);
  for (std::size_t b = 1; b < n; ++b) is_free[b] = room[b] >= (touches_ground[b] ? 0 : 1);
  const auto prescribe = [&](const CoordinateRef& coordinate) {
    is_free[of(spec_.joints[coordinate.joint.index])] = false;
  };
  for (const DriveSpec& drive : spec_.drives) prescribe(drive.coordinate);
  for (const CouplingSpec& coupling : spec_.couplings) {
    prescribe(coupling.output);
    for (const CouplingSpec::Term& term : coupling.terms) prescribe(term.input);
  }
  return is_free;
}

}  // namespace hersey::mbd
