#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

// A drive turns a rotor with a pump and a rotating drilling on its shaft.
namespace hersey::run {
namespace shaft_torque_run_test {

/// @param turns  what turns pump and drilling: the joint, or a speed that takes no torque
std::string rig(const std::string& turns) {
  return R"(hersey: 1
gravity: 0 0 0 m/s^2
lubricants:
  oil: {viscosity: 12 mPa.s, density: 850 kg/m^3}
bodies:
  rotor: {mass: 20 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 0.1 kg.m^2}}
joints:
  turning: {type: revolute, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}
circuit:
  lubricant: oil
  nodes:
    sump: {pressure: 0 bar}
    gallery: {volume: 20 cm^3, free_air: 0.02}
    pin: {}
  elements:
    pump: {type: pump, from: sump, to: gallery, displacement: 2 cm^3, mechanical_efficiency: 0.8, )" +
         turns + R"(}
    crank: {type: drilling, from: gallery, to: pin, length: 60 mm, diameter: 3 mm, radii: [30 mm, 55 mm], )" +
         turns + R"(}
    jet: {type: orifice, from: pin, to: sump, diameter: 1.5 mm}
    relief: {type: relief_valve, from: gallery, to: sump, opening_pressure: 3 bar, conductance: 2 l/min/bar}
simulation: {duration: 4 ms, step: 0.2 ms}
)";
}

struct Turned {
  TemporaryDirectory scratch;
  Summary summary;
  results::Reader reader;
  explicit Turned(const std::string& turns, const std::vector<std::string>& overrides = {})
      : summary(simulate(model::read_text(rig(turns), "m.yaml", overrides), {.results = scratch / "run.h5"})),
        reader(summary.results) {
    REQUIRE_MESSAGE(summary.status == Status::completed, summary.message);
  }
  [[nodiscard]] double last(const std::string& series) const { return reader.read("/" + series).values.back(); }
};

constexpr double kOmega = 100 * std::numbers::pi;  // 3000 rpm
constexpr double kSame = 1e-8;                     // steps end at residuals of 1e-8

TEST_CASE("DriveTurnsThePump") {
  const Turned turned("joint: turning"), apart("speed: 3000 rpm");
  CHECK(turned.last("circuit/pressure_gallery") ==
        doctest::Approx(apart.last("circuit/pressure_gallery")).epsilon(kSame));
  CHECK(std::abs(apart.last("drives/motor/force_or_torque")) < 1e-9);  // N m: nothing else turns with friction
  const double pump = 2e-6 / (2 * std::numbers::pi) * turned.last("circuit/pressure_gallery") / 0.8;
  CHECK(turned.last("joint_forces/circuit_pump/force_or_torque") == doctest::Approx(-pump).epsilon(kSame));
  CHECK(turned.last("drives/motor/force_or_torque") ==
        doctest::Approx(pump - turned.last("joint_forces/circuit_crank/force_or_torque")).epsilon(kSame));
}

TEST_CASE("DriveTurnsTheOilOfARotatingBore") {
  const Turned turned("joint: turning");
  const double torque = 850 * turned.last("circuit/flow_crank") * kOmega * (0.055 * 0.055 - 0.03 * 0.03);
  CHECK(turned.last("joint_forces/circuit_crank/force_or_torque") == doctest::Approx(-torque).epsilon(kSame));
  CHECK(turned.last("joint_forces/circuit_crank/power") == doctest::Approx(-torque * kOmega).epsilon(kSame));
}

// A gear of the ratio -2: pump and bore turn twice as fast and the other way, and take twice the torque of the joint.
TEST_CASE("TorquesThroughAGear_HaveTheSamePower") {
  const Turned direct("joint: turning", {"drives.motor.speed=-6000 rpm", "circuit.elements.pump.ratio=-1",
                                         "circuit.elements.crank.ratio=-1"}),
      geared("joint: turning", {"circuit.elements.pump.ratio=2", "circuit.elements.crank.ratio=2"});
  for (const char* series :
       {"joint_forces/circuit_pump/power", "joint_forces/circuit_crank/power", "drives/motor/power"})
    CHECK(geared.last(series) == doctest::Approx(direct.last(series)).epsilon(kSame));
}

}  // namespace shaft_torque_run_test
}  // namespace hersey::run
