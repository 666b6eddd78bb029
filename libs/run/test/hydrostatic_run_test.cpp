#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A spindle that floats on recesses behind restrictors, in time and as a steady motion.
namespace hersey::run {
namespace hydrostatic_run_test {

std::string recess(const std::string& name, int angle, const std::string& restrictor) {
  return "      " + name + ": {shape: pocket, angle: " + std::to_string(angle) +
         " deg, arc: 60 deg, length: 40 mm, pressure: 40 bar, restrictor: " + restrictor + "}\n";
}

std::string spindle(const std::string& restrictor) {
  return R"(hersey: 1
parameters:
  speed: 600 rpm
gravity: 0 -9.81 0 m/s^2
lubricants:
  oil: {viscosity: 30 mPa.s}
bodies:
  spindle: {mass: 200 kg, inertia: {xx: 10 kg.m^2, yy: 10 kg.m^2, zz: 1 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, spindle], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: "${speed}"}
bearings:
  main:
    shell: ground
    journal: spindle
    diameter: 100 mm
    width: 80 mm
    radial_clearance: 60 um
    lubricant: oil
    grid: {circumferential: 24, axial: 9}
    features:
)" + recess("below", -90, restrictor) +
         recess("right", 0, restrictor) + recess("above", 90, restrictor) + recess("left", 180, restrictor) +
         "simulation: {duration: 100 ms, step: 1 ms}\n";
}

const std::string kCapillary = "{type: capillary, length: 40 mm, diameter: 0.6 mm}";

struct Ran {
  TemporaryDirectory scratch;
  Summary summary;
  results::Reader reader;
  Ran(const std::string& restrictor, const std::vector<std::string>& overrides)
      : summary(simulate(model::read_text(spindle(restrictor), "m.yaml", overrides), {.results = scratch / "run.h5"})),
        reader(summary.results) {
    REQUIRE(summary.status == Status::completed);
  }
  [[nodiscard]] std::vector<double> all(const std::string& series) const {
    return reader.read("/bearings/main/" + series).values;
  }
  [[nodiscard]] double last(const std::string& series) const { return all(series).back(); }
};

const std::vector<std::string>& restrictors() {
  static const std::vector<std::string> all{kCapillary, "{type: orifice, diameter: 0.4 mm}",
                                            "{type: constant_flow, flow: 0.3 l/min}"};
  return all;
}

TEST_CASE("SpindleOnRecesses_SettlesInItsSteadyMotion") {
  for (const std::string& restrictor : restrictors()) {
    CAPTURE(restrictor);
    const Ran steady(restrictor, {"simulation={analysis: steady}"}),
        settled(restrictor, {"simulation.duration=600 ms"});
    for (const char* series :
         {"h_min", "pressure_feature_below", "pressure_feature_left", "flow_supply", "pumping_power", "power_film"})
      CHECK(settled.last(series) == relative(steady.last(series)).epsilon(1e-5));  // what is left of the motion then
  }
}

TEST_CASE("SpindleAtRest_Floats") {
  const Ran steady(kCapillary, {"speed=0 rpm", "simulation={analysis: steady}"}),
      settled(kCapillary, {"speed=0 rpm", "simulation.duration=400 ms"});
  CHECK(steady.last("h_min") > 30e-6);                                           // half of the clearance
  CHECK(settled.last("h_min") == relative(steady.last("h_min")).epsilon(1e-5));  // what is left of the motion then
  CHECK(steady.last("pressure_feature_left") ==
        relative(steady.last("pressure_feature_right")).epsilon(1e-8));  // mirrored; as solved
}

// Flow of each recess against the law of its restrictor: flows are means over a step, pressures those at its end, and
// differ by what the motion changes within a step.
TEST_CASE("FlowsOfRecessesInTime_AreThoseOfTheirRestrictors") {
  const auto worst = [](const std::string& step) {
    const Ran run("{type: resistance, resistance: 4e11 Pa.s/m^3}",
                  {"simulation.duration=20 ms", "simulation.step=" + step});
    double largest = 0;
    for (const char* name : {"below", "right", "above", "left"}) {
      const std::vector<double> pressure = run.all(std::string("pressure_feature_") + name),
                                flow = run.all(std::string("flow_feature_") + name),
                                ratio = run.all(std::string("pressure_ratio_") + name);
      // In the second half: the velocity with which it is let go settles within less than a step.
      for (std::size_t k = flow.size() / 2; k < flow.size(); ++k) {
        CHECK(ratio[k] == relative(pressure[k] / 40e5).epsilon(1e-12));  // a quotient
        largest = std::max(largest, std::abs(flow[k] - (40e5 - pressure[k]) / 4e11) / flow[k]);
      }
    }
    for (const double error : run.all("mass_balance_error")) CHECK(error < 1e-9);  // ten times the film's tolerance
    return largest;
  };
  const double coarse = worst("1 ms"), fine = worst("0.25 ms");
  CHECK(coarse < 0.2);
  CHECK(fine < 0.4 * coarse);  // a quarter
}

}  // namespace hydrostatic_run_test
}  // namespace hersey::run
