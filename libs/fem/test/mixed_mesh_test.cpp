// Pyramids, mid-side nodes that are left out, and texts as other systems write them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "element/element_kind.h"
#include "hersey/fem/gmsh_file.h"
#include "hersey/fem/mesh_file.h"
#include "hersey/fem/mesh_quality.h"
#include "hersey/fem/ties.h"
#include "hersey/fem/vibration.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace mixed_mesh_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

double first_frequency(const Mesh& mesh) {
  const Vibration modes = natural_modes(assemble(mesh, {steel}), {}, {.count = 7});
  REQUIRE(modes.solved());
  CHECK(modes.rigid == 6);
  return modes.omega[6];
}

/// A box whose middle cell is cut into pyramids, the cells beside it into hexahedra.
Mesh box_with_pyramids(ElementType around, ElementType cut, const std::array<int, 3>& cells) {
  Mesh mesh = box_mesh(around, {1, 0.2, 0.2}, cells);
  const Mesh pieces = box_mesh(cut, {1, 0.2, 0.2}, cells);
  const std::size_t cell = mesh.elements.size() / 2;
  mesh.elements.erase(mesh.elements.begin() + static_cast<std::ptrdiff_t>(cell));
  for (std::size_t p = 6 * cell; p < 6 * cell + 6; ++p) {
    Element element = pieces.elements[p];
    element.label = 1000 + static_cast<long>(p);
    element.first = static_cast<int>(mesh.connectivity.size());
    for (int k = 0; k < node_count(cut); ++k) {
      const Vector3& r = pieces.nodes[pieces.nodes_of(pieces.elements[p])[k]];
      int node = 0;
      while (node < static_cast<int>(mesh.nodes.size()) && (mesh.nodes[node] - r).norm() > 1e-9) ++node;
      if (node == static_cast<int>(mesh.nodes.size())) {
        mesh.nodes.push_back(r);
        mesh.node_labels.push_back(node + 1);
      }
      mesh.connectivity.push_back(node);
    }
    mesh.elements.push_back(element);
  }
  mesh.node_sets.clear();
  mesh.surfaces.clear();
  return mesh;
}

TEST_CASE("PyramidsAmongHexahedra_HaveTheVolumeAndTheFrequenciesOfTetrahedra") {
  const Mesh mixed = box_with_pyramids(ElementType::hex20, ElementType::pyramid13, {5, 1, 1});
  const MeshQuality quality = quality_of(mixed);
  CHECK(quality.folded.empty());
  CHECK(quality.mismatched.empty());
  CHECK(quality.parts.size() == 1);
  CHECK(std::abs(quality.volume - 0.04) < 100 * eps);
  const double reference = first_frequency(box_mesh(ElementType::tet10, {1, 0.2, 0.2}, {8, 3, 3}));
  // Both are within half a per cent of the limit of fine meshes, from above.
  CHECK(std::abs(first_frequency(mixed) / reference - 1) < 0.01);
  CHECK(std::abs(first_frequency(box_mesh(ElementType::pyramid13, {1, 0.2, 0.2}, {5, 1, 1})) / reference - 1) < 0.01);
}

TEST_CASE("MixedMesh_PassesThePatchTest") {
  for (const auto& [around, cut] :
       {std::pair(ElementType::hex8, ElementType::pyramid5), std::pair(ElementType::hex20, ElementType::pyramid13)}) {
    Mesh mesh = box_with_pyramids(around, cut, {3, 1, 1});
    for (Vector3& x : mesh.nodes)
      x += 0.02 * Vector3(std::sin(5 * x.y() + x.z()), std::sin(4 * x.z() + 2 * x.x()), std::cos(7 * x.x() - x.y()));
    straighten(mesh);
    const ElasticBody body = assemble(mesh, {steel});
    const Matrix3 gradient = (Matrix3() << 1, 2, 3, -4, 5, 6, 7, -8, 9).finished();
    Eigen::VectorXd u(body.size());
    for (Eigen::Index n = 0; n < body.node_count(); ++n) u.segment<3>(3 * n) = gradient * mesh.nodes[n];
    const Eigen::VectorXd f = body.K * u;
    // The node in the middle of the pyramids is inside of the body: a linear field loads it not at all.
    const Eigen::Index middle = static_cast<Eigen::Index>(mesh.nodes_of(mesh.elements.back())[4]);
    CHECK(f.segment<3>(3 * middle).norm() < 1e-11 * f.cwiseAbs().maxCoeff());  // round-off, hundreds of points
  }
}

