#include <filesystem>
#include <fstream>

#include "hersey/fem/reduced_body_file.h"
#include "hersey/fem/reduction.h"
#include "hersey/model/build.h"
#include "meshed_bearing.h"
#include "model_text.h"
#include "ring_file.h"

// Bearings whose surfaces deform with the mesh of a body: their values, and the faults reported for wrong ones.
namespace hersey::model {
namespace film_surface_test {

const std::string machine_text =
    MeshedBearing{.ring = {"film_surface_test_ring.inp", "modes: 2", kHub},
                  .load = "",
                  .film = "shell_surface: {within: 0.01 mm, functions: [16, 3], modes: 12}"}
        .text();

/// The mesh lies in the folder of the model file: the working directory.
struct WrittenRing {
  WrittenRing() { std::ofstream("film_surface_test_ring.inp") << RingFile().text(); }
  ~WrittenRing() { std::filesystem::remove("film_surface_test_ring.inp"); }
  WrittenRing(const WrittenRing&) = delete;
  WrittenRing& operator=(const WrittenRing&) = delete;
};

std::string faults_after(const std::string& from, const std::string& to) {
  return faults_of(edited(machine_text, from, to));
}

const std::string surface = "{within: 0.01 mm, functions: [16, 3], modes: 12}";

TEST_CASE("DeformingSurface_IsReadAndBuilt") {
  const WrittenRing file;
  CHECK(faults_of(machine_text) == "no fault");
  const Model model = read_text(machine_text, "m.yaml");
  const Bearing& bearing = model.bearings[0];
  REQUIRE(bearing.shell_surface);
  CHECK_FALSE(bearing.journal_surface);
  CHECK(bearing.shell_surface->surface->faces.size() == 24 * 3);
  CHECK(bearing.shell_surface->surface->functions.around() == 16);
  CHECK(bearing.shell_surface->surface->functions.along() == 3);
  CHECK(bearing.shell_surface->modes == 12);
  const Machine machine = build(model);
  REQUIRE(machine.bearings[0].shell);
  CHECK_FALSE(machine.bearings[0].journal);
  CHECK(machine.bearings[0].shell->body == "ring");
  CHECK(machine.bearings[0].shell->modes == 12);
  CHECK(machine.bearings[0].shell->lost > 0);
  CHECK(machine.bearings[0].shell->lost < 0.2);
  CHECK(machine.flexibles[0].body->data().shapes() == 2 + 12);
}

TEST_CASE("DeformingSurface_ByNameWithDefaults") {
  const WrittenRing file;
  const Model model = read_text(edited(machine_text, surface, "{faces: bore}"), "m.yaml");
  const DeformingSurface& on = *model.bearings[0].shell_surface;
  CHECK(on.surface->functions.around() == 16);  // 24 nodes
  CHECK(on.surface->functions.along() == 3);    // 4 nodes
  CHECK_FALSE(on.modes);
  CHECK(faults_of(edited(machine_text, surface, "rigid")) == "no fault");
}

TEST_CASE("DeformingSurface_FaultsGiveLocationAndRemedy") {
  const WrittenRing file;
  const std::string wide = faults_after("width: 15.6 mm", "width: 20 mm");
  CHECK(contains(wide, "m.yaml:27:29: bearings.main.shell_surface.within: a surface that covers only 7"));
  CHECK(contains(wide, "there is none all around"));
  CHECK(contains(wide, "make the bearing's width that of the surface"));
  const std::string small = faults_after("diameter: 45 mm", "diameter: 44 mm");
  CHECK(contains(small, "no face of the mesh on the film's surface"));
  CHECK(contains(small, "the nearest nodes have a radius of 22.5 mm"));
  CHECK(contains(small, "about the z-axis of ring.hub"));
  const std::string in_metres = edited(machine_text, surface, "{faces: bore}");
  CHECK(contains(faults_of(edited(in_metres, "length_unit: 1 mm", "length_unit: 1 m")),
                 "is the mesh in millimetres? then give its length unit, mm"));
  const std::string on_outside = edited(machine_text, surface, "{faces: outside}");
  CHECK(contains(faults_of(edited(on_outside, "diameter: 45 mm", "diameter: 60 mm")), "looks away from the axis"));
  CHECK(contains(faults_of(on_outside), "nodes at a radius of 30 mm, 7.5 mm off the film's 22.5 mm"));
  CHECK(contains(faults_after(surface, "{faces: bre}"), "unknown surface or set 'bre'"));
  CHECK(contains(faults_after(surface, "{faces: bore, within: 1 mm}"), "'faces' and 'within' together"));
  CHECK(contains(faults_after(surface, "{modes: 3}"), "faces"));
  CHECK(contains(faults_after("[16, 3]", "[3, 3]"), "fewer than 4 functions around"));
  CHECK(contains(faults_after(surface, "stiff"), "rigid"));
  CHECK(contains(faults_after("nodes: outside, connection: average", "nodes: bore, connection: rigid"),
                 "a surface whose nodes all belong to the rigid frame 'hub'"));
  CHECK(contains(faults_after("nodes: outside, connection: average", "nodes: bore, connection: rigid"),
                 "'connection: average'"));
}

TEST_CASE("DeformingSurface_OnABodyWithoutAMeshIsReported") {
  const WrittenRing file;
  const std::string rigid = faults_after("shell_surface: " + surface, "journal_surface: {within: 0.1 mm}");
  CHECK(contains(rigid, "m.yaml:27:5: bearings.main.journal_surface: a deforming surface on rigid body 'shaft'"));
  CHECK(contains(rigid, "leave 'journal_surface' out"));
  CHECK(contains(faults_after("shell: ring.hub", "shell: ground"), "a deforming surface on rigid body 'ground'"));
}

TEST_CASE("DeformingSurface_OfABodyOfFiniteStrainIsReported") {
  const WrittenRing file;
  const std::string finite = faults_after("      modes: 2\n", "      form: nodal\n      strain: finite\n");
  CHECK(contains(finite, "shell_surface: a deforming surface on 'ring', a body of finite strain"));
  CHECK(contains(finite, "`rigid`, or a body of `strain: small`"));
  CHECK_FALSE(contains(faults_after("      modes: 2\n", "      form: nodal\n"), "finite strain"));
}

TEST_CASE("DeformingSurface_OfAReducedBodyIsReported") {
  const WrittenRing file;
  const Model model = read_text(machine_text, "m.yaml");
  const Body& ring = model.bodies[0];
  const Frame& hub = ring.frames[0];
  const fem::Reduction reduction = fem::reduce(
      fem::assemble(*ring.flexible->mesh, ring.flexible->materials),
      {{hub.name, hub.X_BF.r, hub.nodes, hub.connection, fem::face_weights(*ring.flexible->mesh, hub.nodes)}},
      {.modes = 2});
  REQUIRE(reduction.solved());
  fem::write_reduced_body("film_surface_test_ring.h5", reduction.body);
  std::string text = edited(machine_text,
                            "      mesh: film_surface_test_ring.inp\n      length_unit: 1 mm\n"
                            "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n"
                            "      modes: 2\n    frames:\n"
                            "      hub: {nodes: outside, connection: average, origin: 0 0 0 mm}\n",
                            "      reduced: film_surface_test_ring.h5\n");
  const std::string faults = faults_of(text);
  CAPTURE(faults);
  CHECK(
      contains(faults, "a deforming surface on the reduced body 'ring', whose file holds no answers to film pressure"));
  CHECK(contains(faults, "'mesh' instead of 'reduced'"));
  CHECK(faults_of(edited(text, surface, "rigid")) == "no fault");
  std::filesystem::remove("film_surface_test_ring.h5");
}

TEST_CASE("FilmAndContactOnTheSameFaces_OfANodalBodyAreRefused") {
  const WrittenRing file;
  const auto touching = [](const std::string& form, const std::string& of) {
    std::string text = edited(machine_text, "      modes: 2\n", "      modes: 2\n      form: " + form + "\n");
    text = edited(text, "  shaft: {mass: 1 kg,",
                  "    shapes: {part: {shape: faces, of: " + of + "}}\n" +
                      "  shaft: {shapes: {ball: {shape: sphere, diameter: 20 mm}}, mass: 1 kg,");
    return faults_of(edited(text, "lubricants:",
                            "contacts:\n  bump: {between: [shaft.ball, ring.part], stiffness: {pressure: 1 GPa, "
                            "penetration: 10 um}}\nlubricants:"));
  };
  const std::string faults = touching("nodal", "bore");
  CAPTURE(faults);
  CHECK(contains(faults,
                 "bearings.main.shell_surface: faces of the nodal body 'ring' that carry contact 'bump' and "
                 "bearing 'main'"));
  CHECK(contains(faults, "choose faces apart for the two, or give the body `form: modal`"));
  CHECK(touching("modal", "bore") == "no fault");  // its shapes are made independent of each other
  CHECK(touching("nodal", "outside") == "no fault");
}

TEST_CASE("DeformingSurfaces_OfDifferentSizeDoNotFaceEachOther") {
  const WrittenRing file;
  const auto with_shaft = [](double outer) {
    std::ofstream("film_surface_test_shaft.inp") << RingFile{.inner = 10, .outer = outer}.text();
    const std::string text =
        edited(machine_text, "  shaft: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}\n",
               "  shaft:\n    flexible:\n      mesh: film_surface_test_shaft.inp\n      length_unit: 1 mm\n"
               "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n"
               "    frames:\n      pin: {nodes: bore, connection: average, origin: 0 0 0 mm}\n");
    return faults_of(edited(
        edited(edited(text, "[ground, shaft]", "[ground, shaft.pin]"), "journal: shaft\n", "journal: shaft.pin\n"),
        surface, "{faces: bore}\n    journal_surface: {within: 3 mm}"));
  };
  CHECK(with_shaft(22.466) == "no fault");
  const std::string faults = with_shaft(20);
  CAPTURE(faults);
  CHECK(contains(faults,
                 "bearings.main.journal_surface: surfaces that do not face each other: the shell's nodes have a "
                 "mean radius of 22.5 mm, the journal's one of 20 mm"));
  std::filesystem::remove("film_surface_test_shaft.inp");
}

}  // namespace film_surface_test
}  // namespace hersey::model
