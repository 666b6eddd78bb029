// Joints, couplings, drives and forces between joints in the model file.
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/model/build.h"
#include "model_text.h"

namespace hersey::model {
namespace mechanism_test {

const std::string kGears = R"(hersey: 1
bodies:
  motor: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  cross: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  table: {mass: 2 kg, inertia: {xx: 1e-2 kg.m^2, yy: 1e-2 kg.m^2, zz: 1e-2 kg.m^2}}
  spindle: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, motor], initial: {rotation: 30 deg}}
  cardan: {type: universal, between: [motor, cross], initial: {rotation_1: 10 deg, rotation_2_rate: 2 rad/s}}
  rail: {type: prismatic, between: [ground, table], axis: x, initial: {translation: 5 mm}}
  thread: {type: screw, between: [ground, spindle], lead: 4 mm}
drives:
  start: {joint: main, coordinate: rotation, acceleration: 20 rad/s^2, ramp: 0.1 s}
couplings:
  belt: {type: gear, input: main.rotation, output: thread.rotation, ratio: -0.5}
  pinion: {type: rack, input: main.rotation, output: rail.translation, radius: 20 mm}
  wobble:
    type: relation
    input: main.rotation
    output: cardan.rotation_1
    function: {expression: 0.1*sin(input) + 0.1245, unit: rad}
forces:
  mount:
    type: bushing
    between: [ground, table]
    stiffness: 1 2 3 N/mm
    rotational_damping: 0 0 0.5 N.m.s/rad
    stiffness_matrix: [[0,0,0,0,0,0],[0,0,0,0,0,7],[0,0,0,0,0,0],[0,0,0,0,0,0],[0,0,0,0,0,0],[0,7,0,0,0,100]]
  rub: {type: joint_friction, joint: rail, coordinate: translation, coulomb: 3 N, transition_speed: 1 mm/s}
  stop:
    type: sliding_spring
    joint: rail
    stiffness: 1 N/mm
    force: {table: {points: [[-10, -5], [0, 0], [10, 50]], x_unit: mm, y_unit: N}}
  band: {type: spring_damper, between: [ground, table], tension: {expression: 100*length^2, unit: N}}
  hold: {type: speed_control, joint: cardan, coordinate: rotation_2, speed: 100 rpm, proportional: 2 N.m.s/rad, limit: 5 N.m}
simulation: {duration: 0.5 s, step: 1 ms}
)";

std::string after(const std::string& from, const std::string& to) { return faults_of(edited(kGears, from, to)); }

TEST_CASE("GearsAndTheirForces_AreRead") {
  const Model model = read_text(kGears, "m.yaml");
  CHECK(model.joints[1].type == JointType::universal);
  CHECK(model.joints[3].lead == doctest::Approx(0.004));
  CHECK(model.drives[0].prescribes == Drive::Prescribes::acceleration);
  CHECK(model.drives[0].ramp == doctest::Approx(0.1));
  REQUIRE(model.couplings.size() == 3);
  CHECK(model.couplings[1].terms[0].factor == doctest::Approx(0.02));
  CHECK(model.couplings[2].terms[0].function->value->value(std::vector<double>{0.5}) ==
        doctest::Approx(0.1 * std::sin(0.5) + 0.1245));
  const Bushing& bushing = *model.forces[0].as<Bushing>();
  CHECK(bushing.stiffness(4, 4) == doctest::Approx(2000));
  CHECK(bushing.stiffness(2, 2) == doctest::Approx(100));
  CHECK(bushing.stiffness(2, 4) == doctest::Approx(7));  // y and the rotation about z
  CHECK(bushing.damping(2, 2) == doctest::Approx(0.5));
  CHECK(model.forces[1].as<JointFriction>()->coulomb == doctest::Approx(3));
  CHECK(model.forces[2].as<CoordinateSpring>()->restoring->value->value(std::vector<double>{0.005}) ==
        doctest::Approx(25));
  CHECK(model.forces[3].as<SpringDamper>()->tension->value->value(std::vector<double>{0.1}) == doctest::Approx(1));
  CHECK(model.forces[4].as<SpeedControl>()->limit == doctest::Approx(5));
  const Machine machine = build(model);
  const mbd::MechanismSpec& spec = machine.mechanism->spec();
  CHECK(spec.couplings.size() == 3);
  CHECK(spec.coordinate_forces.size() == 3);
  // Gears mesh where the joints start: main at 30 deg, the thread at 0.
  const double at = 3.14159265358979323846 / 6;
  CHECK(std::abs(spec.couplings[0].terms[0].function->value({&at, 1})) < 1e-15);  // round-off
  CHECK(spec.couplings[1].terms[0].function->value({&at, 1}) == doctest::Approx(0.005));
}

