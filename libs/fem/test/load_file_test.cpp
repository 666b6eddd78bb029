// Files of loads: read back by the program's own readers of meshes, and line by line.
#include "hersey/fem/load_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

#include "hersey/fem/mesh_file.h"
#include "hersey/fem/skin.h"
#include "ring.h"
#include "small_bodies.h"
#include "temporary_directory.h"

namespace hersey::fem {
namespace load_file_test {

constexpr double digits = 1e-9;  // of numbers in the files

const std::vector<SolidMaterial> steel{isotropic({.youngs_modulus = 210e9, .poisson_ratio = 0.3, .density = 7850})};

LoadedBody loaded(const Mesh& mesh, const std::vector<SolidMaterial>& materials) {
  LoadedBody body{.name = "ring",
                  .mesh = mesh,
                  .materials = materials,
                  .fixed_dofs = {0, 1, 2, 5},
                  .films = {},
                  .faces = mesh.surfaces.at("bore"),
                  .instants = {}};
  for (const double t : {0.0, 1e-3})
    body.instants.push_back(
        {t, "instant", Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(body.faces.size()), 1e6 + t, 2e6)});
  return body;
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

void check_same(const Mesh& written, const Mesh& read) {
  REQUIRE(read.nodes.size() == written.nodes.size());
  CHECK(read.node_labels == written.node_labels);
  for (std::size_t n = 0; n < read.nodes.size(); ++n) CHECK((read.nodes[n] - written.nodes[n]).norm() < digits * 0.03);
  REQUIRE(read.elements.size() == written.elements.size());
  for (std::size_t e = 0; e < read.elements.size(); ++e) {
    const Element &a = read.elements[e], &b = written.elements[e];
    CHECK(a.type == b.type);
    CHECK(a.label == b.label);
    CHECK(std::equal(read.nodes_of(a), read.nodes_of(a) + node_count(a.type), written.nodes_of(b)));
  }
  REQUIRE(read.materials.size() == 1);
  CHECK(*read.materials[0].youngs_modulus == doctest::Approx(210e9).epsilon(digits));
  CHECK(*read.materials[0].poisson_ratio == doctest::Approx(0.3).epsilon(digits));
  CHECK(*read.materials[0].density == doctest::Approx(7850).epsilon(digits));
}

TEST_CASE("WrittenMeshes_AreReadBack_InBothUnits") {
  for (const ElementType type : {ElementType::tet4, ElementType::tet10, ElementType::wedge6, ElementType::wedge15,
                                 ElementType::hex8, ElementType::hex20})
    for (const auto& [units, length] : {std::pair(FileUnits::si, 1.0), std::pair(FileUnits::millimetres, 1e-3)}) {
      CAPTURE(name_of(type));
      const TemporaryDirectory folder;
      const Mesh mesh = ring_mesh(type, Ring{.cells = {1, 12, 2}});
      const LoadedBody body = loaded(mesh, steel);
      write_calculix_loads(folder / ".", body, units);
      write_nastran_loads(folder / ".", body, units);
      const Mesh calculix = read_mesh(folder / "ring_mesh.inp", length);
      check_same(mesh, calculix);
      CHECK(calculix.surfaces.at("bore").size() == mesh.surfaces.at("bore").size());
      CHECK(calculix.node_sets.at("top") == mesh.node_sets.at("top"));
      check_same(mesh, read_mesh(folder / "ring.bdf", length));
    }
}

/// The ring warm in its bore and cooled outside, by two surroundings of which one lies on every other face alone.
BodyTemperatures warm(const Mesh& mesh) {
  const std::vector<ElementFace>& outside = mesh.surfaces.at("outside");
  BodyTemperatures heat{.material = {.conductivity = 46, .expansion = 12e-6},
                        .T_reference = 293.15,
                        .prescribed = {},
                        .cooled = {{outside, 80, 293.15}, {{}, 20, 318.15}},
                        .T = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(mesh.nodes.size()), 343.15),
                        .source = "a test"};
  for (std::size_t f = 0; f < outside.size(); f += 2) heat.cooled[1].faces.push_back(outside[f]);
  for (const int node : mesh.node_sets.at("bore")) heat.prescribed[node] = 343.15;
  return heat;
}

std::size_t count_of(const std::vector<std::string>& lines, const std::string& beginning) {
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(beginning); }));
}

