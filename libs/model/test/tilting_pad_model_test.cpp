#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "hersey/film/film_model.h"
#include "hersey/model/read.h"
#include "model_text.h"

// A bearing of tilting pads from the model file: the parts that it is spelt out in, and what may be wrong with it.
namespace hersey::model {
namespace tilting_pad_model_test {

std::string machine(const std::string& pads, const std::string& more = "") {
  return R"(hersey: 1
lubricants: {oil: {viscosity: 20 mPa.s}}
bodies:
  rotor: {mass: 100 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints: {turning: {type: planar, between: [ground, rotor], axis: z}}
drives: {motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}}
bearings:
  front:
    kind: tilting_pad
    shell: ground
    journal: rotor
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 75 um
    lubricant: oil
    pads: )" +
         pads + "\n" + more + "simulation: {analysis: steady}\n";
}

std::string faults_of(const std::string& text) {
  try {
    (void)read_text(text, "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

void check_fault(const std::string& text, const std::string& expected) {
  const std::string found = faults_of(text);
  CAPTURE(found);
  CHECK(found.find(expected) != std::string::npos);
}

TEST_CASE("PadsOfAWholeCircle_WeighARing") {
  constexpr double density = 7850, R = 0.05, t = 0.02, width = 0.05, nearly_whole = 89.99 / 90;
  const Model model = read_text(machine("{count: 4, arc: 89.99 deg, thickness: 20 mm, load: on_pad}"), "m.yaml");
  double mass = 0, about_axis = 0;
  Vector3 moment = Vector3::Zero();
  for (const Body& body : model.bodies) {
    if (body.name.find("pad") == std::string::npos) continue;
    mass += body.mass;
    moment += body.mass * body.centre_of_mass;
    about_axis += body.inertia(2, 2) + body.mass * body.centre_of_mass.squaredNorm();
  }
  const double outer = R + t, ring = density * width * std::numbers::pi * (outer * outer - R * R) * nearly_whole;
  CHECK(mass == doctest::Approx(ring).epsilon(1e-9));  // of what is written with 17 digits
  CHECK(about_axis == doctest::Approx(ring * (outer * outer + R * R) / 2).epsilon(1e-9));  // the same
  CHECK(moment.norm() < 1e-9 * ring * R);                                                  // the same
}

TEST_CASE("BearingOfPads_ReadsAsItsPartsWrittenByHand") {
  const std::string path = "tilting_pad_model_test.yaml";
  const std::string given = machine("{count: 5, arc: 60 deg, preload: 0.5, edge_pressure: 1 bar}",
                                    "    pivot: {type: spring, stiffness: 2e8 N/m, friction_torque: 2 N.m}\n");
  std::ofstream(path) << given;
  const Model by_hand = read_text(expanded_text(path, {}), path);
  std::filesystem::remove(path);
  const Model model = read_text(given, path);
  REQUIRE(model.composites.size() == 1);
  CHECK(by_hand.composites.empty());
  CHECK(model.composites[0].pads.size() == 5);
  REQUIRE(by_hand.bearings.size() == 5);
  REQUIRE(model.bearings.size() == 5);
  CHECK(by_hand.bodies.size() == model.bodies.size());
  CHECK(by_hand.joints.size() == model.joints.size());
  CHECK(by_hand.forces.size() == 10);
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(by_hand.bearings[k].name == model.bearings[k].name);
    CHECK(by_hand.bearings[k].film.grid.angles == model.bearings[k].film.grid.angles);
    CHECK(model.bearings[k].film.ends.at(0).first.pressure == 1e5);  // 1 bar
  }
}

TEST_CASE("WarmPads_ShareTheirJournalAndMixTheirOil") {
  std::string hot =
      machine("{count: 5, arc: 60 deg}",
              "    thermal: {model: film, supply_temperature: 40 degC, journal: {wall: free, heat_capacity: 70 "
              "J/K}}\n    operating_point: {journal_speed: 3000 rpm, load: 1 kN}\n");
  hot.replace(hot.find("viscosity: 20 mPa.s"), 19, "grade: iso_vg_32");
  const Model model = read_text(hot, "m.yaml");
  REQUIRE(model.composites.size() == 1);
  REQUIRE(model.composites[0].alone);
  for (const Model* of : {&model, model.composites[0].alone.get()}) {
    REQUIRE(of->thermal.network.nodes.size() == 1);
    CHECK(of->thermal.network.nodes[0].name == "front_journal");
    CHECK(of->thermal.network.nodes[0].heat_capacity == 70);
    REQUIRE(of->thermal.grooves.size() == 5);
    for (const Groove& groove : of->thermal.grooves) {
      CHECK(groove.after == (groove.before + 1) % 5);
      CHECK(groove.carry_over == 1);
    }
  }
}

TEST_CASE("FaultsOfABearingOfPads_NameWhatTheFileSays") {
  const std::string good = "{count: 5, arc: 60 deg}";
  check_fault(machine("{count: 5, arc: 80 deg}"), "m.yaml:16:");
  check_fault(machine("{count: 5, arc: 80 deg}"), "bearings.front.pads.arc: pads of 80 deg that overlap");
  check_fault(machine("{count: 5, arc: 60 deg, preload: 1}"), "bearings.front.pads.preload: a preload of 1 or more");
  check_fault(machine("{count: 5, arc: 60 deg, preload: 0.5, machined_clearance: 100 um}"), "one of them");
  check_fault(machine("{count: 3, arc: 60 deg, pivot_angles: [0 deg, 90 deg]}"), "2 angles of 3 pads");
  check_fault(machine("{count: 5, arc: 60 deg, offset: 1.2}"), "bearings.front.pads.offset");
  check_fault(machine("{count: 5, arc: 60 deg, inertia: 1e-6 kg.m^2}"), "its distance from the pivot");
  check_fault(machine(good, "    pivot: {type: ball_in_socket, ball_radius: 10 mm, socket_radius: 9 mm}\n"),
              "bearings.front.pivot.socket_radius: 9 mm, not larger than the ball");
  check_fault(machine(good, "    operating_point: {journal_speed: 1 rpm}\n"),
              "neither 'load' nor 'eccentricity_ratio'");
  check_fault(machine(good, "    operating_point: {journal_speed: 0 rpm, load: 1 kN}\n"), "a journal at rest");
  std::string wrong = machine(good);
  wrong.replace(wrong.find("journal: rotor"), 14, "journal: motor");
  check_fault(wrong, "m.yaml:11:14: bearings.front.journal: unknown body 'motor'");
  wrong = machine(good);
  wrong.replace(wrong.find("  rotor: {mass"), 7, "  front_pad_2: {mass: 1 kg}\n  rotor");
  check_fault(wrong, "a name that a part of bearing 'front' has");
  wrong = machine(good, "    shear_force: none\n");
  CHECK(faults_of(wrong) == "no fault");
  wrong.replace(wrong.find("{analysis: steady}"), 18, "{duration: 1 s, step: 1 ms}");
  check_fault(wrong, "bearings.front.shear_force: shear that acts on no body");
}

}  // namespace tilting_pad_model_test
}  // namespace hersey::model