TEST_CASE("FaultsOfCouplings_AreReported") {
  CHECK(after("input: main.rotation, output: thread.rotation", "input: mian.rotation, output: thread.rotation")
            .find("; did you mean 'main.rotation'? expected ") != std::string::npos);
  CHECK(after("input: main.rotation, output: rail", "input: rail.translation, output: rail")
            .find("a coordinate coupled to itself") != std::string::npos);
  CHECK(after("output: thread.rotation, ratio", "output: rail.translation, ratio")
            .find("m.yaml:15:29: couplings.belt."
                  "input: 'main.rotation', a rotation; expected a translation") != std::string::npos);
  CHECK(
      after("output: thread.rotation, ratio", "output: main.rotation, ratio")
          .find("a coupling of main.rotation, which drive 'start' holds already; expected an output that nothing else "
                "holds") != std::string::npos);
  CHECK(after("unit: rad}\nforces", "unit: mm}\nforces").find("couplings.wobble.function") != std::string::npos);
  CHECK(after("0.1*sin(input)", "0.1*sin(t)").find("unknown name 't'; expected input") != std::string::npos);
}

TEST_CASE("FaultsOfForcesInJoints_AreReported") {
  CHECK(
      after("coulomb: 3 N,", "coulomb: 3 N.m,")
          .find(
              "forces.rub.coulomb: a value in N.m; expected a value in N; coordinate 'translation' is a translation") !=
      std::string::npos);
  CHECK(after("[0,7,0,0,0,100]", "[0,8,0,0,0,100]").find("a matrix that is not symmetric") != std::string::npos);
  CHECK(after("[0,7,0,0,0,100]", "[0,7,0,0,0,-100]").find("not positive semidefinite") != std::string::npos);
  CHECK(after("stiffness: 1 2 3 N/mm", "stiffness: -1 2 3 N/mm").find("a negative stiffness") != std::string::npos);
  CHECK(after("type: sliding_spring\n    joint: rail", "type: sliding_spring\n    joint: rail\n    coordinate: x")
            .find("unknown coordinate 'x'") != std::string::npos);
  CHECK(after("speed: 100 rpm", "speed: {expression: main.rotation_rate, unit: rad/s}")
            .find("a wanted speed that depends on main.rotation") != std::string::npos);
  CHECK(after("lead: 4 mm", "lead: 0 mm").find("joints.thread.lead: a lead of 0; expected a travel per revolution") !=
        std::string::npos);
}

TEST_CASE("ImpossibleBodiesAndJoints_AreReported") {
  CHECK(after("table: {mass: 2 kg, inertia: {xx: 1e-2", "table: {mass: 2 kg, inertia: {xx: 3e-2")
            .find("principal moments of inertia 0.01, 0.01 and 0.03 kg.m^2; expected none negative, and none greater "
                  "than the sum of the others") != std::string::npos);
  CHECK(after("between: [ground, spindle]", "between: [spindle, spindle]")
            .find("both frames on body 'spindle'; expected frames of two bodies") != std::string::npos);
}

}  // namespace mechanism_test
}  // namespace hersey::model
