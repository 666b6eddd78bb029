#pragma once

#include <vector>

#include "hersey/model/build.h"
#include "table/quantity.h"

namespace hersey::run {

/// Pressures and forces on the meshes of flexible bodies, in the results file.
class SurfaceLoadRecord {
 public:
  /// @param machine  outlives this
  SurfaceLoadRecord(const model::Machine& machine, results::Writer& writer);
  void append(const mbd::Observation& observation) const;
  [[nodiscard]] static QuantityGroup describe();

 private:
  struct Plan {
    const model::Machine& machine;
    const model::BuiltSurfaceLoad& load;
  };
  [[nodiscard]] static const QuantityTable<mbd::ElasticLoad, Plan>& table();
  [[nodiscard]] static const std::vector<Attribute<Plan>>& attributes();

  const model::Machine& machine_;
  std::vector<QuantityRows<mbd::ElasticLoad, Plan>> loads_;
};

}  // namespace hersey::run
