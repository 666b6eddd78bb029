#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "interpret/files/stl_file.h"
#include "model_text.h"
#include "temporary_directory.h"

// Shapes of bodies: from the model file and from STL files.
namespace hersey::model {
namespace body_shape_test {

std::string with_shapes(const std::string& shapes) {
  return edited(good_model, "  rod: {mass: 2 kg}\n", "  rod:\n    mass: 2 kg\n    shapes:\n" + shapes);
}

const mbd::Shape& shape(const Model& model, std::size_t index) { return model.bodies[1].shapes.at(index); }

TEST_CASE("Shapes_AreRead") {
  const Model model = read_text(with_shapes(R"(      ball: {shape: sphere, centre: 1 2 3 mm, diameter: 10 mm}
      bar: {shape: cylinder, to: 0 140 0 mm, diameter: 8 mm}
      round: {shape: capsule, from: 0 1 0 mm, to: 0 140 0 mm, diameter: 8 mm}
      block: {shape: box, size: 20 40 10 mm, rotation: {axis: 0 0 1, angle: 90 deg}}
      floor: {shape: half_space, normal: 0 0 2}
)"),
                                "m.yaml");
  REQUIRE(model.bodies[1].shapes.size() == 5);
  CHECK(shape(model, 0).name == "ball");
  const auto& ball = std::get<mbd::Sphere>(shape(model, 0).geometry);
  CHECK((ball.centre - Vector3(1e-3, 2e-3, 3e-3)).norm() < 1e-15);  // round-off of mm
  CHECK(ball.radius == doctest::Approx(5e-3));
  CHECK(std::get<mbd::Cylinder>(shape(model, 1).geometry).to.y() == doctest::Approx(0.14));
  CHECK(std::get<mbd::Capsule>(shape(model, 2).geometry).from.y() == doctest::Approx(1e-3));
  const auto& block = std::get<mbd::Box>(shape(model, 3).geometry);
  CHECK((block.X_BS.R.col(0) - Vector3::UnitY()).norm() < 1e-12);  // round-off of a rotation
  CHECK(std::get<mbd::HalfSpace>(shape(model, 4).geometry).normal == Vector3::UnitZ());
}

const std::string tetrahedron = R"(solid t
facet normal 0 0 -1
 outer loop
  vertex 0 0 0
  vertex 0 1 0
  vertex 1 0 0
 endloop
endfacet
facet normal 0 -1 0
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 0 0 1
 endloop
endfacet
facet normal -1 0 0
 outer loop
  vertex 0 0 0
  vertex 0 0 1
  vertex 0 1 0
 endloop
endfacet
facet normal 1 1 1
 outer loop
  vertex 1 0 0
  vertex 0 1 0
  vertex 0 0 1
 endloop
endfacet
endsolid t
)";

// The same triangles in the format's binary form.
std::string binary(const mbd::TriangleMesh& mesh) {
  std::string content(80, ' ');
  const auto append = [&](const auto& value) {
    content.append(reinterpret_cast<const char*>(&value), sizeof value);  // NOLINT: bytes of a file
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    append(std::array<float, 3>{});
    for (const int corner : triangle) {
      const Vector3& r = mesh.corners[static_cast<std::size_t>(corner)];
      append(std::array<float, 3>{static_cast<float>(r.x()), static_cast<float>(r.y()), static_cast<float>(r.z())});
    }
    append(std::uint16_t{0});
  }
  return content;
}

TEST_CASE("StlFiles_AreReadAsTextAndBinary") {
  const StlResult text = parse_stl(tetrahedron);
  CHECK(text.fault.empty());
  CHECK(text.mesh.corners.size() == 4);
  CHECK(text.mesh.triangles.size() == 4);
  const StlResult same = parse_stl(binary(text.mesh));
  CHECK(same.fault.empty());
  CHECK(same.mesh.corners == text.mesh.corners);
  CHECK(same.mesh.triangles == text.mesh.triangles);
}

TEST_CASE("StlFiles_CutShortOrOfSomethingElse_AreFaults") {
  const auto fault = [](const std::string& content) { return parse_stl(content).fault; };
  CHECK(fault("") == "an empty file");
  CHECK(fault("solid x\nendsolid x\n") == "no triangles");
  CHECK(fault("<html>") == "neither text nor binary STL");
  CHECK(fault("solid x\nouter loop\nvertex 0 0\n") == "line 3: 'vertex 0 0' is no corner of a triangle");
  // Cut behind a whole facet: no word of it is missing but the last.
  CHECK(fault(tetrahedron.substr(0, tetrahedron.find("facet normal 1 1 1"))) ==
        "line 22: the end of the file without endsolid: it is cut short");
  const std::string bytes = binary(parse_stl(tetrahedron).mesh);
  CHECK(fault(bytes.substr(0, 234)) ==
        "a binary file of 234 bytes, but its 4 facets take 284: it is cut short, or no STL");
  CHECK(fault(bytes + "x").starts_with("a binary file of 285 bytes"));
  std::string named = bytes.substr(0, 234);
  named.replace(0, 6, std::string("solid") + std::string(1, '\0'));
  CHECK(fault(named).starts_with("a binary file of 234 bytes"));
}

TEST_CASE("StlFiles_WithFacetsThatAreNoTriangles_AreFaults") {
  const auto loop = [](const std::string& inside) {
    return parse_stl("solid x\nfacet normal 0 0 1\nouter loop\n" + inside + "endloop\nendfacet\nendsolid\n").fault;
  };
  const std::string three = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  CHECK(loop(three).empty());
  CHECK(loop("VERTEX 0 0 0\nvertex +1 0 0\nvertex 0 1e0 0\n").empty());
  CHECK(loop(three + "vertex 1 1 0\n") == "line 7: 'vertex 1 1 0' is no corner of a triangle");
  CHECK(loop("vertex 0 0 0\nvertex 1 0 0\n") == "line 6: 'endloop' after a facet that is no triangle");
  CHECK(loop("vertex 0 0 0\nvertex 1 0 0\nvertex 0 nan 0\n") == "line 6: 'vertex 0 nan 0' is no corner of a triangle");
  CHECK(loop("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0 9\n").starts_with("line 6"));
  CHECK(loop("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1e200 0\n").starts_with("line 6"));
  CHECK(loop("vertx 0 0 0\n") == "line 4: 'vertx 0 0 0' where STL has no such word");
}

TEST_CASE("StlTrianglesWithoutArea_AreLeftOut_AndThatIsReported") {
  const TemporaryDirectory folder;
  std::string content = tetrahedron;
  content.insert(content.find("endsolid"),
                 "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 2 0 0\nendloop\nendfacet\n");
  std::ofstream(folder / "t.stl") << content;
  std::ofstream(folder / "m.yaml") << with_shapes("      t: {shape: mesh, file: t.stl, unit: 1 cm}\n");
  const Model model = read((folder / "m.yaml").string());
  CHECK(std::get<std::shared_ptr<const mbd::TriangleMesh>>(shape(model, 0).geometry)->triangles.size() == 4);
  // The bearing of the model around it starves, of which it warns, too.
  std::vector<Fault> of_shape;
  for (const Fault& warning : model.warnings)
    if (warning.path.starts_with("bodies.")) of_shape.push_back(warning);
  REQUIRE(of_shape.size() == 1);
  CHECK(of_shape[0].path == "bodies.rod.shapes.t.file");
  CHECK(of_shape[0].found.find("t.stl: 1 of 5 triangles without area") != std::string::npos);
}

TEST_CASE("Mesh_IsScaledAndShifted") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "t.stl") << tetrahedron;
  std::ofstream(folder / "m.yaml") << with_shapes(
      "      t: {shape: mesh, file: t.stl, unit: 1 cm, origin: 0 0 5 mm}\n");
  const Model model = read((folder / "m.yaml").string());
  const auto& mesh = *std::get<std::shared_ptr<const mbd::TriangleMesh>>(shape(model, 0).geometry);
  double highest = 0;
  for (const Vector3& corner : mesh.corners) highest = std::max(highest, corner.z());
  CHECK(highest == doctest::Approx(0.015));
}

