#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "relative.h"
#include "wearing_bush.h"

// What surfaces that wear run in to, and what an acceleration may do.
namespace hersey::run {
namespace running_in_test {

using namespace wearing_bush;

/// Integral of a series over the time of its rows, as wear sums it up: by trapezoids.
double over_time(const results::Reader& reader, const std::vector<double>& values) {
  const std::vector<double> time = reader.read("/time").values;
  double sum = 0;
  for (std::size_t i = 1; i < time.size(); ++i) sum += 0.5 * (values[i] + values[i - 1]) * (time[i] - time[i - 1]);
  return sum;
}

// (wear.2): the friction of the results is that of Coulomb rounded at 1 mm/s, mu v/sqrt(v^2 + (1 mm/s)^2).
TEST_CASE("WornVolume_IsTheWorkOfFrictionOverItsEnergyDensity") {
  for (const char* sense : {"1", "-1"}) {
    const Run run({"end=20 ms", std::string("sense=") + sense, "of_journal=1e-15 1/Pa"});
    const double v = 4 * std::numbers::pi * 0.025, rounding = std::sqrt(1 + std::pow(1e-3 / v, 2));  // 1 mm/s
    const double work = rounding * over_time(results::Reader(run.summary().results), run.series("power_asperity"));
    constexpr double friction = 0.1, acceleration = 5000;
    CHECK(run.last("worn_volume_fixed") ==
          relative(acceleration * 2e-15 / friction * work).epsilon(1e-9));  // round-off
    CHECK(run.last("worn_volume_moving") ==
          relative(acceleration * 1e-15 / friction * work).epsilon(1e-9));  // likewise
  }
}

// A shaft that sinks into the bush by wear alone takes the same off each place along the axis, and cos(phi) of it
// around: pressure of contact follows, whatever law the asperities have (Archard).
TEST_CASE("WornBush_FitsItsShaft") {
  std::string text = bush;
  const auto replace = [&](const std::string& before, const std::string& after) {
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before))
      text.replace(at, before.size(), after);
  };
  replace("viscosity: 30 mPa.s", "viscosity: 1 mPa.s"), replace("120 rpm", "12 rpm");  // contact carries
  replace("x: \"6.6 um*${sense}\", y: -26.2 um", "y: -26 um"), replace("lining: 20 um", "lining: 200 um");
  const Run run({"end=400 ms", "step=1 ms", "factor=2e5"}, Status::completed, text);
  const std::vector<double> p = run.field("asperity_pressure");
  constexpr std::size_t n_phi = 60, n_z = 5;
  const auto spread_along = [&](const double* rows, std::size_t line) {
    const auto [low, high] = std::minmax_element(rows + line * n_z, rows + (line + 1) * n_z);
    return (*high - *low) / *high;
  };
  const auto loaded_line = [&](const double* rows) {
    return static_cast<std::size_t>(std::max_element(rows, rows + n_phi * n_z) - rows) / n_z;
  };
  const double *first = p.data(), *last = p.data() + p.size() - n_phi * n_z;
  CHECK(spread_along(first, loaded_line(first)) > 0.9);  // at first one edge carries
  CHECK(spread_along(last, loaded_line(last)) < 1e-6);   // the solver's tolerance
  double sine = 0, cosine = 0, largest = 0;
  for (std::size_t i = 0; i < n_phi; ++i) {
    const double phi = 2 * std::numbers::pi * static_cast<double>(i) / n_phi;
    sine += last[i * n_z] * std::sin(phi), cosine += last[i * n_z] * std::cos(phi);
    largest = std::max(largest, last[i * n_z]);
  }
  double low = 1e300, high = 0;
  for (std::size_t i = 0; i < n_phi; ++i) {
    if (last[i * n_z] < 0.2 * largest) continue;  // the borders, where contact still spreads
    const double phi = 2 * std::numbers::pi * static_cast<double>(i) / n_phi;
    const double top = last[i * n_z] / std::cos(phi - std::atan2(sine, cosine));
    low = std::min(low, top), high = std::max(high, top);
  }
  CHECK(high / low - 1 < 0.02);  // pressure still falls by 3 % while the arc grows over the last tenth of the run
  CHECK(run.last("wear_fixed") > 5e-6);  // [m], twice the tilt's half
}

// The same of a plane pad, whose contact pressures all have one direction: V = k F s/H.
const std::string pad = R"(hersey: 1
parameters: {factor: 5000, end: 200 ms}
lubricants: {oil: {viscosity: 0.3 mPa.s}}
bodies:
  way: {mass: 20 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
  carriage: {mass: 10 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  travel: {type: prismatic, between: [ground, way], axis: y}
  lift: {type: prismatic, between: [ground, carriage], axis: x, initial: {translation: 1.5 um}}
drives: {feed: {joint: travel, coordinate: translation, speed: 0.5 m/s}}
forces: {load: {type: force, body: carriage, direction: -1 0 0, magnitude: 1 kN, axes: ground}}
bearings:
  bush: {kind: plane_slider, pad: carriage, runner: way, length: 20 mm, width: 20 mm, lubricant: oil,
         grid: {along: 21, across: 9}, shape: [{profile: ramp, rise: 1 um}],
         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa,
                      friction: 0.1},
         wear: {pad: {coefficient: 1e-15 1/Pa}, acceleration: "${factor}"}}
simulation: {duration: "${end}", step: 1 ms}
)";

