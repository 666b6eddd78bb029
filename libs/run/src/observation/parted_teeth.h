#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/mbd/gear_mesh.h"

namespace hersey::run {

/// For how long, and by how much, the teeth of each gear mesh would have parted: the mesh pulls there, as no flanks do.
class PartedTeeth {
 public:
  explicit PartedTeeth(std::vector<std::string> names);
  /// @param dt  length of the step that ended [s]; an instant by itself counts as all of the time
  void take(const std::vector<mbd::GearMesh::Load>& meshes, double dt);
  /// Message about meshes whose teeth would have parted; empty if there are none.
  [[nodiscard]] std::string warning() const;
  void persist(Archive& archive);

 private:
  std::vector<std::string> names_;
  Eigen::VectorXd parted_, least_;  // time [s] or, of an instant, 1; smallest force [N]
  double time_ = 0;                 // [s]
};

}  // namespace hersey::run
