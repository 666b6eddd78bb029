#include "tree/loose_beams.h"

#include <numeric>

namespace hersey::mbd {
namespace {

/// Finds which bodies move together, ground apart.
class MovingTogether {
 public:
  explicit MovingTogether(const MechanismSpec& spec) : spec_(spec), group_(spec.bodies.size()) {
    std::iota(group_.begin(), group_.end(), 0);
    for (const JointSpec& joint : spec.joints) {
      const int a = body_of(joint.inboard), b = body_of(joint.outboard);
      if (a != 0 && b != 0) group_[root_of(b)] = root_of(a);
    }
  }
  [[nodiscard]] int root_of(int body) const {
    while (group_[body] != body) body = group_[body];
    return body;
  }
  /// The group that a joint moves in.
  [[nodiscard]] int of(const JointSpec& joint) const {
    const int a = body_of(joint.inboard);
    return root_of(a != 0 ? a : body_of(joint.outboard));
  }

 private:
  [[nodiscard]] int body_of(FrameId frame) const { return spec_.frames[frame.index].body.index; }

  const MechanismSpec& spec_;
  std::vector<int> group_;
};

}  // namespace

std::vector<bool> loose_joints(const MechanismSpec& spec) {
  std::vector<bool> loose(spec.joints.size(), false);
  if (!spec.loosens_beams) return loose;
  const MovingTogether groups(spec);
  // As many joints as bodies close no loop: each body has one that carries it, or none.
  std::vector<int> room(spec.bodies.size(), 0);
  for (std::size_t b = 1; b < spec.bodies.size(); ++b) ++room[groups.root_of(static_cast<int>(b))];
  for (const JointSpec& joint : spec.joints) --room[groups.of(joint)];
  const auto prescribe = [&](const CoordinateRef& coordinate) {
    room[groups.of(spec.joints[coordinate.joint.index])] = -1;
  };
  for (const DriveSpec& drive : spec.drives) prescribe(drive.coordinate);
  for (const CouplingSpec& coupling : spec.couplings) {
    prescribe(coupling.output);
    for (const CouplingSpec::Term& term : coupling.terms) prescribe(term.input);
  }
  for (const JointId j : spec.deforming) loose[j.index] = room[groups.of(spec.joints[j.index])] >= 0;
  // Other elastic bodies are reduced about their first frame.
  for (const MechanismSpec::Elastic& elastic : spec.elastics)
    for (const JointId j : elastic.freedoms) loose[j.index] = false;
  return loose;
}

}  // namespace hersey::mbd
