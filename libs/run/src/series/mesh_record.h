#pragma once

#include "hersey/mbd/gear_mesh.h"
#include "hersey/model/machine.h"
#include "table/quantity.h"

namespace hersey::run {

/// One gear mesh in the results file.
class MeshRecord {
 public:
  MeshRecord(const model::BuiltMesh& mesh, results::Writer& writer);
  void append(const mbd::GearMesh::Load& load) const { rows_.append(load); }
  static void describe(QuantityGroup& group);

 private:
  using Row = mbd::GearMesh::Load;
  [[nodiscard]] static const QuantityTable<Row, model::BuiltMesh>& table();
  QuantityRows<Row, model::BuiltMesh> rows_;
};

}  // namespace hersey::run
