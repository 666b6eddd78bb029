#include "hersey/fem/skin.h"
#include "interpret/context/interpret.h"

// Faces of flexible bodies that touch other bodies.
namespace hersey::model {
namespace {

DeformingFaces deforming(const std::string& name, const fem::Mesh& mesh, const std::vector<fem::ElementFace>& faces) {
  const fem::Skin skin = fem::skin(mesh, faces);
  auto triangles = std::make_shared<mbd::TriangleMesh>();
  triangles->corners.reserve(skin.nodes.size());
  for (const int node : skin.nodes) triangles->corners.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
  triangles->triangles = skin.triangles;
  return {{name, std::shared_ptr<const mbd::TriangleMesh>(std::move(triangles))}, skin.nodes, faces};
}

}  // namespace

std::vector<DeformingFaces> faces_of_body(Context& context, const Value& body, const Flexible* flexible) {
  std::vector<DeformingFaces> all;
  const fem::Mesh* mesh = flexible != nullptr ? flexible->mesh.get() : nullptr;
  for (const auto& [name, value] : section(body, "shapes")) {
    if (value.broken || value.text != "faces") continue;
    const Value* of = value.find("of");
    if (of == nullptr || of->broken || (flexible != nullptr && mesh == nullptr)) continue;
    if (mesh == nullptr || mesh->elements.empty()) {
      context.fault_at_key(value, mesh == nullptr ? "`faces` of a rigid body" : "`faces` of a body without elements",
                           "a flexible body with a mesh", "a rigid surface is a `mesh`");
      continue;
    }
    const std::vector<fem::ElementFace> faces = faces_of(context, *of, *mesh);
    if (!faces.empty()) all.push_back(deforming(name, *mesh, faces));
  }
  return all;
}

DeformingFaces skin_of(const fem::Mesh& mesh) { return deforming("mesh", mesh, fem::outer_faces(mesh)); }

}  // namespace hersey::model