TEST_CASE("InclinedPad_WearsFlat_ByLoadAndSlidingDistance") {
  const Run run({}, Status::completed, pad), later({"end=400 ms"}, Status::completed, pad);
  std::vector<double> normal;
  const std::vector<double> force = run.series("force_asperity");
  for (std::size_t i = 0; i < force.size(); i += 3) normal.push_back(force[i]);
  const double distance_and_load = 0.5 * over_time(results::Reader(run.summary().results), normal);
  CHECK(run.last("worn_volume_fixed") == relative(5000 * 1e-15 * distance_and_load).epsilon(1e-9));  // round-off
  CHECK(normal.back() == relative(1000).epsilon(0.05));  // thin oil carries the rest
  const auto spread = [](const Run& of) {
    const std::vector<double> p = of.field("asperity_pressure");
    const auto [low, high] = std::minmax_element(p.end() - 21 * 9, p.end());
    return (*high - *low) / *high;
  };
  CHECK(spread(run) < 0.5);  // 1 in the beginning
  CHECK(spread(later) < 0.3 * spread(run));
}

/// The bush under a load that pulsates; ten cycles with an acceleration of 10 stand for a hundred of this running-in.
std::string pulsating() {
  std::string text = with_running_in("0.3 um", "0.1 um");
  const auto replace = [&](const std::string& before, const std::string& after) {
    text.replace(text.find(before), before.size(), after);
  };
  replace("magnitude: 3 kN", "magnitude: {expression: 3000*(1+0.5*sin(2*pi*t/0.02)), unit: N}");
  replace("cycle: 5 ms", "cycle: 20 ms");
  return text;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST_CASE("HundredCyclesOfRunningIn_TakeTen") {
  const Run all({"end=2 s", "step=1 ms", "factor=100"}, Status::completed, pulsating());
  const Run ten({"end=200 ms", "step=1 ms", "factor=1000"}, Status::completed, pulsating());
  const Run twenty({"end=400 ms", "step=1 ms", "factor=500"}, Status::completed, pulsating());
  CHECK(total(ten.series("film_iterations")) < 0.12 * total(all.series("film_iterations")));  // twelve cycles' time
  CHECK(all.last("wear_rate") < 0.1 * all.series("wear_rate").front());                       // they have run in
  const double volume = ten.last("worn_volume_fixed");
  CHECK(twenty.last("worn_volume_fixed") == relative(volume).epsilon(0.02));  // halved acceleration: less than 2 %
  CHECK(all.last("worn_volume_fixed") == relative(volume).epsilon(0.02));     // likewise
  CHECK(std::abs(all.last("worn_volume_fixed") - volume) < ten.last("wear_error"));
  CHECK(ten.last("roughness_least") == relative(all.last("roughness_least")).epsilon(0.01));  // of what has run in
}

TEST_CASE("FlowFactorsThatRunIn_BalanceOilAndPower") {
  const auto rough = [](std::string text) {
    const std::string before = "supply: {line";
    text.insert(text.find(before),
                "roughness: {shell: {sigma: 0.6 um, gamma: 2}, journal: {sigma: 0.5 um, gamma: 0.5}}, ");
    return text;
  };
  const std::vector<std::string> model{"end=60 ms", "step=1 ms", "factor=1000"};
  std::vector<std::string> unworn = model;
  unworn.emplace_back("k=0 1/Pa");
  const Run run(model, Status::completed, rough(pulsating())), stays(unworn, Status::completed, rough(pulsating()));
  const Run smooth(model, Status::completed, pulsating());
  CHECK(run.last("roughness_least") < 4e-7);                                             // of 0.8 um [m]
  CHECK(run.last("flow_supply") != relative(smooth.last("flow_supply")).epsilon(1e-3));  // factors count
  constexpr double of_oil = 1e-9;
  CHECK(std::abs(run.last("oil_unexplained")) < of_oil * run.last("oil_through_flow"));
  // The grid leaves 0.3 % of the unworn bush's power unexplained, whose edge carries; running in adds nothing.
  CHECK(std::abs(run.summary().bearings[0].energy_error) < std::abs(stays.summary().bearings[0].energy_error));
  CHECK(std::abs(stays.summary().bearings[0].energy_error) < 0.005);
}

}  // namespace running_in_test
}  // namespace hersey::run
