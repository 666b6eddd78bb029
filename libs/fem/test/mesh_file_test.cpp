#include "hersey/fem/mesh_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>

#include "hersey/fem/skin.h"
#include "source_dir.h"
#include "temporary_directory.h"

namespace hersey::fem {
namespace mesh_file_test {

std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(hersey::source_dir()) / "libs/fem/test/data" / name;
}

constexpr double kMillimetre = 1e-3;  // m

long label_of_node(const Mesh& mesh, const Element& element, int k) {
  return mesh.node_labels[static_cast<std::size_t>(mesh.nodes_of(element)[k])];
}

using Shape = std::pair<ElementType, std::vector<int>>;

/// The given elements by type and nodes, whatever their order in the file: Gmsh orders them by type or by volume.
std::vector<Shape> shapes(const Mesh& mesh, const std::vector<int>& elements) {
  std::vector<Shape> result;
  for (const int e : elements) {
    const Element& element = mesh.elements[static_cast<std::size_t>(e)];
    result.emplace_back(element.type,
                        std::vector<int>(mesh.nodes_of(element), mesh.nodes_of(element) + node_count(element.type)));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Shape> shapes(const Mesh& mesh) {
  std::vector<int> all(mesh.elements.size());
  std::iota(all.begin(), all.end(), 0);
  return shapes(mesh, all);
}

void check_same(const Mesh& a, const Mesh& b, double tolerance) {
  REQUIRE(a.nodes.size() == b.nodes.size());
  REQUIRE(a.node_labels == b.node_labels);
  for (std::size_t n = 0; n < a.nodes.size(); ++n) CHECK((a.nodes[n] - b.nodes[n]).norm() <= tolerance);
  CHECK(shapes(a) == shapes(b));
}

std::vector<FaceKey> keys(const Mesh& mesh, const std::vector<ElementFace>& faces) {
  std::vector<FaceKey> result;
  for (const ElementFace& face : faces) result.push_back(face_key(mesh, face));
  std::sort(result.begin(), result.end());
  return result;
}

void check_same_sets(const Mesh& a, const std::string& name_a, const Mesh& b, const std::string& name_b) {
  CAPTURE(name_a);
  CHECK(a.node_sets.at(name_a) == b.node_sets.at(name_b));
  REQUIRE(a.element_sets.contains(name_a) == b.element_sets.contains(name_b));
  if (a.element_sets.contains(name_a))
    CHECK(shapes(a, a.element_sets.at(name_a)) == shapes(b, b.element_sets.at(name_b)));
  REQUIRE(a.surfaces.contains(name_a) == b.surfaces.contains(name_b));
  if (a.surfaces.contains(name_a)) CHECK(keys(a, a.surfaces.at(name_a)) == keys(b, b.surfaces.at(name_b)));
}

/// Distance of a midside node from the middle of its edge's corners, over all edges of all elements.
double largest_midside_distance(const Mesh& mesh) {
  double largest = 0;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int f = 0; f < face_count(mesh.elements[static_cast<std::size_t>(e)].type); ++f) {
      const std::vector<int> nodes = nodes_of(mesh, {e, f});
      const std::size_t corners = nodes.size() / 2;
      const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(nodes[k])]; };
      for (std::size_t c = 0; c < corners; ++c)
        largest = std::max(largest, (at(corners + c) - (at(c) + at((c + 1) % corners)) / 2).norm());
    }
  return largest;
}

TEST_CASE("Gmsh22_PutsMidsideNodesOnTheirEdges_InEveryShape") {
  std::vector<Fault> warnings;
  const Mesh mesh = read_mesh(data("block_22.msh"), kMillimetre, &warnings);
  CHECK(warnings.empty());
  CHECK(mesh.nodes.size() == 72);
  CHECK(mesh.elements.size() == 12);
  // The block's edges are straight; Gmsh places midside nodes on them to 1e-11 of their length.
  CHECK(largest_midside_distance(mesh) < 1e-10 * 20 * kMillimetre);  // of the block's longest edge
}