TEST_CASE("Pyramids_AreReadInEveryFormat_AsGmshWritesThem") {
  const std::string nodes = "1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,.5,.5,1\n";
  const Mesh abaqus = parse_mesh("*NODE\n" + nodes + "*ELEMENT,TYPE=C3D5\n1,1,2,3,4,5\n", MeshFormat::abaqus, "x", 1);
  const std::string grids =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,.5,.5,1.\n";
  const Mesh nastran = parse_mesh(grids + "CPYRAM,1,1,1,2,3,4,5\nENDDATA\n", MeshFormat::nastran, "x", 1);
  for (const Mesh& mesh : {abaqus, nastran}) {
    REQUIRE(mesh.elements.size() == 1);
    CHECK(mesh.elements[0].type == ElementType::pyramid5);
    CHECK(quality_of(mesh).volume == doctest::Approx(1.0 / 3).epsilon(100 * eps));
  }
  // A pyramid of second order whose mid-side nodes are left out but for one.
  const Mesh curved = parse_mesh(grids + "GRID,9,,.5,-.1,0.\nCPYRAM,1,1,1,2,3,4,5,9,,\n,,,,,,,\nENDDATA\n",
                                 MeshFormat::nastran, "x", 1);
  REQUIRE(curved.elements[0].type == ElementType::pyramid13);
  CHECK(curved.nodes.size() == 13);
  CHECK(curved.nodes[curved.nodes_of(curved.elements[0])[5]] == Vector3(0.5, -0.1, 0));
  CHECK(curved.nodes[curved.nodes_of(curved.elements[0])[12]] == Vector3(0.25, 0.75, 0.5));
}

TEST_CASE("Natural_PyramidIntegrals_AreThoseOfTheClosedForm") {
  // int u^c r^a s^b over the pyramid: 2/(a + 1) 2/(b + 1)/(c + 3) for even a and b, zeta = 1 - u.
  for (const ElementType type : {ElementType::pyramid5, ElementType::pyramid13})
    for (int a = 0; a <= 4; a += 2)
      for (int c = 0; c <= 4; ++c) {
        double sum = 0;
        for (const auto& [xi, w] : mass_points(type)) {
          const double u = 1 - xi.z();
          sum += w * std::pow(xi.x() / u, a) * std::pow(u, c);
        }
        const bool is_within =
            type == ElementType::pyramid13 || c <= 3;  // three points: degree 5, two of which are u^2
        if (is_within) CHECK(sum == doctest::Approx(2.0 / (a + 1) * 2 / (c + 3)).epsilon(100 * eps));
      }
}

/// A mesh of hexahedra as Nastran writes it; `is_left_out` says which mid-side nodes an element leaves out.
std::string nastran_text(const Mesh& mesh, const std::function<bool(std::size_t, int)>& is_left_out) {
  std::string text;
  std::vector<char> used(mesh.nodes.size(), 0);
  std::string elements;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Element& element = mesh.elements[e];
    const std::vector<std::size_t>& order = kind_of(element.type).files.nastran_order;
    std::vector<std::string> fields(static_cast<std::size_t>(node_count(element.type)));
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const int node = mesh.nodes_of(element)[k];
      if (is_left_out(e, static_cast<int>(k))) continue;
      used[static_cast<std::size_t>(node)] = 1;
      fields[order.empty() ? k : order[k]] = fmt::format("{}", mesh.node_labels[static_cast<std::size_t>(node)]);
    }
    elements += fmt::format("CHEXA,{},1", element.label);
    for (std::size_t k = 0; k < fields.size(); ++k)
      elements += fmt::format("{},{}", k == 6 || k == 14 ? "\n" : "", fields[k]);
    elements += "\n";
  }
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (used[n] != 0)
      text += fmt::format("GRID,{},,{:.15f},{:.15f},{:.15f}\n", mesh.node_labels[n], mesh.nodes[n].x(),
                          mesh.nodes[n].y(), mesh.nodes[n].z());
  return text + elements + "ENDDATA\n";
}

TEST_CASE("MidsideNodesThatAreLeftOut_AreThoseOfStraightEdges") {
  const Mesh box = distorted_box(ElementType::hex20);  // its mid-side nodes lie on straight edges
  const auto read = [&](const std::function<bool(std::size_t, int)>& is_left_out, std::vector<Fault>* warnings) {
    return parse_mesh(nastran_text(box, is_left_out), MeshFormat::nastran, "x", 1, warnings);
  };
  std::vector<Fault> none, all, some;
  const Mesh written = read([](std::size_t, int) { return false; }, &none);
  const auto is_of_order_two = [](std::size_t e, int k) { return e == 0 || k < 19; };
  const Mesh left_out = read([&](std::size_t e, int k) { return k >= 8 && is_of_order_two(e, k) && k != 12; }, &all);
  // The first element has none of its own but the one its neighbours write.
  const Mesh shared = read([](std::size_t e, int k) { return e == 0 && k >= 8 && k != 12; }, &some);
  CHECK(none.empty());
  REQUIRE(all.size() == 1);
  CHECK(all[0].found.ends_with("mid-side nodes left out"));
  const double expected = first_frequency(written);
  for (const Mesh& mesh : {left_out, shared}) {
    CHECK(mesh.nodes.size() == written.nodes.size());
    CHECK(mesh.ties.empty());
    CHECK(quality_of(mesh).mismatched.empty());
    CHECK(std::abs(first_frequency(mesh) / expected - 1) < 1e-9);  // Lanczos iteration stops at 1e-7, squared
  }
}

