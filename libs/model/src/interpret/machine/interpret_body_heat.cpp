#include <algorithm>
#include <set>
#include <utility>

#include "hersey/core/spelling.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/skin.h"
#include "interpret/context/interpret.h"

// How bodies conduct heat and expand.
namespace hersey::model {
namespace {

/// Nodes of a set, or of a surface; none where there is no such name, reported.
std::vector<int> nodes_called(Context& context, const Value& at, const std::string& name, const fem::Mesh& mesh) {
  if (const auto set = mesh.node_sets.find(name); set != mesh.node_sets.end()) return set->second;
  if (const auto surface = mesh.surfaces.find(name); surface != mesh.surfaces.end())
    return fem::nodes_on(mesh, surface->second);
  std::vector<std::string> names;
  for (const auto& [known, nodes] : mesh.node_sets) names.push_back(known);
  for (const auto& [known, faces] : mesh.surfaces)
    if (mesh.node_sets.count(known) == 0) names.push_back(known);
  context.fault_at_key(at, "unknown surface or set '" + name + "'",
                       names.empty() ? "a mesh file with named sets; this one has none" : one_of(names),
                       did_you_mean(name, names));
  return {};
}

bool is_known(const fem::Mesh& mesh, const std::string& name) {
  return mesh.node_sets.count(name) + mesh.surfaces.count(name) > 0;
}

/// Outer faces that are not cooled otherwise and have a node whose temperature is not given.
std::vector<fem::ElementFace> rest_of(const fem::Mesh& mesh, const fem::ThermalSurroundings& named) {
  std::vector<char> is_prescribed(mesh.nodes.size(), 0);
  for (const fem::PrescribedNodes& prescribed : named.prescribed)
    for (const int node : prescribed.nodes) is_prescribed[static_cast<std::size_t>(node)] = 1;
  std::set<std::pair<int, int>> taken;
  for (const fem::CooledFaces& cooled : named.cooled)
    for (const fem::ElementFace face : cooled.faces) taken.emplace(face.element, face.face);
  std::vector<fem::ElementFace> rest = fem::outer_faces(mesh);
  std::erase_if(rest, [&](fem::ElementFace face) {
    const std::vector<int> nodes = fem::nodes_of(mesh, face);
    return taken.count({face.element, face.face}) > 0 || std::all_of(nodes.begin(), nodes.end(), [&](int node) {
             return is_prescribed[static_cast<std::size_t>(node)] != 0;
           });
  });
  return rest;
}

}  // namespace

BodyHeat body_heat_of(Context& context, const Value& value, const fem::Mesh& mesh) {
  BodyHeat heat;
  if (value.broken) return heat;
  heat.material = {.conductivity = number_of(value, "conductivity"), .expansion = number_of(value, "expansion")};
  heat.T_reference = number_of(value, "reference_temperature");
  double transfer = 0;
  const Value* rest = nullptr;
  for (const auto& [name, cooling] : section(value, "cooling")) {
    if (cooling.broken) continue;
    transfer += number_of(cooling, "heat_transfer");
    if (name == "rest" && !is_known(mesh, name)) {
      rest = &cooling;
      continue;
    }
    const std::vector<int> nodes = nodes_called(context, cooling, name, mesh);
    fem::CooledFaces cooled{fem::faces_called(mesh, name), number_of(cooling, "heat_transfer"),
                            number_of(cooling, "ambient")};
    if (!nodes.empty() && cooled.faces.empty())
      context.fault_at_key(cooling, "set '" + name + "', whose nodes make up no face of the body's surface",
                           "a set that holds all nodes of each face");
    heat.surroundings.cooled.push_back(std::move(cooled));
  }
  for (const auto& [name, T] : section(value, "temperatures"))
    if (!T.broken) heat.surroundings.prescribed.push_back({nodes_called(context, T, name, mesh), T.number});
  if (rest != nullptr) {
    heat.rest = heat.surroundings.cooled.size();
    heat.surroundings.cooled.push_back(
        {rest_of(mesh, heat.surroundings), number_of(*rest, "heat_transfer"), number_of(*rest, "ambient")});
  }
  for (const auto& [index, name] : section(value, "fixed")) {
    if (name.broken) continue;
    const std::vector<int> nodes = nodes_called(context, name, name.text, mesh);
    heat.fixed.insert(heat.fixed.end(), nodes.begin(), nodes.end());
  }
  if (transfer == 0 && heat.surroundings.prescribed.empty() && !context.has_fault_in(value.path))
    context.fault_at_key(value, "a body whose heat has no path to the surroundings",
                         "`cooling` of one of its surfaces, or `temperatures` of some nodes",
                         "add `cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}`");
  return heat;
}

}  // namespace hersey::model
