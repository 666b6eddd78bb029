#include "series/flexible_record.h"

#include "hersey/fem/skin.h"

namespace hersey::run {
namespace {

int shape_count(const model::BuiltFlexible& body) { return static_cast<int>(body.shapes.cols()); }
bool has_shapes(const model::BuiltFlexible& body) { return shape_count(body) > 0; }

/// Displacements of the corners of the body's skin for a unit amplitude of each shape, shape after shape.
std::vector<double> deformation_of_skin(const model::BuiltFlexible& body) {
  const fem::Skin skin = fem::skin(*body.mesh);
  std::vector<double> values;
  values.reserve(3 * skin.nodes.size() * static_cast<std::size_t>(body.shapes.cols()));
  for (Eigen::Index shape = 0; shape < body.shapes.cols(); ++shape)
    for (const int node : skin.nodes)
      for (int axis = 0; axis < 3; ++axis) values.push_back(body.shapes(3 * node + axis, shape));
  return values;
}

std::vector<std::string> loaded_surfaces(const model::BuiltFlexible& body) {
  std::vector<std::string> names;
  for (const fem::StaticError& error : body.static_errors) names.push_back(error.surface);
  return names;
}

const QuantityTable<FlexibleRow, model::BuiltFlexible>& flexible_quantities() {
  static const QuantityTable<FlexibleRow, model::BuiltFlexible> table{
      {"strain_energy",
       "J",
       "strain energy",
       [](const FlexibleRow& row) { return row.observation.energy.strain; },
       {.note = "of a flexible body; its further frames are bodies `<b>.<frame>`, and joints of the same name hold "
                "their deformation"}},
      {"dissipation",
       "W",
       "power lost to the material's damping",
       [](const FlexibleRow& row) { return row.observation.energy.dissipation; },
       {.note = "of a flexible body"}},
      {"amplitudes",
       "SI",
       "of the shapes: [rotation; displacement] of each frame but the first against it, then vibrations with all "
       "frames fixed [m]",
       &FlexibleRow::amplitudes,
       {.note = "of a flexible body",
        .only = has_shapes,
        .extent = {"shapes",
                   [](const model::BuiltFlexible& body, std::size_t /*k*/) { return std::vector{shape_count(body)}; },
                   {"shape"}}}},
  };
  return table;
}

const std::vector<Constant<model::BuiltFlexible>>& flexible_constants() {
  static const std::vector<Constant<model::BuiltFlexible>> table{
      {"shapes/mesh/deformation",
       "SI",
       "displacement of each corner (x, y, z) by a unit amplitude, shape after shape, body axes",
       "[shapes x corners x 3]",
       deformation_of_skin,
       {},
       {.note = "of a flexible body's skin",
        .only = [](const model::BuiltFlexible& body) { return has_shapes(body) && !body.mesh->elements.empty(); }}},
      {"held_frequencies",
       "Hz",
       "of the vibrations with all frames fixed",
       "[modes]",
       &model::BuiltFlexible::frequencies,
       {},
       {.note = "of a flexible body",
        .only = [](const model::BuiltFlexible& body) { return !body.frequencies.empty(); }}},
  };
  return table;
}

const std::vector<Attribute<model::BuiltFlexible>>& flexible_attributes() {
  static const std::vector<Attribute<model::BuiltFlexible>> table{
      {"flexible_nodes",
       "1",
       "nodes of its mesh",
       [](const model::BuiltFlexible& body) { return static_cast<int>(body.mesh->nodes.size()); },
       {.note = "of a flexible body"}},
      {"flexible_shapes", "1", "shapes it moves in", shape_count, {.note = "of a flexible body"}},
      {"static_error_<surface>",
       "1",
       "how far its shapes miss the static displacement of the mesh under pressure on the surface",
       [](const model::BuiltFlexible& body, std::size_t k) { return body.static_errors[k].reduced; },
       {.note = "of a flexible body with `load_surfaces`", .each = loaded_surfaces}},
  };
  return table;
}

std::string group_of(const model::BuiltFlexible& body) { return "/bodies/" + body.name + "/"; }

}  // namespace

FlexibleRecord::FlexibleRecord(const model::BuiltFlexible& body, results::Writer& writer)
    : body_(body), rows_(flexible_quantities(), group_of(body), body, writer) {
  write_once(flexible_constants(), group_of(body), body, writer);
  write_once(flexible_attributes(), group_of(body), body, writer);
}

void FlexibleRecord::append(const mbd::Observation& observation) const {
  const mbd::ElasticObservation& elastic = observation.elastics[static_cast<std::size_t>(body_.elastic.index)];
  rows_.append({elastic, body_.body->amplitudes(elastic.motion)});
}

void FlexibleRecord::describe(QuantityGroup& group) {
  run::describe(flexible_attributes(), "n", group);
  run::describe(flexible_quantities(), "n", group);
  run::describe(flexible_constants(), "n", group);
}

}  // namespace hersey::run
