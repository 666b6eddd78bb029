#include "hersey/fem/gmsh_file.h"

#include <doctest/doctest.h>

#include "hersey/fem/mesh_file.h"
#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace gmsh_file_test {

using Pairs = std::vector<std::pair<int, int>>;

Pairs pairs_of(std::vector<ElementFace> faces) {
  Pairs pairs;
  for (const ElementFace face : faces) pairs.emplace_back(face.element, face.face);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST_CASE("WrittenMesh_IsReadAsItWas_InEveryElement") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    Mesh mesh = ring_mesh(type, {0.0225, 0.03, 0.0156, {1, 12, 2}});
    mesh.element_sets = {{"first", {0, 1, 2}}, {"both", {2, 3}}};
    mesh.node_sets["spot"] = {3, 5};
    mesh.surfaces["bore too"] = mesh.surfaces.at("bore");
    mesh.node_labels.back() += 7;
    mesh.elements.back().label += 5;
    write_gmsh("written.msh", mesh);
    std::vector<Fault> warnings;
    const Mesh read = read_mesh("written.msh", 1, &warnings);
    CHECK(warnings.empty());
    REQUIRE(read.nodes.size() == mesh.nodes.size());
    CHECK(read.nodes == mesh.nodes);  // numbers are written with all their digits
    CHECK(read.node_labels == mesh.node_labels);
    CHECK(read.connectivity == mesh.connectivity);
    REQUIRE(read.elements.size() == mesh.elements.size());
    CHECK(read.elements.back().label == mesh.elements.back().label);
    CHECK(read.elements.back().type == type);
    CHECK(read.element_sets == mesh.element_sets);
    CHECK(read.node_sets.at("spot") == mesh.node_sets.at("spot"));
    REQUIRE(read.surfaces.size() == mesh.surfaces.size());
    for (const auto& [name, faces] : mesh.surfaces) {
      CHECK(pairs_of(read.surfaces.at(name)) == pairs_of(faces));
      if (mesh.node_sets.contains(name)) CHECK(read.node_sets.at(name) == mesh.node_sets.at(name));
    }
  }
}

TEST_CASE("MeshThatCannotBeWritten_IsReportedWithItsFile") {
  const Mesh mesh = ring_mesh(ElementType::hex8, {});
  CHECK_THROWS_WITH_AS(write_gmsh("no/such/folder.msh", mesh), doctest::Contains("no/such/folder.msh"),
                       std::runtime_error);
}

}  // namespace gmsh_file_test
}  // namespace hersey::fem