TEST_CASE("FilesOfWarmBodies_AreReadBack_AndNameEveryCooledFaceOnce") {
  for (const ElementType type : {ElementType::tet4, ElementType::tet10, ElementType::wedge15, ElementType::hex20}) {
    CAPTURE(name_of(type));
    const TemporaryDirectory folder;
    const Mesh mesh = ring_mesh(type, Ring{.cells = {1, 12, 2}});
    LoadedBody body = loaded(mesh, steel);
    body.heat = warm(mesh);
    write_calculix_loads(folder / ".", body, FileUnits::si);
    write_nastran_loads(folder / ".", body, FileUnits::si);
    check_same(mesh, read_mesh(folder / "ring_mesh.inp", 1));
    check_same(mesh, read_mesh(folder / "ring.bdf", 1));
    const std::size_t cooled = mesh.surfaces.at("outside").size(), fixed = mesh.node_sets.at("bore").size();
    const std::vector<std::string> inp = lines_of(folder / "ring_heat.inp"), bdf = lines_of(folder / "ring_heat.bdf");
    const auto first = std::find(inp.begin(), inp.end(), "*FILM") + 1;
    CHECK(std::find(first, inp.end(), "*NODE FILE") - first == static_cast<std::ptrdiff_t>(cooled));
    // Faces with both: 100 W/(m^2 K) at (80 * 20 + 20 * 45)/100 degC.
    const auto has_both = [](const std::string& line) { return line.ends_with(", 25, 100"); };
    const auto has_one = [](const std::string& line) { return line.ends_with(", 20, 80"); };
    CHECK(std::count_if(first, inp.end(), has_both) == static_cast<std::ptrdiff_t>((cooled + 1) / 2));
    CHECK(std::count_if(first, inp.end(), has_one) == static_cast<std::ptrdiff_t>(cooled / 2));
    CHECK(count_of(bdf, "CHBDYG") == cooled);
    CHECK(count_of(bdf, "CONV") == cooled);
    CHECK(count_of(bdf, "SPOINT") == 2);
    CHECK(count_of(bdf, "SPC*") == fixed + 2);
    CHECK(count_of(lines_of(folder / "ring.bdf"), "TEMP*") == mesh.nodes.size());
    // Surface elements have the nodes of their faces, numbers of their own.
    std::size_t f = 0;
    std::vector<ElementFace> faces = mesh.surfaces.at("outside");
    std::sort(faces.begin(), faces.end(),
              [](ElementFace a, ElementFace b) { return std::pair(a.element, a.face) < std::pair(b.element, b.face); });
    for (std::size_t i = 0; i + 1 < bdf.size(); ++i) {
      if (!bdf[i].starts_with("CHBDYG")) continue;
      const std::vector<int> nodes = nodes_of(mesh, faces[f++]);
      CHECK(std::stol(bdf[i].substr(8, 8)) == static_cast<long>(mesh.elements.size() + f));
      CHECK(bdf[i].substr(24, 8) == "   AREA" + std::to_string(nodes.size()));
      for (std::size_t a = 0; a < nodes.size(); ++a)
        CHECK(std::stol(bdf[i + 1].substr(8 + 8 * a, 8)) == mesh.node_labels[static_cast<std::size_t>(nodes[a])]);
    }
    CHECK(f == cooled);
  }
}

