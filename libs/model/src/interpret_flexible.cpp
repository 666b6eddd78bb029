#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "hersey/core/spelling.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/reduction.h"
#include "hersey/fem/skin.h"
#include "interpret.h"

namespace hersey::model {
namespace {

class FlexibleReader {
 public:
  FlexibleReader(Context& context, const Value& body) : context_(context), body_(body) {}

  Flexible read(const Value& value, std::vector<Frame>& frames) {
    Flexible flexible;
    flexible.position = value.key_position;
    flexible.nodal = text_of(value, "form") == "nodal";
    flexible.modes = integer_of(value, "modes");
    flexible.highest = number_of(value, "highest_frequency");
    if (const Value* damping = value.find("damping"))
      flexible.damping = {number_of(*damping, "mass"), number_of(*damping, "stiffness")};
    flexible.vtu_every = number_of(value, "vtu_every");
    refuse_rigid_keys();
    auto mesh = mesh_of(value);
    if (!mesh) return flexible;
    flexible.materials = materials_of(value, *mesh);
    place_frames(*mesh, frames);
    flexible.mesh = std::make_shared<const fem::Mesh>(std::move(*mesh));
    return flexible;
  }

 private:
  void refuse_rigid_keys() {
    for (const char* key : {"inertia", "centre_of_mass"})
      if (const Value* given = body_.find(key); given != nullptr && given->given)
        context_.fault_at_key(*given, std::string("`") + key + "` of a flexible body",
                              "what the mesh and its density give", "remove the key");
  }

  std::optional<fem::Mesh> mesh_of(const Value& value) {
    const Value *file = value.find("mesh"), *unit = value.find("length_unit");
    if (file == nullptr || file->broken || unit == nullptr || unit->broken) return std::nullopt;
    const auto path = std::filesystem::path(context_.model.file).parent_path() / file->text;
    try {
      fem::Mesh mesh = fem::read_mesh(path, unit->number);
      check_elements(mesh, *file);
      return mesh;
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults()) {
        std::string found = fault.found;
        if (!fault.position.file.empty())
          found = fault.position.file + ":" + std::to_string(fault.position.line) + ": " + found;
        context_.fault(*file, found, fault.expected, fault.suggestion);
      }
      return std::nullopt;
    }
  }

  void check_elements(const fem::Mesh& mesh, const Value& file) {
    const auto is_beam = [](const fem::Element& e) { return e.type == fem::ElementType::beam2; };
    if (std::any_of(mesh.elements.begin(), mesh.elements.end(), is_beam))
      context_.fault(file, "a mesh with beams", "solid elements alone: tetrahedra, wedges, hexahedra");
    if (mesh.elements.empty()) context_.fault(file, "a mesh without solid elements", "tetrahedra, wedges or hexahedra");
  }

  std::vector<fem::ElasticMaterial> materials_of(const Value& value, fem::Mesh& mesh) {
    if (const Value* given = value.find("material")) {
      for (fem::Element& element : mesh.elements) element.material = 0;
      return {{number_of(*given, "youngs_modulus"), number_of(*given, "poisson_ratio"), number_of(*given, "density")}};
    }
    std::vector<fem::ElasticMaterial> materials;
    const Value& at = *value.find("mesh");
    std::set<int> used;
    for (const fem::Element& element : mesh.elements) used.insert(element.material);
    const bool none = used.count(-1) > 0;
    if (none && mesh.materials.empty()) {
      context_.fault_at_key(value, "a mesh without materials", "a `material`, or a mesh file whose elements have one",
                            "add `material: {youngs_modulus: ..., poisson_ratio: ..., density: ...}`");
      return materials;
    }
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
      const fem::MeshMaterial& m = mesh.materials[i];
      const bool complete = m.youngs_modulus && m.poisson_ratio && m.density;
      if (!complete && (used.count(static_cast<int>(i)) > 0 || (none && i == 0)))
        context_.fault(at, "material '" + m.name + "' of the mesh file without " + missing_of(m),
                       "Young's modulus, Poisson's ratio and density", "complete it there, or give `material` here");
      materials.push_back({m.youngs_modulus.value_or(1), m.poisson_ratio.value_or(0), m.density.value_or(1)});
    }
    return materials;
  }

