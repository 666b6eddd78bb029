#include "tree/loose_beams.h"

#include "tree/moving_together.h"

namespace hersey::mbd {

std::vector<bool> loose_joints(const MechanismSpec& spec) {
  std::vector<bool> loose(spec.joints.size(), false);
  if (!spec.loosens_beams) return loose;
  const MovingTogether groups(spec);
  const std::vector<bool> is_free = groups.free_trees();
  for (const JointId j : spec.deforming) loose[j.index] = is_free[groups.of(spec.joints[j.index])];
  // Other elastic bodies are reduced about their first frame.
  for (const MechanismSpec::Elastic& elastic : spec.elastics)
    for (const JointId j : elastic.freedoms) loose[j.index] = false;
  return loose;
}

}  // namespace hersey::mbd
