#include <algorithm>

#include "hersey/core/spelling.h"
#include "hersey/fem/load_distributions.h"
#include "interpret/context/interpret.h"
#include "schema/machine_vocabulary.h"

// Loads on the mesh of a flexible body.
namespace hersey::model {
namespace {

/// The flexible body that `body` names; null where there is none, reported.
const Body* flexible_body(Context& context, const Value& value) {
  const Value* name = value.find("body");
  if (name == nullptr || name->broken) return nullptr;
  std::vector<std::string> names;
  for (const Body& body : context.model.bodies)
    if (body.flexible) names.push_back(body.name);
  for (const Body& body : context.model.bodies)
    if (body.flexible && body.name == name->text) return &body;
  const std::vector<std::string> all = names_in(context.root, "bodies");
  const bool rigid = std::find(all.begin(), all.end(), name->text) != all.end();
  context.fault(*name, (rigid ? "rigid body '" : "unknown body '") + name->text + "'",
                names.empty() ? "a flexible body, but the model has none" : "a flexible body: " + one_of(names),
                rigid ? "a `force` acts on rigid bodies too" : did_you_mean(name->text, names));
  return nullptr;
}

std::string expected_faces(const fem::Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto& [name, faces] : mesh.surfaces) names.push_back(name);
  for (const auto& [name, nodes] : mesh.node_sets)
    if (mesh.surfaces.count(name) == 0) names.push_back(name);
  return names.empty() ? "a mesh file with named surfaces or sets of nodes; this one has none"
                       : "a surface or set of nodes of the mesh: " + one_of(names);
}

}  // namespace

std::vector<fem::ElementFace> faces_of(Context& context, const Value& name, const fem::Mesh& mesh) {
  if (name.broken) return {};
  std::vector<fem::ElementFace> faces = fem::faces_called(mesh, name.text);
  if (!faces.empty()) return faces;
  const bool known = mesh.surfaces.count(name.text) + mesh.node_sets.count(name.text) > 0;
  std::vector<std::string> names;
  for (const auto& [known_name, nodes] : mesh.node_sets) names.push_back(known_name);
  for (const auto& [known_name, surface] : mesh.surfaces) names.push_back(known_name);
  if (known)
    context.fault(name, "set '" + name.text + "', whose nodes make up no face of the body's surface",
                  "a set that holds all nodes of each face");
  else
    context.fault(name, "unknown surface or set '" + name.text + "'", expected_faces(mesh),
                  did_you_mean(name.text, names));
  return {};
}

SurfaceLoad surface_load_of(Context& context, const Value& value) {
  SurfaceLoad load;
  load.is_pressure = value.text == "pressure";
  load.axes = meaning_of(value, "axes", axes_of_body_words, Axes::body);
  if (const Body* body = flexible_body(context, value)) {
    load.body = body->name;
    const Value* faces = value.find("faces");
    if (body->flexible->mesh && faces != nullptr) load.faces = faces_of(context, *faces, *body->flexible->mesh);
  }
  if (const Value* pressure = value.find("pressure")) load.functions.push_back(function_of(context, *pressure, "Pa"));
  if (value.find("towards") != nullptr) load.direction = direction_of(context, value, "towards");
  if (value.find("direction") != nullptr) load.direction = direction_of(context, value, "direction");
  if (const Value* magnitude = value.find("magnitude")) load.functions.push_back(function_of(context, *magnitude, "N"));
  if (const Value* components = value.find("components"))
    for (const auto& [index, component] : components->members)
      load.functions.push_back(function_of(context, component, "N"));
  return load;
}

}  // namespace hersey::model