  static std::string missing_of(const fem::MeshMaterial& m) {
    if (!m.youngs_modulus) return "Young's modulus";
    return m.poisson_ratio ? "density" : "Poisson's ratio";
  }

  void place_frames(const fem::Mesh& mesh, std::vector<Frame>& frames) {
    if (frames.empty())
      context_.fault_at_key(body_, "a flexible body without frames", "at least one frame on a set of its nodes",
                            "add `frames: {name: {nodes: set}}`");
    for (Frame& frame : frames) {
      const Value& value = *body_.find("frames")->find(frame.name);
      const Value* nodes = value.find("nodes");
      if (nodes == nullptr) {
        context_.fault_at_key(value, "a frame of a flexible body without `nodes`", "the set of nodes it stands on",
                              expected_set(mesh));
        continue;
      }
      if (nodes->broken) continue;
      const auto set = mesh.node_sets.find(nodes->text);
      if (set == mesh.node_sets.end() || set->second.empty()) {
        std::vector<std::string> names;
        for (const auto& [name, members] : mesh.node_sets) names.push_back(name);
        context_.fault(*nodes,
                       (set == mesh.node_sets.end() ? "unknown node set '" : "empty node set '") + nodes->text + "'",
                       expected_set(mesh), did_you_mean(nodes->text, names));
        continue;
      }
      frame.nodes = set->second;
      claim(mesh, frame, *nodes);
      if (text_of(value, "connection") == "average") frame.connection = fem::Connection::average;
      if (value.find("origin") == nullptr) frame.X_BF.r = fem::face_centre(mesh, frame.nodes);
    }
  }

  /// Reports nodes that another frame stands on already.
  void claim(const fem::Mesh& mesh, const Frame& frame, const Value& at) {
    for (int n : frame.nodes) {
      const auto [owner, is_new] = owners_.try_emplace(n, frame.name);
      if (is_new) continue;
      context_.fault(at,
                     "node " + std::to_string(mesh.node_labels[static_cast<std::size_t>(n)]) + ", on which frame '" +
                         owner->second + "' stands too",
                     "sets of nodes that do not overlap");
      return;
    }
  }

  static std::string expected_set(const fem::Mesh& mesh) {
    if (mesh.node_sets.empty()) return "a mesh file with named sets; this one has none";
    std::vector<std::string> names;
    for (const auto& [name, members] : mesh.node_sets) names.push_back(name);
    return "a set of the mesh: " + one_of(names);
  }

  Context& context_;
  const Value& body_;
  std::map<int, std::string> owners_;  ///< frames by the nodes they stand on
};

/// Nodes stand for a mesh that a rigid body does not have.
void refuse_nodes(Context& context, const Value& body) {
  for (const auto& [name, value] : section(body, "frames"))
    for (const char* key : {"nodes", "connection"})
      if (const Value* given = value.find(key); given != nullptr)
        context.fault_at_key(*given, std::string("`") + key + "` of a frame on a rigid body", "an `origin`",
                             "only flexible bodies have nodes");
}

}  // namespace

std::optional<Flexible> flexible_of(Context& context, const Value& body, std::vector<Frame>& frames) {
  const Value* value = body.find("flexible");
  if (value == nullptr) {
    refuse_nodes(context, body);
    return std::nullopt;
  }
  if (value->broken) return std::nullopt;
  return FlexibleReader(context, body).read(*value, frames);
}

mbd::Shape skin_of(const fem::Mesh& mesh) {
  const fem::Skin skin = fem::skin(mesh);
  auto triangles = std::make_shared<mbd::TriangleMesh>();
  for (int n : skin.nodes) triangles->corners.push_back(mesh.nodes[static_cast<std::size_t>(n)]);
  for (const auto& t : skin.triangles) triangles->triangles.push_back({t[0], t[1], t[2]});
  return {"mesh", std::shared_ptr<const mbd::TriangleMesh>(std::move(triangles))};
}

}  // namespace hersey::model
