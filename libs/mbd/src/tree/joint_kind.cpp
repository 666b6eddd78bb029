#include "tree/joint_kind.h"

#include "hersey/core/contract.h"

namespace hersey::mbd {

Vector3 direction(Along along, const Matrix3& axes) {
  const int k = static_cast<int>(along);
  return k < 3 ? Vector3(axes.col(k)) : Vector3::Unit(k - 3);
}

const std::vector<JointKind>& joint_kinds() {
  using enum Along;
  using enum Motion;
  static const std::vector<JointKind> kinds{
      {.type = JointType::fixed, .name = "fixed", .rows = {{t1}, {t2}, {axis}, {t1, t2}, {t2, axis}, {axis, t1}}},
      {.type = JointType::revolute,
       .name = "revolute",
       .coordinates = {{"rotation"}},
       .chain = {{revolute}},
       .rows = {{t1}, {t2}, {axis}, {t1, axis}, {t2, axis}}},
      {.type = JointType::prismatic,
       .name = "prismatic",
       .coordinates = {{"translation"}},
       .chain = {{prismatic}},
       .rows = {{t1}, {t2}, {t1, t2}, {t2, axis}, {axis, t1}}},
      {.type = JointType::cylindrical,
       .name = "cylindrical",
       .coordinates = {{"translation"}, {"rotation"}},
       .chain = {{prismatic}, {revolute}},
       .rows = {{t1}, {t2}, {t1, axis}, {t2, axis}}},
      {.type = JointType::spherical,
       .name = "spherical",
       .coordinates = {{"orientation"}},
       .chain = {{ball}},
       .rows = {{t1}, {t2}, {axis}}},
      {.type = JointType::planar,
       .name = "planar",
       .coordinates = {{"x"}, {"y"}, {"rotation"}},
       .chain = {{prismatic, t1}, {prismatic, t2}, {revolute}},
       .rows = {{axis}, {t1, axis}, {t2, axis}}},
      {.type = JointType::free,
       .name = "free",
       .coordinates = {{"position", 3}, {"orientation"}},
       .chain = {{prismatic, x}, {prismatic, y}, {prismatic, z}, {ball}}},
      {.type = JointType::universal,
       .name = "universal",
       .coordinates = {{"rotation_1"}, {"rotation_2"}},
       .chain = {{revolute, t1}, {revolute, t2}},
       .rows = {{t1}, {t2}, {axis}, {t1, t2}}},
      // Its constraint counts revolutions, which poses do not contain.
      {.type = JointType::screw, .name = "screw", .coordinates = {{"rotation"}}, .chain = {{screw}}},
  };
  return kinds;
}

const JointKind& kind_of(JointType type) {
  const auto index = static_cast<std::size_t>(type);
  HERSEY_REQUIRE(index < joint_kinds().size() && joint_kinds()[index].type == type,
                 "kinds of joints are listed in the order of JointType");
  return joint_kinds()[index];
}

}  // namespace hersey::mbd
