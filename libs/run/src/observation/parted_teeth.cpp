#include "observation/parted_teeth.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace hersey::run {
namespace {

constexpr double kParts = 1e-9;  // m: below the roughness of any flank, above round-off

}  // namespace

PartedTeeth::PartedTeeth(std::vector<std::string> names) : names_(std::move(names)) {
  parted_.setZero(static_cast<Eigen::Index>(names_.size()));
  least_.setZero(parted_.size());
}

void PartedTeeth::take(const std::vector<mbd::GearMesh::Load>& meshes, double dt) {
  if (dt > 0 && time_ == 0) parted_.setZero();
  for (Eigen::Index i = 0; i < parted_.size(); ++i) {
    const mbd::GearMesh::Load& mesh = meshes[static_cast<std::size_t>(i)];
    least_[i] = std::min(least_[i], mesh.normal);
    if (mesh.deflection < -kParts && mesh.normal < 0) parted_[i] += dt > 0 ? dt : time_ == 0 ? 1 : 0;
  }
  time_ += dt;
}

std::string PartedTeeth::warning() const {
  std::string text;
  for (Eigen::Index i = 0; i < parted_.size(); ++i) {
    if (!(parted_[i] > 0)) continue;
    text += fmt::format(
        "{}gear mesh {}: for {:.3g} % of the time its teeth would part, at a mesh force down to {:.4g} N, and the mesh "
        "pulls there instead; a torque of the other sign wants another `torque_on_first`",
        text.empty() ? "" : "; ", names_[static_cast<std::size_t>(i)], 100 * (time_ > 0 ? parted_[i] / time_ : 1.0),
        least_[i]);
  }
  return text;
}

void PartedTeeth::persist(Archive& archive) {
  archive.io("parted", parted_), archive.io("least", least_), archive.io("time", time_);
}

}  // namespace hersey::run
