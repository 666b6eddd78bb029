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

// A rotor in two bearings on a pump that gives less oil than they would take.
namespace hersey::run {
namespace starved_run_test {

std::string bearing(const std::string& name, const std::string& clearance) {
  return "  " + name + R"(:
    shell: ground
    journal: rotor
    diameter: 60 mm
    width: 30 mm
    radial_clearance: )" +
         clearance + R"(
    lubricant: oil
    grid: {circumferential: 24, axial: 9}
    features:
      groove: {shape: circumferential_groove, angle: 90 deg, arc: 180 deg, length: 8 mm, circuit: )" +
         name + "}\n";
}

/// @param flow  of the pump [mm^3/s]
std::string machine(double flow, const std::string& gallery = "{}") {
  return R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
lubricants:
  oil: {viscosity: 12 mPa.s, density: 850 kg/m^3}
bodies:
  rotor: {mass: 120 kg, inertia: {xx: 4 kg.m^2, yy: 4 kg.m^2, zz: 0.6 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}
circuit:
  lubricant: oil
  nodes:
    sump: {pressure: 0 bar}
    gallery: )" +
         gallery + R"(
    main_1: {}
    main_2: {}
  elements:
    pump: {type: flow, from: sump, to: gallery, flow: )" +
         std::to_string(flow) + R"( mm^3/s}
    drilling: {type: drilling, from: gallery, to: main_1, length: 80 mm, diameter: 4 mm, loss_coefficient: 1.5}
    jet: {type: orifice, from: gallery, to: main_2, diameter: 1.5 mm}
bearings:
)" + bearing("main_1", "40 um") +
         bearing("main_2", "50 um") + "simulation: {duration: 4 ms, step: 0.2 ms}\n";
}

struct Ran {
  TemporaryDirectory scratch;
  Summary summary;
  results::Reader reader;
  explicit Ran(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch / "run.h5"})),
        reader(summary.results) {
    REQUIRE_MESSAGE(summary.status == Status::completed, summary.message);
  }
  [[nodiscard]] std::vector<double> all(const std::string& series) const { return reader.read("/" + series).values; }
  [[nodiscard]] double last(const std::string& series) const { return all(series).back(); }
  [[nodiscard]] double largest(const std::string& series) const {
    const std::vector<double> values = all(series);
    return *std::max_element(values.begin(), values.end());
  }
};

constexpr double kConserved = 1e-9;        // of the largest flow, which machines' steps leave
constexpr double kCubicMillimetre = 1e-9;  // m^3

const std::string kSteady = "simulation={analysis: steady}";

double taken(const Ran& run) { return run.last("circuit/drawn_main_1") + run.last("circuit/drawn_main_2"); }

// Pump, films and sides of films have the same oil, in steady motion and at every step.
TEST_CASE("BearingsOnASmallPump_TakeWhatItGives") {
  const double want = taken(Ran(machine(3500), {kSteady}));  // just enough: they lie near the cavitation pressure
  CHECK(want == doctest::Approx(3500 * kCubicMillimetre).epsilon(kConserved));
  for (const double flow : {350.0, 1000.0}) {  // mm^3/s: a tenth, and a third
    CAPTURE(flow);
    const Ran steady(machine(flow), {kSteady});
    CHECK(taken(steady) == doctest::Approx(kCubicMillimetre * flow).epsilon(kConserved));
    for (const std::string name : {"main_1", "main_2"}) {
      const double drawn = steady.last("circuit/drawn_" + name), fill = steady.last("circuit/fill_" + name);
      CHECK(steady.last("bearings/" + name + "/flow_left") + steady.last("bearings/" + name + "/flow_right") ==
            doctest::Approx(drawn).epsilon(kConserved));
      CHECK(steady.last("bearings/" + name + "/flow_feature_groove") == doctest::Approx(drawn).epsilon(kConserved));
      CHECK(steady.last("circuit/pressure_" + name) == 0);
      CHECK(fill > 0);
      CHECK(fill < 1);
    }
    const Ran run(machine(flow), {"simulation.duration=20 ms"});
    CHECK(run.largest("circuit/balance_error") < kConserved);
    const std::vector<double> drawn_1 = run.all("circuit/drawn_main_1"), drawn_2 = run.all("circuit/drawn_main_2");
    for (std::size_t k = 0; k < drawn_1.size(); ++k)
      CHECK(drawn_1[k] + drawn_2[k] == doctest::Approx(kCubicMillimetre * flow).epsilon(kConserved));
  }
}

// Less oil, less film: the journal sinks.
TEST_CASE("DryBearingsOnASmallPump_StartWithWhatItGives") {
  for (const double flow : {350.0, 1000.0, 9000.0}) {
    CAPTURE(flow);
    const Ran run(machine(flow),
                  {"simulation.duration=2 ms", "bearings.main_1.initial_fill=0", "bearings.main_2.initial_fill=0.2"});
    CHECK(run.largest("circuit/balance_error") < kConserved);
    const std::vector<double> drawn_1 = run.all("circuit/drawn_main_1"), drawn_2 = run.all("circuit/drawn_main_2");
    for (std::size_t k = 0; k < drawn_1.size(); ++k)
      CHECK(drawn_1[k] + drawn_2[k] == doctest::Approx(kCubicMillimetre * flow).epsilon(kConserved));
  }
}

TEST_CASE("JournalOnASmallPump_RunsCloserToTheShell") {
  double before = 1;
  for (const double flow : {5000.0, 2000.0, 1000.0, 350.0}) {  // mm^3/s
    const double h = Ran(machine(flow), {kSteady}).last("bearings/main_1/h_min");
    CHECK(h < before);
    before = h;
  }
}

TEST_CASE("StarvedRun_IsOfFirstOrderInTheStep") {
  const auto fill_at_end = [](const char* step) {
    return Ran(machine(1000), {"simulation.duration=8 ms", std::string("simulation.step=") + step})
        .last("circuit/fill_main_1");
  };
  const double coarse = fill_at_end("0.2 ms"), middle = fill_at_end("0.1 ms"), fine = fill_at_end("0.05 ms");
  CHECK(fine < 1);
  CHECK(std::abs(fine - middle) < 0.7 * std::abs(middle - coarse));  // half, and what ruptures do to it
}

// A gallery that a pump has left feeds the bearings until it is empty, and the oil that it loses is what they take.
TEST_CASE("GalleryThatIsLeft_GivesItsOilToTheBearings") {
  const Ran run(machine(350, "{volume: 2 cm^3}"), {"simulation.duration=20 ms"});
  const std::vector<double> t = run.all("time"), stored = run.all("circuit/stored"),
                            pump = run.all("circuit/flow_pump"), drawn_1 = run.all("circuit/drawn_main_1"),
                            drawn_2 = run.all("circuit/drawn_main_2");
  double came_in = 0;
  for (std::size_t k = 1; k < t.size(); ++k) came_in += (t[k] - t[k - 1]) * (pump[k] - drawn_1[k] - drawn_2[k]);
  CHECK(std::abs(stored.back() - stored.front() - came_in) < kConserved * stored.front());
  CHECK(run.largest("circuit/balance_error") < kConserved);
}

}  // namespace starved_run_test
}  // namespace hersey::run
