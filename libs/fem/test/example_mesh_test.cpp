#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/reduction.h"
#include "source_dir.h"

// The meshes kept in examples/meshes hold what their page says: they are what a reader tries first.

namespace hersey::fem {
namespace example_mesh_test {

std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(hersey::source_dir()) / "examples/meshes" / name;
}

/// Largest distance of a set's nodes from the cylinder of `radius` about the axis through `centre` along z [m].
double off_cylinder(const Mesh& mesh, const std::string& set, const Vector3& centre, double radius) {
  double largest = 0;
  for (const int n : mesh.node_sets.at(set)) {
    const Vector3 r = mesh.nodes[static_cast<std::size_t>(n)] - centre;
    largest = std::max(largest, std::abs(std::hypot(r.x(), r.y()) - radius));
  }
  return largest;
}

// Files keep 1e-7 mm; Gmsh places nodes on a cylinder to about that.
constexpr double kOnCylinder = 1e-9;

TEST_CASE("ExampleMeshes_AreSound") {
  for (const std::string name : {"conrod.msh", "crankshaft.msh", "bearing_housing.msh"}) {
    CAPTURE(name);
    std::vector<Fault> warnings;
    const MeshQuality quality = quality_of(read_mesh(example(name), 1e-3, &warnings));
    CHECK(warnings.empty());
    CHECK(faults_of(quality, name).empty());
    CHECK(warnings_of(quality, name).empty());
  }
}

TEST_CASE("ConrodMesh_HasItsBoresOnTrueCylinders") {
  const Mesh mesh = read_mesh(example("conrod.msh"), 1e-3);
  CHECK(off_cylinder(mesh, "big_end", Vector3::Zero(), 0.0225) < kOnCylinder);
  CHECK(off_cylinder(mesh, "small_end", {0, 0.140, 0}, 0.010) < kOnCylinder);
  CHECK(mesh.surfaces.contains("big_end"));
  CHECK(mesh.element_sets.at("cap").size() + mesh.element_sets.at("rod").size() == mesh.elements.size());
}

TEST_CASE("CentreOfABoresFaces_IsOnItsAxis") {
  // Nodes are not evenly spread (their mean lies 0.9 mm off), and neither are faces: the coarse small end's chords cut
  // off more of the bore where they are long.
  const Mesh mesh = read_mesh(example("conrod.msh"), 1e-3);
  const Vector3 big_end = face_centre(mesh, mesh.node_sets.at("big_end"));
  const Vector3 small_end = face_centre(mesh, mesh.node_sets.at("small_end"));
  CHECK(big_end.norm() < 5e-6);
  CHECK((small_end - Vector3(0, 0.140, 0)).norm() < 5e-6);
}

TEST_CASE("CrankshaftMesh_HasItsJournalsOnTrueCylinders") {
  const Mesh mesh = read_mesh(example("crankshaft.msh"), 1e-3);
  for (const std::string journal : {"main_1", "main_2", "main_3", "main_4", "main_5"})
    CHECK(off_cylinder(mesh, journal, Vector3::Zero(), 0.026) < kOnCylinder);
  for (const std::string pin : {"pin_1", "pin_4"}) CHECK(off_cylinder(mesh, pin, {0, 0.040, 0}, 0.022) < kOnCylinder);
  for (const std::string pin : {"pin_2", "pin_3"}) CHECK(off_cylinder(mesh, pin, {0, -0.040, 0}, 0.022) < kOnCylinder);
}

}  // namespace example_mesh_test
}  // namespace hersey::fem
