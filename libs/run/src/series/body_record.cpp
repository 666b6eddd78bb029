#include "series/body_record.h"

namespace hersey::run {
namespace {

Eigen::Vector4d quaternion(const mbd::FrameMotion& motion) {
  const Eigen::Quaterniond R(motion.X_WF.R);
  return {R.w(), R.x(), R.y(), R.z()};
}

}  // namespace

const QuantityTable<mbd::FrameMotion, BodyRecord::Plan>& BodyRecord::table() {
  using Motion = mbd::FrameMotion;
  static const QuantityTable<Motion, Plan> table{
      {"position", "m", "origin in ground", part(&Motion::X_WF, &Pose::r), {.symbol = "r"}},
      {"orientation", "1", "unit quaternion w, x, y, z", quaternion},
      {"velocity", "m/s", "of the origin, ground axes", &Motion::v, {.symbol = "v"}},
      {"angular_velocity", "rad/s", "ground axes", &Motion::omega, {.symbol = "omega"}},
      {"acceleration", "m/s^2", "of the origin, ground axes", &Motion::a, {.symbol = "a"}},
  };
  return table;
}

BodyRecord::BodyRecord(const std::string& name, const BodyRecord* other, results::Writer& writer)
    : rows_(table(), "/bodies/" + name + "/", {}, writer, other != nullptr ? &other->rows_ : nullptr) {}

void BodyRecord::describe(QuantityGroup& group) { run::describe(table(), "n", group); }

}  // namespace hersey::run
