// Films that begin with little oil and fill from what feeds them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace dry_start_test {

/// A journal that stands in the middle of its bearing between walls, with a line of oil under pressure at `line`.
std::string standing(double fill, int nodes, double line, double step) {
  return fmt::format(R"(hersey: 1
lubricants: {{oil: {{viscosity: 20 mPa.s}}}}
bodies: {{shaft: {{mass: 1 kg, inertia: {{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}}}}}
joints: {{turning: {{type: revolute, between: [ground, shaft], axis: z}}}}
drives: {{motor: {{joint: turning, coordinate: rotation, speed: 0 rpm}}}}
bearings:
  bush:
    shell: ground
    journal: shaft
    diameter: 40 mm
    width: 20 mm
    radial_clearance: 50 um
    lubricant: oil
    grid: {{circumferential: {}, axial: 3}}
    edge_pressure: closed
    supply: {{line: {} deg, pressure: 1 bar}}
    initial_fill: {}
simulation: {{duration: 60 ms, step: {} ms}}
)",
                     nodes, line, fill, step);
}

struct Filling {
  std::vector<double> time, volume;
  double worst_balance = 0;
};

Filling fill(const std::string& model) {
  const TemporaryDirectory folder;
  const Summary summary = simulate(model::read_text(model, "m.yaml"), {.results = folder / "r.h5"});
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  return {.time = reader.read("/time").values,
          .volume = reader.read("/bearings/bush/oil_volume").values,
          .worst_balance = summary.bearings[0].worst_mass_balance};
}

constexpr double kGap = 50e-6, kCircumference = std::numbers::pi * 40e-3, kWidth = 20e-3;

/// Oil in the gap while two fronts move away from the line, x^2 = p h^2 t/(6 mu (1 - fill)) each.
double volume_at(double t, double fill) {
  const double x = std::sqrt(1e5 * kGap * kGap * t / (6 * 0.02 * (1 - fill)));
  return kGap * kWidth * (fill * kCircumference + 2 * x * (1 - fill));
}

TEST_CASE("DryFilm_FillsAsAFrontUnderPressure") {
  for (const double part : {0.0, 0.1, 0.6}) {
    CAPTURE(part);
    double coarse = 0;
    for (const int nodes : {60, 120}) {
      const Filling found = fill(standing(part, nodes, 7, 120.0 / nodes));
      CHECK(found.worst_balance < 1e-9);  // round-off of sums of flows
      const double gained = found.volume.back() - kGap * kWidth * kCircumference * part;
      const double expected = volume_at(found.time.back(), part) - kGap * kWidth * kCircumference * part;
      const double error = std::abs(gained / expected - 1);
      CAPTURE(error);
      CHECK(error < 0.04);
      if (nodes > 60) CHECK(error < 0.8 * coarse);
      coarse = error;
    }
  }
}

TEST_CASE("DryFilm_FillsTheSameWhereverItIsFed") {
  const Filling here = fill(standing(0.1, 60, 6, 1)), there = fill(standing(0.1, 60, 126, 1));
  for (std::size_t k = 0; k < here.volume.size(); ++k)
    CHECK(here.volume[k] == doctest::Approx(there.volume[k]).epsilon(1e-9));  // round-off of positions
}

TEST_CASE("FilmThatBeginsFull_NeedsNoKey") {
  const std::string full = standing(1, 60, 7, 2);
  std::string plain = full;
  plain.erase(plain.find("    initial_fill"), std::string("    initial_fill: 1\n").size());
  CHECK(fill(full).volume == fill(plain).volume);
}

/// A loaded shaft on its asperities that begins to turn.
std::string loaded(double fill, int sense) {
  return fmt::format(R"(hersey: 1
gravity: 0 0 0 m/s^2
lubricants: {{oil: {{viscosity: 10 mPa.s}}}}
bodies: {{shaft: {{mass: 20 kg, inertia: {{xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 6e-3 kg.m^2}}}}}}
joints: {{turning: {{type: planar, between: [ground, shaft], axis: z, initial: {{y: -37.9 um}}}}}}
drives: {{motor: {{joint: turning, coordinate: rotation, speed: {{expression: "{}*3000*t", unit: rpm}}}}}}
forces: {{load: {{type: force, body: shaft, direction: 0 -1 0, magnitude: 2 kN, axes: ground}}}}
bearings:
  bush:
    shell: ground
    journal: shaft
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 40 um
    lubricant: oil
    grid: {{circumferential: 60, axial: 7}}
    asperities: {{model: greenwood_tripp_fit, roughness: 1 um, elastic_factor: 3e-3, composite_modulus: 130 GPa, friction: 0.1}}
    initial_fill: {}
    features: {{hole: {{shape: hole, angle: 90 deg, diameter: 9 mm, pressure: 1 bar}}}}
    wear: {{shell: {{coefficient: 2e-16 1/Pa}}}}
simulation: {{duration: 200 ms, step: 2 ms}}
)",
                     sense, fill);
}