TEST_CASE("Gmsh22_MakesSetsAndSurfacesOfPhysicalGroups") {
  const Mesh mesh = read_mesh(data("block_22.msh"), kMillimetre);
  CHECK(mesh.element_sets.at("bricks").size() == 2);
  CHECK(mesh.element_sets.at("wedges").size() == 4);
  CHECK(mesh.element_sets.at("tets").size() == 6);
  CHECK(mesh.surfaces.at("floor").size() == 3);
  CHECK(mesh.surfaces.at("roof").size() == 2);
  CHECK(mesh.node_sets.at("edge").size() == 3);
  CHECK(mesh.node_sets.at("corner") == std::vector<int>{0});
  for (const int n : mesh.node_sets.at("floor")) CHECK(mesh.nodes[static_cast<std::size_t>(n)].z() == 0);
  // Round-off of the unit.
  for (const ElementFace& face : mesh.surfaces.at("roof"))
    for (const int n : nodes_of(mesh, face))
      CHECK(mesh.nodes[static_cast<std::size_t>(n)].z() == doctest::Approx(0.012).epsilon(1e-15));
}

TEST_CASE("AllFormats_OfOneMesh_GiveTheSameMesh") {
  const Mesh mesh = read_mesh(data("block_22.msh"), kMillimetre);
  // 17 figures in .msh 2.2 and 4.1; 14 in .inp; 7 in free and small fields of .bdf, 10 in large ones.
  const double length = 20 * kMillimetre;
  check_same(mesh, read_mesh(data("block_41.msh"), kMillimetre), 4 * std::numeric_limits<double>::epsilon() * length);
  check_same(mesh, read_mesh(data("block.inp"), kMillimetre), 1e-13 * length);
  check_same(mesh, read_mesh(data("block_free.bdf"), kMillimetre), 1e-6 * length);
  check_same(mesh, read_mesh(data("block_small.bdf"), kMillimetre), 1e-6 * length);
  check_same(mesh, read_mesh(data("block_large.bdf"), kMillimetre), 1e-9 * length);
}

TEST_CASE("AllFormats_OfOneMesh_GiveTheSameSets") {
  const Mesh gmsh22 = read_mesh(data("block_22.msh"), kMillimetre);
  const Mesh gmsh41 = read_mesh(data("block_41.msh"), kMillimetre);
  const Mesh abaqus = read_mesh(data("block.inp"), kMillimetre);
  const Mesh nastran = read_mesh(data("block_small.bdf"), kMillimetre);
  for (const std::string name : {"bricks", "wedges", "tets", "floor", "roof", "edge"}) {
    check_same_sets(gmsh22, name, gmsh41, name);
    check_same_sets(gmsh22, name, abaqus, name);
  }
  check_same_sets(gmsh22, "tets", nastran, "pid_3");
  check_same_sets(gmsh22, "roof", nastran, "pid_73");
}

void check_two_cubes(const Mesh& mesh) {
  REQUIRE(mesh.nodes.size() == 12);
  REQUIRE(mesh.elements.size() == 2);
  CHECK((mesh.nodes[11] - Vector3(0, 0.01, 0.02)).norm() < 1e-17);  // round-off of the unit
  CHECK(label_of_node(mesh, mesh.elements[1], 7) == 12);
  REQUIRE(mesh.materials.size() == 1);
  // Round-off of the units.
  CHECK(mesh.materials[0].youngs_modulus.value() == doctest::Approx(2.1e11).epsilon(1e-14));
  CHECK(mesh.materials[0].poisson_ratio.value() == 0.3);
  CHECK(mesh.materials[0].density.value() == doctest::Approx(7850).epsilon(1e-14));
  CHECK(mesh.elements[0].material == 0);
  CHECK(mesh.elements[1].material == 0);
}

