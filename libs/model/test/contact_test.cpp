#include <cmath>

#include "hersey/fem/elastic_material.h"
#include "hersey/mbd/hertz.h"
#include "hersey/mbd/restitution.h"
#include "hersey/model/build.h"
#include "model_text.h"

// Contacts in the model file: their values, and the faults reported for wrong ones.
namespace hersey::model {
namespace contact_test {

const std::string kMachine = R"(hersey: 1
title: Contacts
bodies:
  ball:
    mass: 1 kg
    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}
    shapes:
      surface: {shape: sphere, diameter: 40 mm}
      block: {shape: box, size: 10 20 30 mm}
      pin: {shape: cylinder, to: 0 0 20 mm, diameter: 8 mm}
  ground:
    shapes:
      floor: {shape: half_space, normal: 0 0 1}
      wall: {shape: box, size: 1 1 1 m}
joints:
  flight: {type: free, between: [ground, ball], initial: {position: 0 0 30 mm}}
contacts:
  bounce:
    between: [ground.floor, ball.surface]
    materials: [{youngs_modulus: 210 GPa, poisson_ratio: 0.3}, {youngs_modulus: 5 MPa, poisson_ratio: 0.49}]
    damping: {restitution: 0.8, speed: 2 m/s}
    friction: {coefficient: 0.4}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

std::string faults_with(const std::string& from, const std::string& to) {
  return faults_of(edited(kMachine, from, to));
}

const std::string kMaterials =
    "    materials: [{youngs_modulus: 210 GPa, poisson_ratio: 0.3}, {youngs_modulus: 5 MPa, poisson_ratio: 0.49}]\n";

// A shape whose size is wrong has no radius that Hertz's stiffness could be taken of: one fault, at its key.
TEST_CASE("ShapeWithoutARadius_IsAFaultOfTheModel") {
  for (const std::string size : {"nan mm", "inf mm", "0 mm", "-1 mm", "1e308 mm", "1e-308 mm"}) {
    CAPTURE(size);
    const std::string faults = faults_with("diameter: 40 mm", "diameter: " + size);
    CHECK(faults.find("bodies.ball.shapes.surface.diameter: ") != std::string::npos);
    CHECK(faults.find("materials") == std::string::npos);
  }
}

TEST_CASE("Contacts_AreReadAndBuilt") {
  const Model model = read_text(kMachine, "m.yaml");
  REQUIRE(model.contacts.size() == 1);
  const Contact& bounce = model.contacts[0];
  CHECK(bounce.name == "bounce");
  CHECK(bounce.is_hertz);
  const double modulus = fem::composite_modulus({210e9, 0.3, 0}, {5e6, 0.49, 0});
  CHECK(bounce.law.stiffness == doctest::Approx(mbd::hertz_stiffness(modulus, {0.02, 0.02})));
  CHECK(mbd::restitution(bounce.law.damping, 2) == doctest::Approx(0.8));
  CHECK(bounce.law.friction == doctest::Approx(0.4));
  CHECK(bounce.law.slip_speed == doctest::Approx(1e-3));
  Machine machine = build(model);
  REQUIRE(machine.contacts.size() == 1);
  CHECK(machine.mechanism->spec().forces[0].name == "contact bounce");
  const solver::State state = machine.mechanism->initial_state();
  const mbd::RelativeMotion motion = machine.mechanism->relative_motion(state, machine.contacts[0].force);
  CHECK(machine.contacts[0].contact->observe(motion).gap == doctest::Approx(0.01));
}

TEST_CASE("ContactStiffness_IsForceAtAPenetration") {
  const auto law = [](const std::string& stiffness) {
    return read_text(edited(kMachine, kMaterials, "    stiffness: " + stiffness + "\n"), "m.yaml").contacts[0].law;
  };
  CHECK(law("{force: 1 kN, penetration: 10 um}").stiffness == doctest::Approx(1e3 / std::pow(1e-5, 1.5)));
  CHECK(law("{force: 1 kN, penetration: 10 um, exponent: 2}").stiffness == doctest::Approx(1e13));
  CHECK(law("{force: 1 kN, penetration: 10 um, exponent: 2}").exponent == 2);
}

TEST_CASE("WrongContacts_AreExplained") {
  const std::string pair = "[ground.floor, ball.surface]";
  CHECK(faults_with(pair, "[ground.floor, ball.surfcae]") ==
        "m.yaml:19:29: contacts.bounce.between.1: unknown shape 'surfcae' of body 'ball'; did you mean 'surface'? "
        "expected surface, block or pin");
  CHECK(faults_with(pair, "[ground.floor, bal.surface]") ==
        "m.yaml:19:29: contacts.bounce.between.1: unknown body 'bal'; did you mean 'ball'? expected ground or ball");
  CHECK(faults_with(pair, "[ground.floor, ball]") ==
        "m.yaml:19:29: contacts.bounce.between.1: 'ball'; expected a shape, body.shape, such as ball.surface");
  CHECK(faults_with(pair, "[ball.block, ball.surface]") ==
        "m.yaml:19:27: contacts.bounce.between.1: both shapes on body 'ball'; expected shapes of two bodies");
  CHECK(faults_with(pair, "[ground.wall, ball.pin]") ==
        "m.yaml:19:28: contacts.bounce.between.1: contact of a box with a cylinder; expected a sphere and anything, a "
        "half_space and anything but another, two capsules, or a mesh and anything but another mesh; write one of "
        "the two as spheres, or as a mesh");
  CHECK(faults_of(edited(edited(kMachine, pair, "[ground.floor, ball.surface]"),
                         "surface: {shape: sphere, diameter: 40 mm}", "surface: {shape: half_space, normal: 0 0 1}"))
            .starts_with("m.yaml:19:29: contacts.bounce.between.1: contact of a half_space with a half_space"));
  CHECK(faults_with(pair, "[ground.floor, ball.block]") ==
        "m.yaml:20:5: contacts.bounce.materials: Hertz's stiffness for a half_space on a box; expected shapes that "
        "touch in a point of known radii: a sphere and anything, or a capsule on a half_space; give `stiffness`");
  CHECK(faults_with(kMaterials, "    stiffness: {pressure: 1 MPa, penetration: 1 um}\n") ==
        "m.yaml:20:5: contacts.bounce.stiffness: a pressure for a half_space on a sphere; expected `force`: only a "
        "mesh on anything but a sphere is pressed by its area");
  CHECK(faults_with(kMaterials, "").find("contacts.bounce") != std::string::npos);
  CHECK(faults_with("restitution: 0.8,", "restitution: 1.2,")
            .starts_with("m.yaml:21:28: contacts.bounce.damping.restitution: '1.2'"));
  CHECK(faults_with(", speed: 2 m/s}", "}").find("contacts.bounce.damping") != std::string::npos);
}

}  // namespace contact_test
}  // namespace hersey::model