TEST_CASE("DryStart_WearsMoreThanAFullOneAndEndsAlike") {
  struct Start {
    double worn, gap, volume, worst_balance;
  };
  const auto start = [](double fill, int sense) {
    const TemporaryDirectory folder;
    const Summary summary = simulate(model::read_text(loaded(fill, sense), "m.yaml"), {.results = folder / "r.h5"});
    REQUIRE(summary.status == Status::completed);
    const results::Reader reader(folder / "r.h5");
    const auto last = [&](const std::string& name) { return reader.read("/bearings/bush/" + name).values.back(); };
    return Start{last("worn_volume_fixed"), last("h_min"), last("oil_volume"), summary.bearings[0].worst_mass_balance};
  };
  const Start full = start(1, 1), low = start(0.3, 1), dry = start(0, 1), mirrored = start(0, -1);
  CHECK(low.worn > 1.1 * full.worn);
  CHECK(dry.worn > 1.1 * low.worn);
  CHECK(dry.gap == doctest::Approx(full.gap).epsilon(1e-3));        // of the gap at the end: once filled, alike
  CHECK(dry.volume == doctest::Approx(full.volume).epsilon(1e-3));  // of the oil in it
  CHECK(dry.worst_balance < 1e-9);                                  // round-off of sums of flows
  CHECK(mirrored.worn == doctest::Approx(dry.worn).epsilon(1e-6));  // Newton's iteration ends at 1e-8
}

// Between walls of one temperature a sheared gap has the parabola with the height mu u^2/(8 k), however little oil it
// has: that which makes heat conducts it, too.
TEST_CASE("DryFilmThatIsShearedAllOver_IsAsWarmAsAFullOne") {
  const auto rise = [](const char* fill, const char* shear) {
    const std::string text = fmt::format(R"(hersey: 1
lubricants: {{oil: {{viscosity: 20 mPa.s, density: 860 kg/m^3, conductivity: 0.13 W/m/K}}}}
bodies: {{shaft: {{mass: 1 kg, inertia: {{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}}}}}
joints: {{turning: {{type: revolute, between: [ground, shaft], axis: z, initial: {{rotation_rate: 3000 rpm}}}}}}
drives: {{motor: {{joint: turning, coordinate: rotation, speed: 3000 rpm}}}}
bearings:
  bush: {{shell: ground, journal: shaft, diameter: 40 mm, width: 20 mm, radial_clearance: 50 um, lubricant: oil,
         grid: {{circumferential: 12, axial: 5}}, initial_fill: {}, cavitated_shear: {},
         thermal: {{model: film, supply_temperature: 40 degC, shell: {{wall: given, temperature: 40 degC}},
                   journal: {{wall: given, temperature: 40 degC}}}}}}
simulation: {{duration: 60 ms, step: 1 ms}}
)",
                                         fill, shear);
    const TemporaryDirectory folder;
    const Summary summary = simulate(model::read_text(text, "m.yaml"), {.results = folder / "r.h5"});
    REQUIRE(summary.status == Status::completed);
    constexpr double wall = 40;  // degC
    return results::Reader(folder / "r.h5").read("/bearings/bush/T_max").values.back() - wall;
  };
  const double u = 20e-3 * 100 * std::numbers::pi, exact = 20e-3 * u * u / (8 * 0.13), full = rise("1", "full");
  CHECK(full == doctest::Approx(exact).epsilon(0.02));  // of five layers
  for (const char* fill : {"0.2", "0.001"})
    for (const char* shear : {"full", "film_share"})
      CHECK(rise(fill, shear) == doctest::Approx(full).epsilon(1e-5));  // by what 60 ms have left to settle
}

}  // namespace dry_start_test
}  // namespace hersey::run