TEST_CASE("MeshInAnUnlikelyUnit_IsWarnedOf") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "t.stl") << tetrahedron;  // edges of 1
  const auto warned = [&](const std::string& unit) {
    std::ofstream(folder / "m.yaml") << with_shapes("      t: {shape: mesh, file: t.stl, unit: " + unit + "}\n");
    std::string text;
    for (const Fault& warning : read((folder / "m.yaml").string()).warnings)
      if (warning.path == "bodies.rod.shapes.t.file") text += warning.text();
    return text;
  };
  CHECK(warned("1 km").find("is the mesh in millimetres? then give its length unit, mm") != std::string::npos);
  CHECK(warned("1 um").find("is the mesh in metres? then give its length unit, m") != std::string::npos);
  CHECK(warned("1 cm").empty());
}

TEST_CASE("MeshOfSolids_GivesItsOuterSurface") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "t.inp") << "*NODE\n1,0,0,0\n2,10,0,0\n3,0,10,0\n4,0,0,10\n5,0,0,-10\n"
                                     "*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n2,1,3,2,5\n";
  std::ofstream(folder / "m.yaml") << with_shapes("      t: {shape: mesh, file: t.inp, origin: 0 0 5 mm}\n");
  const Model model = read((folder / "m.yaml").string());
  const auto& mesh = *std::get<std::shared_ptr<const mbd::TriangleMesh>>(shape(model, 0).geometry);
  CHECK(mesh.corners.size() == 5);
  CHECK(mesh.triangles.size() == 6);                               // of eight faces two touch
  CHECK((mesh.corners[3] - Vector3(0, 0, 0.015)).norm() < 1e-17);  // round-off of mm
}

TEST_CASE("ShapesThatCannotBe_AreReported") {
  const auto faults = [](const std::string& shape) {
    return faults_after("  rod: {mass: 2 kg}\n", "  rod:\n    mass: 2 kg\n    shapes:\n      a: " + shape + "\n");
  };
  CHECK(faults("{shape: cylinder, from: 0 1 0 mm, to: 0 1 0 mm, diameter: 1 mm}") ==
        "m.yaml:15:7: bodies.rod.shapes.a: both ends at the same position; expected two ends apart");
  CHECK(faults("{shape: box, size: 1 0 1 mm}") ==
        "m.yaml:15:29: bodies.rod.shapes.a.size: an edge that is not > 0; expected three lengths > 0, such as 20 40 10 "
        "mm");
  CHECK(faults("{shape: half_space, normal: 0 0 0}").find("a direction of length 0") != std::string::npos);
  CHECK(faults("{shape: mesh, file: none.stl}")
            .starts_with("m.yaml:15:30: bodies.rod.shapes.a.file: no readable file none.stl"));
  CHECK(faults("{shape: mesh, file: none.msh}").find("none.msh: no readable file") != std::string::npos);
}

}  // namespace body_shape_test
}  // namespace hersey::model
