#include <filesystem>
#include <fstream>

#include "hersey/film/thermal_model.h"
#include "hersey/model/plausibility.h"
#include "hersey/model/wall_conduction.h"
#include "meshed_bearing.h"
#include "model_text.h"
#include "ring_file.h"

// Bodies that conduct heat, bearings whose shell is in one, and the faults reported for wrong ones.
namespace hersey::model {
namespace body_heat_test {

const std::string machine_text =
    MeshedBearing{.title = "A ring that conducts",
                  .ring = {"body_heat_test_ring.inp",
                           "heat:\n"
                           "  conductivity: 46 W/m/K\n"
                           "  expansion: 12e-6 1/K\n"
                           "  cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}",
                           kHub},
                  .load = "",
                  .oil = "{grade: iso_vg_46}",
                  .film =
                      "grid: {circumferential: 24, axial: 5}\n"
                      "thermal: {model: film, supply_temperature: 50 degC, shell: {wall: body, temperature: 70 degC}}"}
        .text();

/// The ring, and a hollow shaft that fits into it.
struct WrittenRing {
  WrittenRing() {
    std::ofstream("body_heat_test_ring.inp") << RingFile().text();
    std::ofstream("body_heat_test_shaft.inp") << RingFile{.inner = 10, .outer = 22.5, .through = 3}.text();
  }
  ~WrittenRing() {
    std::filesystem::remove("body_heat_test_ring.inp");
    std::filesystem::remove("body_heat_test_shaft.inp");
  }
  WrittenRing(const WrittenRing&) = delete;
  WrittenRing& operator=(const WrittenRing&) = delete;
};

std::string faults_after(const std::string& from, const std::string& to) {
  return faults_of(edited(machine_text, from, to));
}

TEST_CASE("ShellInABody_IsReadAndItsConductionFound") {
  const WrittenRing file;
  CHECK(faults_of(machine_text) == "no fault");
  const Model model = read_text(machine_text, "m.yaml");
  const Bearing& bearing = model.bearings[0];
  REQUIRE(bearing.heated_shell);
  CHECK_FALSE(bearing.shell_surface);
  CHECK(bearing.heated_shell->faces.size() == 24 * 3);
  const BodyHeat& heat = *model.bodies[0].flexible->heat;
  CHECK(heat.material.conductivity == 46);
  CHECK(heat.T_reference == 293.15);
  CHECK(heat.surroundings.cooled.at(0).faces.size() == 24 * 3);
  const auto& wall = std::get<film::BodyWall>(std::get<film::ThermalModel>(bearing.heat).shell);
  CHECK(*wall.T_start == doctest::Approx(343.15));
  const auto conduction = wall_conduction(model, bearing);
  REQUIRE(conduction);
  CHECK(conduction->T0.size() == 24);
  CHECK(conduction->T0[5] == doctest::Approx(313.15).epsilon(1e-9));  // nothing warms it: round-off of a solution
  // Ten watts leave over the outside, which is thereby warmer than the air by 10 W/(alpha A).
  const double area = 2 * 3.14159265358979 * 0.03 * 0.0156;
  const Eigen::VectorXd even = Eigen::VectorXd::Constant(24, 10.0 / 24);
  CHECK(conduction->temperatures(even).mean() - 313.15 > 10 / (80 * area));
  CHECK(conduction->temperatures(even).mean() - 313.15 < 1.2 * 10 / (80 * area));
  CHECK(conduction->shape0.size() == 24 * 5);
  CHECK(conduction->shape0[0] == doctest::Approx(12e-6 * 0.0225 * 20).epsilon(0.02));  // 24 flat faces around
  CHECK(fingerprint_of_wall(model, bearing) == fingerprint_of_wall(read_text(machine_text, "m.yaml"), bearing));
  const Model other = read_text(edited(machine_text, "46 W/m/K", "45 W/m/K"), "m.yaml");
  CHECK(fingerprint_of_wall(model, bearing) != fingerprint_of_wall(other, other.bearings[0]));
}

// All of the surface but the film's: outside and both ends of the ring.
TEST_CASE("RestOfABody_IsItsSurfaceWithoutFilmsAndNamedFacets") {
  const WrittenRing file;
  const Model named = read_text(
      edited(machine_text, "cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}",
             "cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}, ends: {heat_transfer: 80 W/m^2/K, "
             "ambient: 40 degC}}"),
      "m.yaml");
  const Model rest = read_text(edited(machine_text, "cooling: {outside:", "cooling: {rest:"), "m.yaml");
  const auto conduction_of = [](const Model& model) { return wall_conduction(model, model.bearings[0]); };
  constexpr double round_off = 1e-10;  // of two factorisations
  CHECK((conduction_of(named)->rise - conduction_of(rest)->rise).cwiseAbs().maxCoeff() <
        round_off * conduction_of(named)->rise.maxCoeff());
  const Model prescribed = read_text(
      edited(machine_text, "cooling: {outside:", "temperatures: {ends: 50 degC}\n        cooling: {rest:"), "m.yaml");
  const BodyHeat& heat = *prescribed.bodies[0].flexible->heat;
  CHECK(heat.surroundings.cooled.at(*heat.rest).faces.size() == 2 * 24 * 3);  // bore and outside; the film's go later
}

TEST_CASE("FaultsOfHeatInBodies_GiveLocationAndRemedy") {
  const WrittenRing file;
  const std::string cooling = "cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}";
  const std::string nowhere = faults_after("        " + cooling + "\n", "");
  CHECK(contains(nowhere, "bodies.ring.flexible.heat: a body whose heat has no path to the surroundings"));
  CHECK(contains(nowhere, "add `cooling:"));
  CHECK(contains(faults_after("{outside: {", "{outsid: {"), "unknown surface or set 'outsid'"));
  CHECK(contains(faults_after("{outside: {", "{outsid: {"), "did you mean 'outside'"));
  CHECK(contains(faults_after("{outside: {", "{bore: {"), "a film on faces of 'ring' that `cooling` names too"));
  const std::string silent = faults_after(
      "      heat:\n        conductivity: 46 W/m/K\n        expansion: 12e-6 1/K\n        " + cooling + "\n", "");
  CHECK(
      contains(silent, "bearings.main.thermal.shell: a wall in body 'ring', which does not say how it conducts heat"));
  CHECK(contains(silent, "add `heat: {conductivity"));
  CHECK(contains(faults_after("shell: ring.hub", "shell: ground"), "a wall that conducts on rigid body 'ground'"));
  CHECK(contains(faults_after("diameter: 45 mm", "diameter: 40 mm"), "no face of the mesh on the film's surface"));
  CHECK(contains(faults_after("{wall: body,", "{wall: body, faces: bre,"), "unknown surface or set 'bre'"));
  CHECK(faults_of(edited(machine_text, "{wall: body,", "{wall: body, faces: bore,")) == "no fault");
  CHECK(contains(faults_after("conductivity: 46 W/m/K", "conductivity: 0 W/m/K"), "conductivity"));
  CHECK(contains(faults_after(cooling, cooling + "\n        fixed: [fot]"), "did you mean 'foot'"));
  CHECK(faults_of(edited(machine_text, cooling, "temperatures: {outside: 40 degC}")) == "no fault");
  const std::string shell = "shell: {wall: body,";
  CHECK(contains(faults_after(shell, "expansion: {shell: 12e-6 1/K, journal: 12e-6 1/K}, " + shell),
                 "a shell that grows by its body's mesh and by a coefficient as well"));
  CHECK(faults_after(shell, "expansion: {shell: 0 1/K, journal: 12e-6 1/K}, " + shell) == "no fault");
}

/// The same model has a shaft whose mesh conducts too, cooled in its bore.
std::string with_shaft() {
  std::string text =
      edited(machine_text, "shaft: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}",
             R"(shaft:
    flexible:
      mesh: body_heat_test_shaft.inp
      length_unit: 1 mm
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      heat:
        conductivity: 46 W/m/K
        expansion: 12e-6 1/K
        cooling: {bore: {heat_transfer: 300 W/m^2/K, ambient: 60 degC}}
    frames:
      axis: {nodes: bore, connection: average, origin: 0 0 0 mm})");
  text = edited(text, "between: [ground, shaft]", "between: [ground, shaft.axis]");
  text = edited(text, "journal: shaft", "journal: shaft.axis");
  return edited(text, "shell: {wall: body, temperature: 70 degC}", "journal: {wall: body, temperature: 70 degC}");
}

TEST_CASE("JournalInABody_IsReadAndItsConductionFound") {
  const WrittenRing file;
  const std::string text = with_shaft();
  CHECK(faults_of(text) == "no fault");
  const Model model = read_text(text, "m.yaml");
  const Bearing& bearing = model.bearings[0];
  REQUIRE(bearing.heated_journal);
  CHECK_FALSE(bearing.heated_shell);
  CHECK(bearing.heated_journal->faces.size() == 24 * 3);
  const auto& wall = std::get<film::BodyJournal>(std::get<film::ThermalModel>(bearing.heat).journal);
  CHECK(*wall.T_start == doctest::Approx(343.15));
  const auto conduction = journal_conduction(model, bearing);
  REQUIRE(conduction);
  CHECK(conduction->T0 == doctest::Approx(333.15).epsilon(1e-9));  // nothing warms it: round-off of a solution
  const double per_log = 1 / (2 * 3.14159265358979 * 46 * 0.0156), out = 300 * 2 * 3.14159265358979 * 0.01 * 0.0156;
  CHECK(conduction->rise == doctest::Approx(1 / out + per_log * std::log(2.25)).epsilon(0.02));  // 24 flat faces around
  CHECK(conduction->shape0.size() == 5);
  CHECK(conduction->shape0[0] == doctest::Approx(12e-6 * 0.0225 * 40).epsilon(0.02));    // likewise
  CHECK(conduction->shape_by_rise[4] == doctest::Approx(12e-6 * 0.0225).epsilon(0.02));  // likewise
  CHECK(conduction->T_body0.size() == 24 * 4 * 4);
  CHECK(wall_conduction(model, bearing) == nullptr);
  CHECK(fingerprint_of_journal(model, bearing) ==
        fingerprint_of_journal(read_text(text, "m.yaml"), read_text(text, "m.yaml").bearings[0]));
  const Model other = read_text(edited(text, "300 W/m^2/K", "200 W/m^2/K"), "m.yaml");
  CHECK(fingerprint_of_journal(model, bearing) != fingerprint_of_journal(other, other.bearings[0]));
  // Shell and journal, each in its body; what cools the rest of the shaft leaves its film alone.
  const Model both = read_text(edited(edited(text, "journal: {wall: body", "shell: {wall: body}, journal: {wall: body"),
                                      "cooling: {bore:", "cooling: {rest:"),
                               "m.yaml");
  REQUIRE(both.bearings[0].heated_shell);
  CHECK(journal_conduction(both, both.bearings[0])->rise < conduction->rise);                      // bore and both ends
  CHECK(wall_conduction(both, both.bearings[0])->T0[0] == doctest::Approx(313.15).epsilon(1e-9));  // as above
}

TEST_CASE("JournalInABodyThatDoesNotRotate_IsWarnedOf") {
  const WrittenRing file;
  const Model model = read_text(with_shaft(), "m.yaml"), other = read_text(machine_text, "m.yaml");
  const Bearing& bearing = model.bearings[0];
  CHECK(rotation_warnings(bearing, 3, 3).empty());
  CHECK(rotation_warnings(bearing, -3, 3).empty());
  CHECK(rotation_warnings(other.bearings[0], 0, 0).empty());
  CHECK(contains(rotation_warnings(bearing, 0, 0).at(0), "does not rotate in its shell"));
  CHECK(contains(rotation_warnings(bearing, -0.1, 2).at(0), "swings in its shell: 115 deg to and fro, 5.73 deg of it"));
}

// A mesh rotated about its own axis is the same journal.
TEST_CASE("JournalInABody_IsTheSameInAnyOrientation") {
  const WrittenRing file;
  const std::string text = with_shaft();
  const Model model = read_text(text, "m.yaml");
  const auto conduction = journal_conduction(model, model.bearings[0]);
  for (const double angle : {3.7, 40.0, 131.0}) {
    CAPTURE(angle);
    const Model turned =
        read_text(edited(text, "axis: {nodes: bore, connection: average, origin: 0 0 0 mm}",
                         "axis: {nodes: bore, connection: average, origin: 0 0 0 mm, rotation: {axis: z, angle: " +
                             std::to_string(angle) + " deg}}"),
                  "m.yaml");
    const auto after = journal_conduction(turned, turned.bearings[0]);
    CHECK(after->rise == doctest::Approx(conduction->rise).epsilon(1e-6));  // of its area's quadrature
    CHECK((after->shape_by_heat - conduction->shape_by_heat).cwiseAbs().maxCoeff() <
          1e-3 * conduction->shape_by_heat.maxCoeff());  // 24 flat faces interpolated by splines at other angles
  }
}

TEST_CASE("FaultsOfJournalsInBodies_GiveLocationAndRemedy") {
  const WrittenRing file;
  const std::string text = with_shaft();
  const auto shared_faults_after = [&text](const std::string& from, const std::string& to) {
    return faults_of(edited(text, from, to));
  };
  const std::string heat = R"(      heat:
        conductivity: 46 W/m/K
        expansion: 12e-6 1/K
        cooling: {bore: {heat_transfer: 300 W/m^2/K, ambient: 60 degC}}
)";
  const std::string silent = shared_faults_after(heat, "");
  CHECK(contains(silent,
                 "bearings.main.thermal.journal: a wall in body 'shaft', which does not say how it conducts heat"));
  CHECK(contains(silent, "add `heat: {conductivity"));
  CHECK(contains(shared_faults_after("cooling: {bore:", "cooling: {outside:"),
                 "a film on faces of 'shaft' that `cooling` names too"));
  const std::string rigid = faults_after("shell: {wall: body,", "journal: {wall: body,");
  CHECK(contains(rigid, "a wall that conducts on rigid body 'shaft'"));
  CHECK(contains(rigid, "or another wall to the journal"));
  CHECK(
      contains(shared_faults_after("diameter: 45 mm", "diameter: 40 mm"), "no face of the mesh on the film's surface"));
  CHECK(contains(shared_faults_after("{wall: body,", "{wall: body, faces: bore,"), "a radius of 10 mm"));
  CHECK(contains(shared_faults_after("{wall: body,", "{wall: body, faces: pin,"), "unknown surface or set 'pin'"));
  CHECK(faults_of(edited(text, "{wall: body,", "{wall: body, faces: outside,")) == "no fault");
  const std::string journal = "journal: {wall: body,";
  CHECK(contains(shared_faults_after(journal, "expansion: {shell: 12e-6 1/K, journal: 12e-6 1/K}, " + journal),
                 "a journal that grows by its body's mesh and by a coefficient as well"));
  CHECK(shared_faults_after(journal, "expansion: {shell: 12e-6 1/K, journal: 0 1/K}, " + journal) == "no fault");
}

}  // namespace body_heat_test
}  // namespace hersey::model
