#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "build/known_reductions.h"
#include "hersey/fem/reduced_body_file.h"
#include "hersey/model/build.h"
#include "model_text.h"

// Flexible bodies in the model file: their values, and the faults reported for wrong ones.
namespace hersey::model {
namespace flexible_test {

// A cube of one hexahedron, 10 mm wide, with a set on either end.
const std::string kMesh = R"(*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 10, 10, 0
4, 0, 10, 0
5, 0, 0, 10
6, 10, 0, 10
7, 10, 10, 10
8, 0, 10, 10
*ELEMENT, TYPE=C3D8, ELSET=all
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=left
1, 4, 5, 8
*NSET, NSET=right
2, 3, 6, 7
*NSET, NSET=edge
1, 2
)";

const std::string kMachine = R"(hersey: 1
title: Flexible
bodies:
  bar:
    flexible:
      mesh: flexible_test_bar.inp
      length_unit: 1 mm
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      modes: 0
    frames:
      root: {nodes: left}
      tip: {nodes: right, connection: average}
joints:
  clamp: {type: revolute, between: [ground, bar.root]}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

/// The mesh lies in the folder of the model file: the working directory.
struct MeshFile {
  explicit MeshFile(const std::string& more = "") { std::ofstream("flexible_test_bar.inp") << kMesh << more; }
  ~MeshFile() { std::filesystem::remove("flexible_test_bar.inp"); }
  MeshFile(const MeshFile&) = delete;
  MeshFile& operator=(const MeshFile&) = delete;
};

std::string faults_with(const std::string& from, const std::string& to) {
  const MeshFile file;
  return faults_of(edited(kMachine, from, to));
}

TEST_CASE("FlexibleBody_IsReadAndBuilt") {
  const MeshFile file;
  const Model model = read_text(kMachine, "m.yaml");
  const Body& bar = model.bodies[0];
  REQUIRE(bar.flexible);
  CHECK(bar.flexible->modes == 0);
  REQUIRE(bar.frames.size() == 2);
  CHECK((bar.frames[1].X_BF.r - Vector3(0.01, 0.005, 0.005)).norm() < 1e-15);  // round-off
  CHECK(bar.frames[1].connection == fem::Connection::average);
  CHECK(bar.shapes.size() == 1);  // its skin
  const Machine machine = build(model);
  REQUIRE(machine.flexibles.size() == 1);
  // Round-off of sums over the mesh.
  CHECK(machine.flexibles[0].body->mass() == doctest::Approx(7850e-6).epsilon(1e-12));
  CHECK(machine.flexibles[0].body->data().shapes() == 6);
  CHECK(machine.mechanism->nv() == 7);  // the hinge, and the tip against the root
}

TEST_CASE("FlexibleBody_FaultsNameTheAlternatives") {
  const std::string material = "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n";
  CHECK(contains(faults_with("nodes: left", "nodes: lft"), "bodies.bar.frames.root.nodes: unknown node set 'lft'"));
  CHECK(contains(faults_with("nodes: left", "nodes: lft"), "left"));
  CHECK(contains(faults_with("{nodes: left}", "{origin: 0 0 0 mm}"), "a frame of a flexible body without `nodes`"));
  CHECK(contains(faults_with(material, ""), "a mesh without materials"));
  CHECK(contains(faults_with("bar.inp", "rod.inp"), "bodies.bar.flexible.mesh"));
  CHECK(contains(faults_with("      length_unit: 1 mm\n", ""), "length_unit"));
  CHECK(contains(faults_with("0.3, density", "0.5, density"), "poisson_ratio"));
  CHECK(contains(faults_with("    flexible:", "    mass: 1 kg\n    flexible:"), "bodies.bar"));
  CHECK(contains(faults_with("    frames:", "    centre_of_mass: 1 0 0 mm\n    frames:"),
                 "`centre_of_mass` of a flexible body"));
  CHECK(contains(faults_of(edited(good_model, "{origin: 0 50 0 mm,", "{nodes: left, origin: 0 50 0 mm,")),
                 "`nodes` of a frame on a rigid body"));
}

const std::string kMaterial = "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n";
const std::string kMaterials =
    "*MATERIAL, NAME=Alu\n*DENSITY\n2.7E-9\n*ELASTIC\n70000, 0.3\n"
    "*MATERIAL, NAME=Steel\n*DENSITY\n7.85E-9\n*ELASTIC\n210000, 0.3\n";

TEST_CASE("MaterialOfTheMeshFile_IsThatOfTheSection_OrAFaultWithBothNames") {
  const std::string machine = edited(kMachine, kMaterial, "");
  {
    const MeshFile file(kMaterials + "*SOLID SECTION, ELSET=all, MATERIAL=Steel\n");
    // Round-off of sums over the mesh.
    CHECK(build(read_text(machine, "m.yaml")).flexibles[0].body->mass() == doctest::Approx(7850e-6).epsilon(1e-12));
  }
  const MeshFile file(kMaterials + "*SOLID SECTION, ELSET=all, MATERIAL=STELL\n");
  const std::string faults = faults_of(machine);
  CHECK(contains(faults, "bodies.bar.flexible.mesh: "));
  CHECK(contains(faults,
                 "flexible_test_bar.inp:28: the section of 'all' names the material 'STELL', which the file does not "
                 "define; did you mean 'Steel'? expected a material of the file: Alu or Steel"));
  CHECK(faults_of(kMachine) == "no fault");  // a material of its own: the file's do not matter
}

TEST_CASE("UnusedContentOfAMeshFile_IsAWarningOfTheModel") {
  const MeshFile file("*NODE\n99, 5, 5, 5\n*COUPLING, REF NODE=99\n");
  const Model model = read_text(kMachine, "m.yaml");
  REQUIRE(model.warnings.size() == 2);
  CHECK(contains(model.warnings[0].text(), "bodies.bar.flexible.mesh: "));
  CHECK(contains(model.warnings[0].found, "flexible_test_bar.inp:20: 1 *COUPLING"));
  CHECK(contains(model.warnings[1].found, "flexible_test_bar.inp:19: 1 node is part of no element: 99"));
}

// A second cube on top of the first, on nodes of its own.
const std::string kSecondCube =
    "*NODE\n11, 0, 0, 10\n12, 10, 0, 10\n13, 10, 10, 10\n14, 0, 10, 10\n15, 0, 0, 20\n16, 10, 0, 20\n17, 10, 10, 20\n"
    "18, 0, 10, 20\n*ELEMENT, TYPE=C3D8, ELSET=upper\n2, 11, 12, 13, 14, 15, 16, 17, 18\n*NSET, NSET=left\n11, 14, 15, "
    "18\n";

TEST_CASE("PartsOfAMesh_AreTied_OrLeftApartOnPurpose") {
  const std::string surfaces = "*SURFACE, NAME=up\nall, S2\n*SURFACE, NAME=down\nupper, S1\n";
  const auto mass = [](const std::string& machine) {
    return build(read_text(machine, "m.yaml")).flexibles.at(0).body->mass();
  };
  const std::string apart = edited(kMachine, "modes: 0", "parts: apart\n      modes: 0");
  {
    const MeshFile file(kSecondCube);
    const std::string faults = faults_of(kMachine);
    CHECK(contains(faults, "2 parts that share no node: 1 element (one is 1), 1 element (one is 2)"));
    CHECK(contains(faults, "sets with nodes of several parts: left"));
    // The rigid frame on `left` joins them.
    CHECK(faults_of(apart) == "no fault");
    CHECK(mass(apart) == doctest::Approx(2 * 7850e-6).epsilon(1e-12));  // round-off of sums over the mesh
    CHECK(contains(read_text(apart, "m.yaml").warnings.at(0).text(), "2 parts that share no node"));
  }
  const MeshFile file(kSecondCube + surfaces + "*TIE, NAME=t\ndown, up\n");
  CHECK(faults_of(kMachine) == "no fault");
  CHECK(mass(kMachine) == doctest::Approx(2 * 7850e-6).epsilon(1e-12));  // as above
  CHECK(contains(faults_of(edited(kMachine, "modes: 0", "form: nodal\n      modes: 0")),
                 "`form: nodal` of a mesh with ties between its nodes"));
  CHECK(contains(faults_of(edited(kMachine, "modes: 0", "part: b\n      modes: 0")), "no part 'b'"));
}

TEST_CASE("AMeshInAnUnlikelyUnit_IsAWarningOfTheModel") {
  const MeshFile file("");
  const Model model = read_text(edited(kMachine, "length_unit: 1 mm", "length_unit: 1 km"), "m.yaml");
  REQUIRE_FALSE(model.warnings.empty());
  CHECK(contains(model.warnings.back().text(), "bodies.bar.flexible.mesh: "));
  CHECK(contains(model.warnings.back().text(), "is the mesh in millimetres? then give its length unit, mm"));
}

TEST_CASE("AMeshUnfitForComputing_IsAFaultOfTheModel") {
  const MeshFile file("*NODE\n11,20,0,0\n12,30,0,0\n13,20,10,0\n14,20,0,10\n*ELEMENT, TYPE=C3D4\n2,11,12,13,14\n");
  CHECK(contains(faults_of(kMachine), "2 parts that share no node"));
}

TEST_CASE("FlexibleBody_AnalysesItCannotHaveAreReported") {
  const std::string simulation = "{duration: 1 ms, step: 0.1 ms}";
  CHECK(contains(faults_with(simulation, "{analysis: kinematics, duration: 1 ms, step: 0.1 ms}"),
                 "a kinematic analysis with the flexible body 'bar'"));
  const MeshFile file;
  const std::string nodal = edited(kMachine, "      modes: 0", "      form: nodal");
  CHECK(contains(faults_of(edited(nodal, simulation, "{analysis: modes}")),
                 "bodies.bar.flexible.form: `form: nodal` of a body whose small motions are sought"));
  CHECK(faults_of(nodal) == "no fault");
  CHECK(
      contains(faults_of(edited(kMachine, "      modes: 0", "      strain: finite")), "finite strain of a modal body"));
  const std::string finite = edited(nodal, "form: nodal", "form: nodal\n      strain: finite");
  CHECK(contains(faults_of(finite), "`connection: average` of frame 'tip' of a body of finite strain"));
  CHECK(faults_of(edited(finite, ", connection: average", "")) == "no fault");
}

TEST_CASE("FacesThatTouch_DoNotBelongToABodyOfFiniteStrain") {
  const MeshFile file;
  const std::string ball =
      "  ball:\n    mass: 1 kg\n    inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}\n"
      "    shapes: {skin: {shape: sphere, diameter: 5 mm}}\n";
  const std::string contact =
      "contacts: {hit: {between: [ball.skin, bar.pad], stiffness: {pressure: 10 MPa, penetration: 10 um}}}\n";
  const std::string with_pad = edited(kMachine, "    frames:\n      root",
                                      "    shapes: {pad: {shape: faces, of: right}}\n    frames:\n      root");
  const std::string with_ball = edited(with_pad, "joints:\n", ball + contact + "joints:\n");
  const std::string nodal = edited(edited(with_ball, "modes: 0", "form: nodal"), ", connection: average", "");
  CHECK(faults_of(nodal) == "no fault");
  const std::string faults_after = faults_of(edited(nodal, "form: nodal", "form: nodal\n      strain: finite"));
  CHECK(contains(faults_after, "contacts.hit.between.1: faces that deform of a body of finite strain"));
}

TEST_CASE("FlexibleBody_LeftLooseOrSharedIsReported") {
  CHECK(contains(faults_with("nodes: right", "nodes: left"), "on which frame 'root' stands too"));
  const MeshFile file;
  const auto on_edge = [](const std::string& connection) {
    return read_text(
        edited(kMachine, "    frames:\n      root: {nodes: left}\n      tip: {nodes: right, connection: average}",
               "    frames:\n      root: {nodes: edge, connection: " + connection + "}"),
        "m.yaml");
  };
  CHECK(build(on_edge("average")).flexibles.size() == 1);  // rotates with the elements around
  const Model model = on_edge("rigid");
  try {
    (void)build(model);
    FAIL_CHECK("not refused");
  } catch (const InputError& error) {
    CAPTURE(std::string(error.what()));
    CHECK(contains(error.what(), "m.yaml:5:5: bodies.bar.flexible: "));
    CHECK(contains(error.what(), "root"));
  }
}

const std::string kPressure = "forces:\n  gas: {type: pressure, body: bar, faces: right, pressure: 2 MPa}\n";

TEST_CASE("SurfaceLoad_IsReadWithItsFaces") {
  const MeshFile file;
  const Model model =
      read_text(kMachine + kPressure +
                    "  push: {type: surface_force, body: bar, faces: left, direction: 0 3 4, magnitude: {expression: "
                    "\"5*t\", unit: N}}\n"
                    "  pin: {type: pressure, body: bar, faces: left, pressure: 1 bar, towards: -1 0 0}\n",
                "m.yaml");
  REQUIRE(model.forces.size() == 3);
  const auto load = [&](std::size_t i) { return std::get<SurfaceLoad>(model.forces[i].data); };
  const SurfaceLoad gas = load(0), push = load(1), pin = load(2);
  CHECK(gas.is_pressure);
  CHECK(gas.axes == Axes::body);
  CHECK(gas.faces.size() == 1);
  CHECK_FALSE(gas.direction);
  CHECK(push.axes == Axes::ground);
  // Round-off.
  CHECK((*push.direction - Vector3(0, 0.6, 0.8)).norm() < 1e-15);
  CHECK((*pin.direction + Vector3::UnitX()).norm() < 1e-15);
  const Machine machine = build(model);
  REQUIRE(machine.surface_loads.size() == 3);
  CHECK(machine.surface_loads[2].first == 2);
}

TEST_CASE("SurfaceLoad_FaultsNameTheAlternatives") {
  const MeshFile file;
  const auto faults_after = [&](const std::string& from, const std::string& to) {
    return faults_of(kMachine + edited(kPressure, from, to));
  };
  CHECK(contains(faults_after("faces: right", "faces: rihgt"), "forces.gas.faces: unknown surface or set 'rihgt'"));
  CHECK(contains(faults_after("faces: right", "faces: rihgt"), "did you mean 'right'"));
  CHECK(contains(faults_after("faces: right", "faces: edge"), "whose nodes make up no face"));
  CHECK(contains(faults_after("body: bar", "body: brr"), "forces.gas.body: unknown body 'brr'"));
  CHECK(contains(faults_after("pressure: 2 MPa", "pressure: 2 N"), "forces.gas.pressure"));
  CHECK(contains(faults_after("2 MPa", "{expression: \"clamp.rotation\", unit: MPa}"),
                 "a load on a mesh that follows 'clamp.rotation'"));
  CHECK(contains(faults_of(edited(good_model, "forces:\n",
                                  "forces:\n  gas2: {type: pressure, body: rod, faces: a, "
                                  "pressure: 1 bar}\n")),
                 "rigid body 'rod'"));
}

TEST_CASE("ReducedBody_ReplacesItsMesh") {
  const MeshFile file;
  const Model meshed = read_text(kMachine + kPressure, "m.yaml");
  const fem::SolidMaterial steel = fem::isotropic({.youngs_modulus = 2.1e11, .poisson_ratio = 0.3, .density = 7850});
  std::vector<fem::InterfaceFrame> frames;
  for (const Frame& frame : meshed.bodies[0].frames)
    frames.push_back({frame.name, frame.X_BF.r, frame.nodes, frame.connection,
                      fem::face_weights(*meshed.bodies[0].flexible->mesh, frame.nodes)});
  frames[0].weights.clear();
  const fem::Reduction reduction =
      fem::reduce(fem::assemble(*meshed.bodies[0].flexible->mesh, {steel}), frames, {.modes = 0});
  REQUIRE(reduction.solved());
  fem::write_reduced_body("flexible_test_bar.h5", reduction.body);
  const std::string text = edited(
      edited(edited(edited(kMachine, "      length_unit: 1 mm\n", ""),
                    "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n", ""),
             "      modes: 0\n    frames:\n      root: {nodes: left}\n      tip: {nodes: right, connection: average}\n",
             ""),
      "mesh: flexible_test_bar.inp", "reduced: flexible_test_bar.h5");
  const Model model = read_text(text + kPressure, "m.yaml");
  REQUIRE(model.bodies[0].frames.size() == 2);
  CHECK(model.bodies[0].frames[1].name == "tip");
  const Machine of_file = build(model), of_mesh = build(meshed);
  const mbd::ModalBodyData &a = of_file.flexibles[0].body->data(), &b = of_mesh.flexibles[0].body->data();
  // The file keeps doubles: round-off of the reduction.
  CHECK((a.stiffness - b.stiffness).norm() < 1e-12 * b.stiffness.norm());
  CHECK(a.mass == doctest::Approx(b.mass).epsilon(1e-14));  // round-off of sums over the mesh
  CHECK(of_file.surface_loads.size() == 1);
  const auto faults_after = [&](const std::string& from, const std::string& to) {
    return faults_of(edited(text, from, to));
  };
  CHECK(contains(faults_after("bar.root", "bar.rot"),
                 "unknown frame 'rot' of body 'bar'; did you mean 'root'? expected root or tip"));
  CHECK(contains(faults_after("bar.h5", "br.h5"), "bodies.bar.flexible.reduced"));
  CHECK(contains(faults_after("bar.h5\n", "bar.h5\n      modes: 3\n"), "`modes` of a reduced body"));
  CHECK(contains(faults_after("bar.h5\n", "bar.h5\n    frames: {tp: {}}\n"),
                 "frame 'tp', which the reduced body has not"));
  CHECK(contains(faults_after("bar.h5\n", "bar.h5\n    frames: {tip: {nodes: right}}\n"),
                 "`nodes` of a frame of a reduced body"));
  std::filesystem::remove("flexible_test_bar.h5");
}

TEST_CASE("LoadSurfaces_AddStaticShapesAndAreChecked") {
  const MeshFile file;
  const std::string text = edited(kMachine, "      modes: 0\n", "      modes: 0\n      load_surfaces: [right]\n");
  const std::string one = edited(text, "      tip: {nodes: right, connection: average}\n", "");
  const Machine machine = build(read_text(one, "m.yaml"));
  REQUIRE(machine.flexibles[0].static_errors.size() == 1);
  CHECK(machine.flexibles[0].static_errors[0].modes == doctest::Approx(1));
  CHECK(machine.flexibles[0].static_errors[0].reduced < 0.01);
  CHECK(machine.flexibles[0].body->data().shapes() > 0);
  CHECK(contains(faults_of(edited(text, "[right]", "[rihgt]")), "unknown surface or set 'rihgt'"));
  CHECK(contains(faults_of(edited(text, "[right]", "[edge]")), "whose nodes make up no face"));
}

TEST_CASE("OrthotropicMaterial_WithEqualConstantsIsTheIsotropicOne") {
  const MeshFile file;
  const std::string isotropic = "youngs_modulus: 210 GPa, poisson_ratio: 0.3";
  const std::string nine =
      "orthotropic: {youngs_moduli: 208 208 208 GPa, poisson_ratios: [0.3, 0.3, 0.3], shear_moduli: 80 80 80 GPa, "
      "axes: {axis: 1 2 3, angle: 40 deg}}";
  const auto stiffness = [&](const std::string& text) {
    return build(read_text(text, "m.yaml")).flexibles[0].body->data().stiffness;
  };
  const Eigen::MatrixXd K = stiffness(edited(kMachine, isotropic, nine));
  // Round-off of nine rotated constants.
  CHECK((K - stiffness(edited(kMachine, "210 GPa", "208 GPa"))).norm() < 1e-9 * K.norm());
  const auto faults_after = [&](const std::string& from, const std::string& to) {
    return faults_of(edited(kMachine, isotropic, edited(nine, from, to)));
  };
  CHECK(contains(faults_after("[0.3, ", "[1.2, "), "material.orthotropic: constants of no material"));
  CHECK(contains(faults_after("208 208 208", "208 -1 208"), "constants of no material"));
  CHECK(contains(faults_after("[0.3, 0.3, 0.3]", "[0.3, 0.3]"), "poisson_ratios"));
  CHECK(contains(faults_of(edited(kMachine, "youngs_modulus: 210 GPa, ", "")), "material"));
}

TEST_CASE("ABodyReducedBefore_IsReducedAnewWhereAnythingHasChanged") {
  const auto built = [](const std::string& text) { return build(read_text(text, "m.yaml")).flexibles[0]; };
  const std::string text = edited(kMachine, "modes: 0", "modes: 4");
  const MeshFile file;
  const BuiltFlexible first = built(text);
  const auto is_the_first = [&](const BuiltFlexible& other) {
    return other.shapes.rows() == first.shapes.rows() && other.shapes.cols() == first.shapes.cols() &&
           (other.shapes - first.shapes).norm() == 0 && other.frequencies == first.frequencies &&
           other.static_errors.size() == first.static_errors.size() &&
           (other.body->data().stiffness - first.body->data().stiffness).norm() == 0;
  };
  CHECK(is_the_first(built(text)));
  CHECK(is_the_first(built(edited(text, "duration: 1 ms", "duration: 2 ms"))));
  using Change = std::pair<std::string, std::string>;
  for (const Change& change :
       {Change{"modes: 4", "modes: 3"}, Change{"modes: 4", "modes: 4\n      highest_frequency: 150 kHz"},
        Change{"modes: 4", "modes: 4\n      form: nodal"}, Change{"modes: 4", "modes: 4\n      load_surfaces: [right]"},
        Change{"210 GPa", "211 GPa"}, Change{"0.3,", "0.29,"}, Change{"7850", "7851"},
        Change{"connection: average", "connection: rigid"},
        Change{"{nodes: right, ", "{nodes: right, origin: 10 5 4 mm, "}, Change{"unit: 1 mm", "unit: 1.01 mm"}}) {
    CAPTURE(change.second);
    CHECK(!is_the_first(built(edited(text, change.first, change.second))));
  }
  const std::string nodal = edited(text, "modes: 4", "modes: 4\n      form: nodal");
  CHECK(built(nodal).frequencies.size() == 5);  // the fourth and the fifth have one frequency
  CHECK(built(edited(nodal, "modes: 4", "modes: 3")).frequencies.size() == 3);
  std::ofstream("flexible_test_bar.inp") << edited(kMesh, "7, 10, 10, 10", "7, 10, 10, 11");
  CHECK(!is_the_first(built(text)));
}

TEST_CASE("KnownReductions_KeepTheLatestRequest") {
  const auto of_size = [](Eigen::Index n) {
    auto body = std::make_shared<fem::ReducedBody>();
    body->Phi.setZero(n, 1);
    return body;
  };
  KnownReductions known(3000);
  for (const char* name : {"a", "b", "c"}) known.keep(name, of_size(100));
  REQUIRE(known.find("a"));
  known.keep("d", of_size(100));
  CHECK(known.find("a"));
  CHECK(!known.find("b"));
  CHECK(known.find("c"));
  CHECK(known.find("d")->Phi.size() == 100);
  known.keep("too large", of_size(1000));
  CHECK(!known.find("too large"));
  CHECK(known.find("a"));
  known.keep("a", of_size(101));
  CHECK(known.find("a")->Phi.size() == 101);
  CHECK(known.find("c"));
}

}  // namespace flexible_test
}  // namespace hersey::model
