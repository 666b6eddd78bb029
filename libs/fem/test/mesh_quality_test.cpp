#include "hersey/fem/mesh_quality.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <limits>

#include "hersey/fem/elastic_body.h"
#include "hersey/fem/mesh_file.h"
#include "source_dir.h"

namespace hersey::fem {
namespace mesh_quality_test {

constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();

Mesh file(const std::string& name) {
  return read_mesh(std::filesystem::path(hersey::source_dir()) / "libs/fem/test/data" / name, 1e-3);
}

TEST_CASE("CornerShape_IsOneForTheIdealCorner_OfAnySizeAndRotation") {
  const Matrix3 R = 7.0 * Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  Matrix3 tetrahedron;
  tetrahedron << 1, 0.5, 0.5, 0, std::sqrt(0.75), std::sqrt(0.75) / 3, 0, 0, std::sqrt(2.0 / 3);
  CHECK(corner_shape(ElementType::tet10, R * tetrahedron) == doctest::Approx(1).epsilon(round_off));
  CHECK(corner_shape(ElementType::hex8, R) == doctest::Approx(1).epsilon(round_off));
  // Edges 1, 1, a: 3 a^(2/3) / (2 + a^2).
  CHECK(corner_shape(ElementType::hex8, Vector3(1, 1, 8).asDiagonal()) ==
        doctest::Approx(12.0 / 66).epsilon(round_off));
  CHECK(corner_shape(ElementType::hex8, Vector3(1, 1, -1).asDiagonal()) == 0);
}

TEST_CASE("QualityOfBoxes_IsThatOfTheirCells_InEveryShape") {
  for (const ElementType type : {ElementType::tet4, ElementType::tet10, ElementType::wedge6, ElementType::wedge15,
                                 ElementType::hex8, ElementType::hex20}) {
    CAPTURE(name_of(type));
    const MeshQuality quality = quality_of(box_mesh(type, {0.4, 0.2, 0.1}, {4, 2, 1}));
    CHECK(quality.volume == doctest::Approx(0.4 * 0.2 * 0.1).epsilon(round_off));
    CHECK((quality.upper - quality.lower - Vector3(0.4, 0.2, 0.1)).norm() < round_off);
    CHECK(quality.folded.empty());
    CHECK(quality.repeated.empty());
    CHECK(quality.touching.empty());
    CHECK(quality.parts.size() == 1);
    CHECK(quality.types.at(type).smallest_shape > 0.5);  // cubes and their even cuts
    CHECK(faults_of(quality, "x").empty());
    CHECK(warnings_of(quality, "x").empty());
    CHECK_FALSE(quality.mass.has_value());
  }
  const MeshQuality cubes = quality_of(box_mesh(ElementType::hex8, {0.4, 0.2, 0.1}, {4, 2, 1}));
  CHECK(cubes.types.at(ElementType::hex8).smallest_shape == doctest::Approx(1).epsilon(round_off));
  CHECK(cubes.types.at(ElementType::hex8).largest_aspect == doctest::Approx(1).epsilon(round_off));
}

TEST_CASE("Mass_IsThatOfTheFilesDensity") {
  const MeshQuality quality = quality_of(file("sets.inp"));
  CHECK(quality.mass.value() == doctest::Approx(7850 * 0.01 * 0.01 * 0.02).epsilon(1e-14));  // round-off
}

TEST_CASE("FoldedElements_AreNamedByTheirLabels") {
  Mesh mesh = file("sets.inp");
  int* const nodes = mesh.connectivity.data() + mesh.elements[1].first;
  std::swap_ranges(nodes, nodes + 4, nodes + 4);  // inside out
  const MeshQuality quality = quality_of(mesh);
  CHECK(quality.folded == std::vector<long>{102});
  const std::vector<Fault> faults = faults_of(quality, "x");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].found == "an element with a Jacobian that is not positive: 102");
}

TEST_CASE("RepeatedElements_AndUnmergedNodes_AreNamed") {
  Mesh mesh = file("sets.inp");
  Element again = mesh.elements[0];
  again.label = 103;
  mesh.elements.push_back(again);
  CHECK(quality_of(mesh).repeated == std::vector<std::pair<long, long>>{{101, 103}});
  // The upper cube on nodes of its own: two parts, and four pairs of nodes on each other.
  mesh.elements.pop_back();
  for (int k = 0; k < 4; ++k) {
    int& node = mesh.connectivity[static_cast<std::size_t>(mesh.elements[1].first + k)];
    mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    mesh.node_labels.push_back(1000 + node);
    node = static_cast<int>(mesh.nodes.size()) - 1;
  }
  const MeshQuality quality = quality_of(mesh);
  CHECK(quality.parts.size() == 2);
  CHECK(quality.touching.size() == 4);
  const std::vector<Fault> faults = faults_of(quality, "x");
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].found == "2 parts that share no node: 1 element (one is 101), 1 element (one is 102)");
  CHECK(faults[0].suggestion.starts_with("merge the nodes"));
  CHECK(warnings_of(quality, "x").size() == 1);
}

TEST_CASE("MillimetresReadAsMetres_AreWarnedOf") {
  const std::filesystem::path path = std::filesystem::path(hersey::source_dir()) / "libs/fem/test/data/sets.inp";
  const std::vector<Fault> warnings = warnings_of(quality_of(read_mesh(path, 1)), "x");
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].found == "a body of 10 x 10 x 20 m, 2000 m^3, 1.57e-05 kg");
  CHECK(warnings[0].suggestion == "is the mesh in millimetres? then give its length unit, mm");
  const std::vector<Fault> small = warnings_of(quality_of(read_mesh(path, 1e-6)), "x");
  REQUIRE(small.size() == 1);
  CHECK(small[0].suggestion == "is the mesh in metres? then give its length unit, m");
}

}  // namespace mesh_quality_test
}  // namespace hersey::fem