TEST_CASE("MidsideNodesLeftOut_BesideElementsOfFirstOrder_StayOnTheStraightEdge") {
  // Two cells; the upper one of first order, the lower one leaves out the nodes between them.
  const Mesh box = box_mesh(ElementType::hex20, {1, 1, 2}, {1, 1, 2});
  Mesh mixed = box;
  mixed.elements[1].type = ElementType::hex8;
  const std::string text = nastran_text(mixed, [](std::size_t e, int k) { return e == 0 && k >= 12 && k < 16; });
  const Mesh mesh = parse_mesh(text, MeshFormat::nastran, "x", 1);
  REQUIRE(mesh.nodes.size() == 24);
  CHECK(mesh.ties.size() == 12);
  CHECK(quality_of(mesh).mismatched.empty());
  CHECK(warnings_of(quality_of(mesh), "x").empty());
  // A field that is bilinear on the common face is continuous there, and only such ones obey the ties.
  const Eigen::SparseMatrix<double> C = tie_constraints(mesh, {}).C;
  Eigen::VectorXd bilinear(3 * 24), quadratic(3 * 24);
  for (Eigen::Index n = 0; n < 24; ++n) {
    const Vector3& x = mesh.nodes[static_cast<std::size_t>(n)];
    bilinear.segment<3>(3 * n) = (1 + x.x()) * (2 - x.y()) * Vector3(1, 2, 3);
    quadratic.segment<3>(3 * n) = x.x() * x.x() * Vector3(1, 2, 3);
  }
  CHECK((C * bilinear).norm() < 100 * eps * bilinear.norm());
  CHECK((C * quadratic).norm() > 0.1);
  (void)first_frequency(mesh);  // six rigid motions and no more
}

TEST_CASE("ByteOrderMark_AndLineEndsOfWindows_ChangeNothing") {
  const Mesh box = box_mesh(ElementType::hex8, {1, 1, 1}, {2, 1, 1});
  std::string abaqus = "*HEADING\n*NODE\n";
  for (std::size_t n = 0; n < box.nodes.size(); ++n)
    abaqus += fmt::format("{},{},{},{}\n", n + 1, box.nodes[n].x(), box.nodes[n].y(), box.nodes[n].z());
  abaqus += "*ELEMENT,TYPE=C3D8,ELSET=all\n";
  for (const Element& e : box.elements) {
    abaqus += fmt::format("{}", e.label);
    for (int k = 0; k < 8; ++k) abaqus += fmt::format(",{}", box.nodes_of(e)[k] + 1);
    abaqus += "\n";
  }
  const std::string gmsh =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"all\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 "
      "1 0 "
      "0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";
  const std::string nastran = nastran_text(box, [](std::size_t, int) { return false; });
  for (const auto& [text, format] : {std::pair(abaqus, MeshFormat::abaqus), std::pair(gmsh, MeshFormat::gmsh),
                                     std::pair(nastran, MeshFormat::nastran)}) {
    std::string windows = "\xEF\xBB\xBF";
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::vector<Fault> before, after;
    const Mesh expected = parse_mesh(text, format, "x", 1, &before), mesh = parse_mesh(windows, format, "x", 1, &after);
    CHECK(mesh.nodes == expected.nodes);
    CHECK(mesh.connectivity == expected.connectivity);
    CHECK(mesh.node_sets == expected.node_sets);
    CHECK(before.size() == after.size());
  }
}

TEST_CASE("NodesInOtherAxes_ByKeywords_LieWhereTheyShould") {
  const std::string rest = "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";
  const Mesh expected = parse_mesh("*NODE\n1,3,1,0\n2,3,2,0\n3,2,1,0\n4,3,1,1\n" + rest, MeshFormat::abaqus, "x", 1);
  // The x-axis of *SYSTEM points along y.
  const std::string system = "*SYSTEM\n3,1,0,3,5,0\n1,1,0\n";
  for (const std::string nodes :
       {"*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n", "*NODE,SYSTEM=C\n1,0,0,0\n2,1,0,0\n3,1,90,0\n4,0,0,1\n",
        "*NODE,SYSTEM=S\n1,0,0,0\n2,1,0,0\n3,1,90,0\n4,1,0,90\n"}) {
    const Mesh mesh = parse_mesh(system + nodes + rest, MeshFormat::abaqus, "x", 1);
    for (std::size_t n = 0; n < 4; ++n) CHECK((mesh.nodes[n] - expected.nodes[n]).norm() < 10 * eps);
  }
}

TEST_CASE("BeamsSideBySide_AreMeant_SolidsOnTheSameCornersAreNot") {
  const std::string points =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,1,2,0.,1.,0.\nENDDATA\n";
  CHECK(quality_of(parse_mesh(points, MeshFormat::nastran, "x", 1)).repeated.empty());
}

}  // namespace mixed_mesh_test
}  // namespace hersey::fem
