#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "hersey/film/film_model.h"
#include "hersey/model/read.h"
#include "model_text.h"

// A thrust bearing of pads on pivots from the model file: the parts that it is spelt out in, and what may be wrong with
// it.
namespace hersey::model {
namespace thrust_pad_model_test {

std::string thrust_machine(const std::string& pads, const std::string& more = "") {
  return R"(hersey: 1
lubricants: {oil: {viscosity: 20 mPa.s}}
bodies:
  rotor: {mass: 100 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints: {turning: {type: cylindrical, between: [ground, rotor], axis: z}}
drives: {motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}}
bearings:
  front:
    kind: tilting_pad_thrust
    stator: ground
    runner: rotor
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    lubricant: oil
    pads: )" +
         pads + "\n" + more + "simulation: {analysis: steady}\n";
}

std::string thrust_faults_of(const std::string& text) {
  try {
    (void)read_text(text, "m.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

void check_thrust_fault(const std::string& text, const std::string& expected) {
  const std::string found = thrust_faults_of(text);
  CAPTURE(found);
  CHECK(found.find(expected) != std::string::npos);
}

TEST_CASE("ThrustPadsOfAWholeRing_WeighThatRing") {
  constexpr double density = 7850, inner = 0.05, outer = 0.1, t = 0.02, nearly_whole = 89.99 / 90;
  const Model model = read_text(thrust_machine("{count: 4, arc: 89.99 deg, thickness: 20 mm}"), "m.yaml");
  double mass = 0, about_axis = 0, about_x = 0;
  Vector3 moment = Vector3::Zero();
  for (const Body& body : model.bodies) {
    if (body.name.find("pad") == std::string::npos) continue;
    const Vector3& r = body.centre_of_mass;
    mass += body.mass;
    moment += body.mass * r;
    about_axis += body.inertia(2, 2) + body.mass * (r.x() * r.x() + r.y() * r.y());
    about_x += body.inertia(0, 0) + body.mass * (r.y() * r.y() + r.z() * r.z());
  }
  const double squares = outer * outer + inner * inner;
  const double ring = density * t * std::numbers::pi * (outer * outer - inner * inner) * nearly_whole;
  CHECK(mass == doctest::Approx(ring).epsilon(1e-9));                      // of what is written with 17 digits
  CHECK(about_axis == doctest::Approx(ring * squares / 2).epsilon(1e-9));  // the same
  CHECK(about_x == doctest::Approx(ring * (squares / 4 + t * t / 3)).epsilon(1e-9));  // the same
  CHECK((moment - Vector3(0, 0, -ring * t / 2)).norm() < 1e-9 * ring * outer);        // the same
}

TEST_CASE("ThrustBearingOfPads_ReadsAsItsPartsWrittenByHand") {
  const std::string path = "thrust_pad_model_test.yaml";
  const std::string given = thrust_machine("{count: 5, arc: 60 deg, offset: 0.55, pivot_radius: 77 mm, angle: 10 deg}",
                                           "    pivot: {type: spring, stiffness: 2e8 N/m}\n    edge_pressure: 1 bar\n"
                                           "    sense: negative\n    shape: [{profile: crown, drop: 4 um}]\n");
  std::ofstream(path) << given;
  const Model by_hand = read_text(expanded_text(path, {}), path);
  std::filesystem::remove(path);
  const Model model = read_text(given, path);
  REQUIRE(model.composites.size() == 1);
  CHECK(model.composites[0].kind == "tilting_pad_thrust");
  CHECK(by_hand.composites.empty());
  REQUIRE(by_hand.bearings.size() == 5);
  REQUIRE(model.bearings.size() == 5);
  CHECK(by_hand.bodies.size() == model.bodies.size());
  CHECK(by_hand.joints.size() == model.joints.size());
  CHECK(by_hand.forces.size() == 5);
  constexpr double degree = std::numbers::pi / 180;
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(by_hand.bearings[k].name == model.bearings[k].name);
    CHECK(by_hand.bearings[k].film.grid.angles == model.bearings[k].film.grid.angles);
    CHECK(model.bearings[k].film.ends.at(0).first.pressure == 1e5);  // 1 bar
    // The leading edge of pads for a negative rotation has the larger angle: 10 + 30 deg of the first.
    const double pivot = (40 - 0.55 * 60 + 72 * static_cast<double>(k)) * degree;
    CHECK(model.composites[0].pivot_angles[k] == doctest::Approx(pivot).epsilon(1e-12));  // round-off
  }
}

TEST_CASE("FaultsOfAThrustBearingOfPads_NameWhatTheFileSays") {
  const std::string good = "{count: 6, arc: 50 deg}";
  CHECK(thrust_faults_of(thrust_machine(good)) == "no fault");
  check_thrust_fault(thrust_machine("{count: 6, arc: 70 deg}"),
                     "m.yaml:15:27: bearings.front.pads.arc: 6 pads of 70 deg that overlap, 420 deg in all; expected "
                     "less than 60 deg");
  check_thrust_fault(thrust_machine("{count: 6, arc: 50 deg, pivot_radius: 120 mm}"),
                     "bearings.front.pads.pivot_radius: a pivot at 120 mm from the axis, outside its pad; expected "
                     "between 50 and 100 mm");
  check_thrust_fault(thrust_machine("{count: 6, arc: 50 deg, offset: 1.2}"), "bearings.front.pads.offset");
  // All at once.
  const std::string several = thrust_machine("{count: 6, arc: 70 deg, pivot_radius: 20 mm}",
                                             "    pivot: {type: ball_in_socket, ball_radius: 10 mm, socket_radius: 9 "
                                             "mm, form: line}\n");
  check_thrust_fault(several, "that overlap");
  check_thrust_fault(several, "outside its pad");
  check_thrust_fault(several, "bearings.front.pivot.socket_radius: 9 mm, not larger than the ball");
  check_thrust_fault(several, "bearings.front.pivot.form: a line below a ball");
  check_thrust_fault(thrust_machine(good, "    operating_point: {speed: 1 rpm}\n"),
                     "neither 'load' nor 'film_thickness'");
  check_thrust_fault(thrust_machine(good, "    operating_point: {speed: 0 rpm, load: 1 kN}\n"), "a collar at rest");
  check_thrust_fault(thrust_machine(good, "    operating_point: {speed: 1 rpm, load: 1 kN, film_thickness: 1 um}\n"),
                     "bearings.front.operating_point.film_thickness: keys 'load' and 'film_thickness' together");
  check_thrust_fault(thrust_machine(good, "    shape: [{profile: ramp, rise: 10 um, arc: 60 deg}]\n"),
                     "bearings.front.shape.0.arc: 60 deg, longer than a pad");
  std::string wrong = thrust_machine(good);
  wrong.replace(wrong.find("runner: rotor"), 13, "runner: motor");
  check_thrust_fault(wrong, "m.yaml:11:13: bearings.front.runner: unknown body 'motor'");
  wrong = thrust_machine(good);
  wrong.replace(wrong.find("    runner: rotor\n"), 18, "");
  check_thrust_fault(wrong, "a stator without 'runner'");
  wrong = thrust_machine(good);
  wrong.replace(wrong.find("inner_diameter: 100"), 19, "inner_diameter: 300");
  check_thrust_fault(wrong, "bearings.front.outer_diameter: 200 mm; expected more than the inner diameter, 300 mm");
}

}  // namespace thrust_pad_model_test
}  // namespace hersey::model
