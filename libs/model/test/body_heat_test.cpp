#include <filesystem>
#include <fstream>

#include "hersey/film/thermal_model.h"
#include "hersey/model/wall_conduction.h"
#include "model_text.h"
#include "ring_file.h"

// Bodies that conduct heat, bearings whose shell is in one, and what is told about wrong ones.
namespace hersey::model {
namespace body_heat_test {

const std::string machine_text = R"(hersey: 1
title: A ring that conducts
bodies:
  ring:
    flexible:
      mesh: body_heat_test_ring.inp
      length_unit: 1 mm
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      heat:
        conductivity: 46 W/m/K
        expansion: 12e-6 1/K
        cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}
    frames:
      hub: {nodes: outside, connection: average, origin: 0 0 0 mm}
  shaft: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  clamp: {type: fixed, between: [ground, ring.hub]}
  slide: {type: planar, between: [ground, shaft]}
lubricants:
  oil: {grade: iso_vg_46}
bearings:
  main:
    shell: ring.hub
    journal: shaft
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    edge_pressure: 1 bar
    grid: {circumferential: 24, axial: 5}
    thermal: {model: film, supply_temperature: 50 degC, shell: {wall: body, temperature: 70 degC}}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

struct WrittenRing {
  WrittenRing() { std::ofstream("body_heat_test_ring.inp") << RingFile().text(); }
  ~WrittenRing() { std::filesystem::remove("body_heat_test_ring.inp"); }
  WrittenRing(const WrittenRing&) = delete;
  WrittenRing& operator=(const WrittenRing&) = delete;
};

std::string told(const std::string& from, const std::string& to) { return faults_of(edited(machine_text, from, to)); }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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
TEST_CASE("RestOfABody_IsItsSurfaceWithoutFilmsAndWhatIsNamed") {
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
  const Model held = read_text(
      edited(machine_text, "cooling: {outside:", "temperatures: {ends: 50 degC}\n        cooling: {rest:"), "m.yaml");
  const BodyHeat& heat = *held.bodies[0].flexible->heat;
  CHECK(heat.surroundings.cooled.at(*heat.rest).faces.size() == 2 * 24 * 3);  // bore and outside; the film's go later
}

TEST_CASE("FaultsOfHeatInBodies_SayWhereAndWhatToDo") {
  const WrittenRing file;
  const std::string cooling = "cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}";
  const std::string nowhere = told("        " + cooling + "\n", "");
  CHECK(contains(nowhere, "bodies.ring.flexible.heat: a body whose heat has nowhere to go"));
  CHECK(contains(nowhere, "add `cooling:"));
  CHECK(contains(told("{outside: {", "{outsid: {"), "unknown surface or set 'outsid'"));
  CHECK(contains(told("{outside: {", "{outsid: {"), "did you mean 'outside'"));
  CHECK(contains(told("{outside: {", "{bore: {"), "a film on faces of 'ring' that `cooling` names too"));
  const std::string silent =
      told("      heat:\n        conductivity: 46 W/m/K\n        expansion: 12e-6 1/K\n        " + cooling + "\n", "");
  CHECK(
      contains(silent, "bearings.main.thermal.shell: a wall in body 'ring', which does not say how it conducts heat"));
  CHECK(contains(silent, "add `heat: {conductivity"));
  CHECK(contains(told("shell: ring.hub", "shell: ground"), "a wall that conducts on rigid body 'ground'"));
  CHECK(contains(told("diameter: 45 mm", "diameter: 40 mm"), "no face of the mesh on the film's surface"));
  CHECK(contains(told("{wall: body,", "{wall: body, faces: bre,"), "unknown surface or set 'bre'"));
  CHECK(faults_of(edited(machine_text, "{wall: body,", "{wall: body, faces: bore,")) == "no fault");
  CHECK(contains(told("conductivity: 46 W/m/K", "conductivity: 0 W/m/K"), "conductivity"));
  CHECK(contains(told(cooling, cooling + "\n        fixed: [fot]"), "did you mean 'foot'"));
  CHECK(faults_of(edited(machine_text, cooling, "temperatures: {outside: 40 degC}")) == "no fault");
  const std::string shell = "shell: {wall: body,";
  CHECK(contains(told(shell, "expansion: {shell: 12e-6 1/K, journal: 12e-6 1/K}, " + shell),
                 "a shell that grows by its body's mesh and by a coefficient as well"));
  CHECK(told(shell, "expansion: {shell: 0 1/K, journal: 12e-6 1/K}, " + shell) == "no fault");
}

}  // namespace body_heat_test
}  // namespace hersey::model