TEST_CASE("Abaqus_ReadsSetsSurfacesAndMaterials_ScaledToSI") {
  std::vector<Fault> warnings;
  const Mesh mesh = read_mesh(data("sets.inp"), kMillimetre, &warnings);
  check_two_cubes(mesh);
  CHECK(mesh.node_sets.at("floor") == std::vector<int>{0, 1, 2, 3});
  CHECK(mesh.node_sets.at("odd") == std::vector<int>{0, 2, 4, 6, 8, 10});
  CHECK(mesh.node_sets.at("Both ends") == std::vector<int>{0, 1, 2, 3, 8, 9, 10, 11});
  CHECK(mesh.node_sets.at("ref") == mesh.node_sets.at("floor"));
  CHECK(mesh.element_sets.at("all") == std::vector<int>{0, 1});
  CHECK(mesh.surfaces.at("top").size() == 1);
  CHECK(mesh.node_sets.at("top") == std::vector<int>{8, 9, 10, 11});
  CHECK(mesh.surfaces.at("outside").size() == 10);  // of 12 faces two touch
  REQUIRE(warnings.size() == 1);                    // the reference node 99
  CHECK(warnings[0].found == "1 node is part of no element: 99");
}

TEST_CASE("Nastran_ReadsSmallLargeFreeAndTabbedFields") {
  std::vector<Fault> warnings;
  const Mesh mesh = read_mesh(data("sets.bdf"), 1, &warnings);
  check_two_cubes(mesh);
  CHECK(mesh.node_sets.at("set_7") == std::vector<int>{0, 1, 2, 3, 8, 11});
  CHECK_FALSE(mesh.element_sets.contains("set_7"));
  CHECK(mesh.element_sets.at("set_8") == std::vector<int>{0, 1});
  CHECK(mesh.surfaces.at("pid_9").size() == 1);
  CHECK(mesh.node_sets.at("pid_9") == std::vector<int>{8, 9, 10, 11});
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].found == "1 CONM2");
}

TEST_CASE("Nastran_InTheSameUnits_GivesTheSameMeshAsAbaqus") {
  const Mesh nastran = read_mesh(data("sets.bdf"), 1);
  check_same(read_mesh(data("sets.inp"), kMillimetre), nastran, 1e-17);
}

TEST_CASE("Abaqus_BeamOfThreeNodes_IsTwoPiecesOfOneLabel") {
  const Mesh mesh =
      parse_mesh("*NODE\n1,0\n2,1\n3,2\n*ELEMENT,TYPE=B32,ELSET=shaft\n5,1,2,3\n", MeshFormat::abaqus, "x.inp", 1);
  REQUIRE(mesh.elements.size() == 2);
  CHECK(mesh.elements[1].label == 5);
  CHECK(mesh.connectivity == std::vector<int>{0, 1, 1, 2});
  CHECK(mesh.element_sets.at("shaft") == std::vector<int>{0, 1});
}

TEST_CASE("Gmsh_LinesWithoutSolids_AreBeams") {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 4 \"shaft\"\n$EndPhysicalNames\n"
      "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 2 0 0\n$EndNodes\n$Elements\n2\n1 1 2 4 1 1 2\n2 1 2 4 1 2 3\n$EndElements\n";
  const Mesh mesh = parse_mesh(text, MeshFormat::gmsh, "x.msh", 1);
  REQUIRE(mesh.elements.size() == 2);
  CHECK(mesh.elements[0].type == ElementType::beam2);
  CHECK(mesh.element_sets.at("shaft") == std::vector<int>{0, 1});
}

TEST_CASE("Gmsh22_ElementRepeatedForEachOfItsGroups_IsOneElement") {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"body\"\n3 2 \"half\"\n$EndPhysicalNames\n"
      "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
      "$Elements\n2\n1 4 2 1 1 1 2 3 4\n2 4 2 2 1 1 2 3 4\n$EndElements\n";
  const Mesh mesh = parse_mesh(text, MeshFormat::gmsh, "x.msh", 1);
  CHECK(mesh.elements.size() == 1);
  CHECK(mesh.element_sets.at("half") == mesh.element_sets.at("body"));
}