TEST_CASE("NastranFaces_AreNamedByTheirCorners") {
  for (const ElementType type : {ElementType::hex20, ElementType::wedge15}) {
    const TemporaryDirectory folder;
    const Mesh mesh = ring_mesh(type, Ring{.cells = {1, 12, 2}});
    LoadedBody body = loaded(mesh, steel);
    body.faces = outer_faces(mesh);  // triangles of wedges, too
    for (LoadInstant& instant : body.instants)
      instant.pressures = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(body.faces.size()), 1e6);
    write_nastran_loads(folder / ".", body, FileUnits::si);
    const std::vector<std::string> lines = lines_of(folder / "ring.bdf");
    std::size_t f = 0;
    for (std::size_t i = 0; i + 1 < lines.size() && f < body.faces.size(); ++i) {
      if (!lines[i].starts_with("PLOAD4")) continue;
      const std::vector<int> nodes = nodes_of(mesh, body.faces[f++]);
      const auto label = [&](std::size_t k) { return mesh.node_labels[static_cast<std::size_t>(nodes[k])]; };
      CHECK(std::stol(lines[i + 1].substr(40, 16)) == label(0));
      const bool is_triangle = nodes.size() == 6;
      const std::string opposite = lines[i + 1].size() > 56 ? lines[i + 1].substr(56) : "";
      if (is_triangle)
        CHECK(opposite.find_first_not_of(' ') == std::string::npos);
      else
        CHECK(std::stol(opposite) == label(2));
    }
    CHECK(f == body.faces.size());
  }
}

TEST_CASE("MaterialsOfAllDirections_KeepTheirConstants") {
  const TemporaryDirectory folder;
  const Mesh mesh = ring_mesh(ElementType::hex8, Ring{.cells = {1, 12, 2}});
  const std::vector<SolidMaterial> wood{orthotropic({.E_1 = 12e9,
                                                     .E_2 = 0.8e9,
                                                     .E_3 = 0.5e9,
                                                     .nu_12 = 0.35,
                                                     .nu_23 = 0.4,
                                                     .nu_13 = 0.4,
                                                     .G_12 = 0.7e9,
                                                     .G_23 = 0.1e9,
                                                     .G_13 = 0.6e9,
                                                     .density = 500})};
  const LoadedBody body = loaded(mesh, wood);
  write_calculix_loads(folder / ".", body, FileUnits::si);
  write_nastran_loads(folder / ".", body, FileUnits::si);
  std::vector<double> constants;
  const std::vector<std::string> inp = lines_of(folder / "ring_mesh.inp"), bdf = lines_of(folder / "ring.bdf");
  for (auto line = std::find(inp.begin(), inp.end(), "*ELASTIC, TYPE=ANISO") + 1; !line->starts_with("*"); ++line) {
    std::istringstream text(*line);
    for (std::string value; std::getline(text, value, ',');) constants.push_back(std::stod(value));
  }
  REQUIRE(constants.size() == 21);
  const Matrix6& D = wood[0].D;
  // 1111, 1122, 2222, 1133, 2233, 3333, ..., 1212, ..., 1313, ..., 2323
  for (const auto& [at, row, column] :
       {std::tuple(0, 0, 0), {1, 0, 1}, {2, 1, 1}, {3, 0, 2}, {4, 1, 2}, {5, 2, 2}, {9, 3, 3}, {14, 5, 5}, {20, 4, 4}})
    CHECK(constants[static_cast<std::size_t>(at)] == doctest::Approx(D(row, column)).epsilon(digits));
  const auto card =
      std::find_if(bdf.begin(), bdf.end(), [](const std::string& line) { return line.starts_with("MAT9"); });
  REQUIRE(card != bdf.end());
  CHECK(std::stod(card->substr(24, 16)) == doctest::Approx(D(0, 0)).epsilon(digits));
  CHECK(std::stod((card + 1)->substr(56, 16)) == doctest::Approx(D(1, 1)).epsilon(digits));
}

TEST_CASE("Pyramids_AreRefusedWhereProgramsHaveNone") {
  const TemporaryDirectory folder;
  const Mesh mesh = ring_mesh(ElementType::pyramid5, Ring{.cells = {1, 12, 2}});
  CHECK_THROWS_WITH_AS(write_calculix_loads(folder / ".", loaded(mesh, steel), FileUnits::si),
                       doctest::Contains("pyramids"), std::runtime_error);
  CHECK_THROWS_WITH_AS(write_nastran_loads(folder / ".", loaded(mesh, steel), FileUnits::si),
                       doctest::Contains("pyramids"), std::runtime_error);
}

}  // namespace load_file_test
}  // namespace hersey::fem
