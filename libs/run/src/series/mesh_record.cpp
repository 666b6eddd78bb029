#include "series/mesh_record.h"

namespace hersey::run {

const QuantityTable<MeshRecord::Row, model::BuiltMesh>& MeshRecord::table() {
  static const QuantityTable<Row, model::BuiltMesh> table{
      {"mesh_force",
       "N",
       "by which the flanks press on each other, along their normal; below zero they would part",
       &Row::normal,
       {.note = "this and the following: of a `gear_mesh`",
        .summary_entries =
            {{.statistic = SummaryEntry::Statistic::largest, .name = "largest mesh force", .unit = "N"},
             {.statistic = SummaryEntry::Statistic::smallest, .name = "smallest mesh force", .unit = "N"}}}},
      {"mesh_force_tangential", "N", "on the first wheel at its pitch circle, against the torque of its shaft",
       &Row::tangential},
      {"mesh_force_radial", "N", "on the first wheel, towards its axis", &Row::radial},
      {"mesh_force_axial", "N", "on the first wheel, along its z-axis", &Row::axial},
      {"mesh_deflection",
       "m",
       "of the teeth along the normal of the flanks, the transmission error included",
       &Row::deflection,
       {.summary_entries =
            {{.statistic = SummaryEntry::Statistic::largest, .name = "largest mesh deflection", .unit = "µm"}}}},
      {"mesh_damping_power", "W", "taken by the damping of the mesh", &Row::damping_power},
  };
  return table;
}

MeshRecord::MeshRecord(const model::BuiltMesh& mesh, results::Writer& writer)
    : rows_(table(), "/forces/" + mesh.name + "/", mesh, writer) {}

void MeshRecord::describe(QuantityGroup& group) { run::describe(table(), "n", group); }

}  // namespace hersey::run