TEST_CASE("Abaqus_IncludesFilesBesideIt") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "nodes.txt") << "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,one\n";
  std::ofstream(folder / "body.inp") << "*INCLUDE, INPUT=nodes.txt\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";
  try {
    (void)read_mesh(folder / "body.inp", 1);
    FAIL("a word is no number");
  } catch (const InputError& error) {
    CHECK(error.faults().at(0).position.file == "nodes.txt");
    CHECK(error.faults().at(0).position.line == 5);
  }
  std::ofstream(folder / "nodes.txt") << "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
  CHECK(read_mesh(folder / "body.inp", 1).nodes.size() == 4);
}

TEST_CASE("AMillionLines_AreReadInAFewSeconds") {
  // 79^3 hexahedra: 512,000 nodes and 493,039 elements, a million lines. A second or so on an idle core; ten times
  // that is a reader of streams, and what this test is to catch.
  constexpr long n = 79, m = n + 1;
  std::array<std::string, m> coordinate;
  for (long k = 0; k < m; ++k)
    coordinate[static_cast<std::size_t>(k)] = ", " + std::to_string(0.001 * static_cast<double>(k));
  const auto at = [&](long k) -> const std::string& { return coordinate[static_cast<std::size_t>(k % m)]; };
  std::string text = "*NODE\n";
  for (long k = 0; k < m * m * m; ++k) text += std::to_string(k + 1) + at(k) + at(k / m) + at(k / m / m) + "\n";
  text += "*ELEMENT, TYPE=C3D8, ELSET=ALL\n";
  for (long k = 0; k < n * n * n; ++k) {
    const long first = k % n + m * (k / n % n) + m * m * (k / n / n) + 1;
    text += std::to_string(k + 1);
    for (const long step : {0L, 1L, 1 + m, m}) text += ", " + std::to_string(first + step);
    for (const long step : {0L, 1L, 1 + m, m}) text += ", " + std::to_string(first + m * m + step);
    text += "\n";
  }
  const auto start = std::chrono::steady_clock::now();
  const Mesh mesh = parse_mesh(text, MeshFormat::abaqus, "x.inp", 1);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  MESSAGE("a million lines in " << seconds.count() << " s");
  CHECK(mesh.elements.size() == n * n * n);
  CHECK(seconds.count() < 10);
}

/// What the reader says of a faulty text: "line: found; expected".
std::string fault_of(const std::string& text, MeshFormat format) {
  try {
    (void)parse_mesh(text, format, "x", 1);
  } catch (const InputError& error) {
    const Fault& fault = error.faults().at(0);
    return std::to_string(fault.position.line) + ": " + fault.found + "; " + fault.expected;
  }
  return "no fault";
}

TEST_CASE("FaultyFiles_AreReportedWithLineAndRemedy") {
  const auto abaqus = [](const std::string& text) { return fault_of(text, MeshFormat::abaqus); };
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n";
  CHECK(abaqus(nodes + "*ELEMENT,TYPE=C3D4\n7,1,2,3,5\n") ==
        "7: element 7 has node 5, which the file does not contain; elements of distinct nodes of the file");
  CHECK(abaqus(nodes + "*ELEMENT,TYPE=C3D4\n7,1,2,3,3\n") ==
        "7: element 7 has node 3 twice; elements of distinct nodes of the file");
  CHECK(abaqus(nodes + "*ELEMENT,TYPE=C3D4\n7,1,2,3\n") == "7: element 7 with 3 nodes; 4 nodes for C3D4");
  CHECK(abaqus(nodes + "*ELEMENT,TYPE=C3D4\n7,1,2,3,4\n7,1,2,4,3\n") ==
        "8: element 7 is already defined in line 7; each element once");
  CHECK(abaqus(nodes + "4,0,0,2\n*ELEMENT,TYPE=C3D4\n7,1,2,3,4\n") ==
        "6: node 4 is already defined in line 5, at another position; each node once");
  CHECK(abaqus(nodes) == "0: no elements of a solid or beam among 4 nodes; tetrahedra, wedges, hexahedra or beams");
  CHECK(abaqus("1,0,0,0\n") == "1: '1,0,0,0'; a keyword, such as *NODE");
  CHECK(abaqus("*NODE\n1,0,0,nan\n") == "2: 'nan'; a number");
  CHECK(abaqus(nodes + "*ELEMENT,TYPE=C3D4\n7,1,2,3,4\n*NSET,NSET=a\nb\n") ==
        "8: set 'a' has the set 'b', which the file does not define; numbers or names of sets");
  CHECK(abaqus(nodes + "*ELEMENT,TYPE=C3D4\n7,1,2,3,4\n*SURFACE,NAME=s\n7,S5\n") ==
        "9: surface 's' has face 5 of a tet4; a face from 1 to 4");
  CHECK(abaqus("*ELEMENT,TYPE=CAX4\n") ==
        "1: elements of type CAX4; C3D4, C3D10, C3D5, C3D6, C3D15, C3D8, C3D20 (also R, I, H), B31 or B32; shells only "
        "to "
        "mark faces");
  CHECK(abaqus("*INCLUDE,INPUT=a.txt\n").starts_with("1: *INCLUDE of 'a.txt': no readable file"));
  CHECK(abaqus("*PART,NAME=a\n*PART,NAME=b\n") == "2: a second *PART, 'b' behind 'a'; one body in one file");
  CHECK(abaqus("*MATERIAL,NAME=a\n*ELASTIC\n-5,0.3\n").starts_with("3: Young's modulus -5"));

  const auto gmsh = [](const std::string& text) { return fault_of(text, MeshFormat::gmsh); };
  const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  CHECK(gmsh("solid\n") == "1: no $MeshFormat at its beginning; a Gmsh mesh, format 2.2 or 4.1");
  CHECK(gmsh("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n") == "2: format 4.0; format 2.2 or 4.1");
  CHECK(gmsh("$MeshFormat\n4.1 1 8\n$EndMeshFormat\n") == "2: a binary file; an ASCII file");
  CHECK(gmsh(format + "$Nodes\n99999999999\n1 0 0 0\n").starts_with("5: a count of 99999999999"));
  CHECK(gmsh(format + "$Nodes\n2\n1 0 0 0\n") == "6: the end of the file; more numbers: the file is cut short");
  CHECK(gmsh(format + "$Nodes\n1\n1 0 x 0\n$EndNodes\n") == "6: 'x'; a number");
  CHECK(gmsh(format + "$Elements\n1\n1 12 0 1 2 3 4 5\n$EndElements\n").starts_with("6: elements of Gmsh's type 12"));

  const auto nastran = [](const std::string& text) { return fault_of(text, MeshFormat::nastran); };
  CHECK(nastran("GRID,1,2,0.,0.,0.\n") ==
        "1: the coordinate system 2, which the file does not define; a system of a CORD1R, CORD1C, CORD1S, CORD2R, "
        "CORD2C "
        "or CORD2S, or the basic system, 0 or empty");
  CHECK(nastran("$\nCTETRA,1,1,1,2,3\n") ==
        "2: CTETRA 1 with 3 nodes; 4 corners, then up to 6 mid-side nodes, of which any may be left out");
  CHECK(nastran("GRID,1,,zero\n") == "1: 'zero' in GRID; a number");
  CHECK(nastran("CTRIAX,1,1,1,2,3\n") == "1: CTRIAX, an axisymmetric element; solids");
}

TEST_CASE("Files_OfUnknownEnding_OrMissing_AreReported") {
  CHECK_THROWS_AS((void)read_mesh("body.step", 1), InputError);
  CHECK_THROWS_AS((void)read_mesh("no_such_file.msh", 1), InputError);
  CHECK_THROWS_AS((void)read_mesh("/", 1), InputError);
}

}  // namespace mesh_file_test
}  // namespace hersey::fem
