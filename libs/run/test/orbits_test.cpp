// Orbits over a parameter: folds, Hopf points, periods that are found.
#include "hersey/run/orbits.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "edited.h"
#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace orbits_test {

constexpr const char* kOscillator = R"(hersey: 1
parameters: {mu: 1, omega: 90, force: 0.2}
bodies:
  weight: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  slide: {type: prismatic, between: [ground, weight], axis: x, initial: {translation: 1.5 m}}
forces:
  spring: {type: sliding_spring, joint: slide, stiffness: STIFFNESS N/m, damping: DAMPING N.s/m}
  rest: {type: force, body: weight, direction: x, magnitude: {expression: "REST", unit: N}}
simulation:
  cycle: {period: PERIOD, lead_in: shooting, until_converged: 1e-5, multipliers: 1}
  step: "STEP"
  spectral_radius: 1
)";

/// x'' - (mu - x^2) x' + x = 0, with steps of its period's first guess over `steps`.
std::string van_der_pol(int steps) {
  std::string text = edited(kOscillator, "STIFFNESS", "1");
  text = edited(edited(text, "DAMPING", "0"), "REST", "(${mu} - slide.translation^2)*slide.translation_rate");
  return edited(edited(text, "PERIOD", "{about: 6.5 s}"), "STEP", "6.5 s/" + std::to_string(steps));
}

/// x'' + 4 x' + 1e4 x + 1e10 x^3 = force cos(omega t).
std::string duffing(int steps) {
  std::string text = edited(kOscillator, "initial: {translation: 1.5 m}", "initial: {translation: 0 m}");
  text = edited(edited(text, "STIFFNESS", "1e4"), "DAMPING", "4");
  text = edited(text, "REST", "${force}*cos(${omega}*t) - 1e10*slide.translation^3");
  return edited(edited(text, "PERIOD", "\"2*pi s/${omega}\""), "STEP", "2*pi s/${omega}/" + std::to_string(steps));
}

Branch followed(const std::string& text, const std::string& parameter, double from, double to, double step = 0.05) {
  BranchOptions options;
  options.from = from, options.to = to, options.step = step;
  options.tolerance = 1e-5;
  return follow_branch([&](double value) { return rig(text, {parameter + "=" + std::to_string(value)}); }, options);
}

TEST_CASE("VanDerPol_HasItsPeriodAndMultiplier") {
  // Of mu = 1: Andersen and Geer (1982), SIAM J. Appl. Math. 42, 678, by series; the multiplier is exp(-int (x^2 - 1)
  // dt).
  constexpr double period = 6.66328686, largest = 2.00861986;
  const Branch coarse = followed(van_der_pol(100), "mu", 1, 0.9), fine = followed(van_der_pol(200), "mu", 1, 0.9);
  INFO(coarse.message, fine.message);
  REQUIRE((coarse.solved() && fine.solved()));
  const auto extrapolated = [&](auto of) { return (4 * of(fine.orbits.front()) - of(coarse.orbits.front())) / 3; };
  // What is left is of the fourth order of a step.
  constexpr double left = 1e-5;
  CHECK(extrapolated([](const OrbitAtValue& o) { return o.period; }) == doctest::Approx(period).epsilon(left));
  // Of a step's two ends the peak is between them: its half step's curvature.
  CHECK(fine.orbits.front().excursions.front().highest == doctest::Approx(largest).epsilon(1e-3));
  CHECK(extrapolated([](const OrbitAtValue& o) { return o.multipliers.front().real(); }) ==
        doctest::Approx(8.5955e-4).epsilon(0.02));  // of a deviation that nearly vanishes in a period
}

TEST_CASE("LimitCycle_EndsWhereItsGrowthDoes") {
  const Branch branch = followed(van_der_pol(100), "mu", 0.5, -0.5, 0.1);
  INFO(branch.message);
  REQUIRE(branch.solved());
  CHECK(branch.message.find("the oscillation vanishes") != std::string::npos);
  for (const OrbitAtValue& orbit : branch.orbits) {
    CHECK(orbit.is_stable());
    CHECK(orbit.value > -1e-3);  // the rest is stable below 0
    if (orbit.value > 0.1) continue;
    // Averaged over a period: amplitude 2 sqrt(mu), multiplier exp(-2 pi mu), to the order of mu^2.
    CHECK(orbit.excursions.front().highest == doctest::Approx(2 * std::sqrt(orbit.value)).epsilon(0.01));
    CHECK(orbit.multipliers.front().real() ==
          doctest::Approx(std::exp(-2 * std::numbers::pi * orbit.value)).epsilon(0.01));
  }
}

TEST_CASE("BranchOfADuffingOscillator_PassesItsFolds") {
  const Branch forth = followed(duffing(100), "omega", 80, 130), back = followed(duffing(100), "omega", 130, 80);
  INFO(forth.message, back.message);
  REQUIRE((forth.solved() && back.solved()));
  REQUIRE((forth.bifurcations.size() == 2 && back.bifurcations.size() == 2));
  CHECK(forth.orbits.back().value == 130);
  CHECK(back.orbits.back().value == 80);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(forth.bifurcations[k].kind == Bifurcation::fold);
    CHECK(back.bifurcations[k].kind == Bifurcation::fold);
    constexpr double located = 1e-4;  // the multiplier nearest to the circle is within 0.002 of it
    CHECK(forth.bifurcations[k].value == doctest::Approx(back.bifurcations[1 - k].value).epsilon(located));
  }
  // Between the folds there are three motions, of which the middle one is unstable.
  const double low = forth.bifurcations[1].value, high = forth.bifurcations[0].value;
  CHECK(low < high);
  constexpr double located = 1e-2;  // of 100: where a multiplier of 1 is found to 1e-3
  for (const OrbitAtValue& orbit : forth.orbits)
    if (!orbit.is_stable()) CHECK((orbit.value > low - located && orbit.value < high + located));
}

TEST_CASE("LimitCycle_IsThatOfALongRun") {
  const TemporaryDirectory scratch;
  const Branch branch = followed(van_der_pol(200), "mu", 0.5, 0.4);
  std::string text = van_der_pol(200);
  text = edited(text, "  cycle: {period: {about: 6.5 s}, lead_in: shooting, until_converged: 1e-5, multipliers: 1}\n",
                "  duration: 120 s\n");
  const Options options{.results = scratch / "run.h5"};
  const Summary summary = simulate(rig(text, {"mu=0.5"}), options);
  REQUIRE(summary.status == Status::completed);
  REQUIRE(branch.solved());
  const results::Reader reader(options.results);
  const std::vector<double> x = reader.read("/joints/slide/coordinates").values, t = reader.read("/time").values;
  // The last two passages upwards through zero.
  std::vector<double> passages;
  for (std::size_t k = 1; k < x.size(); ++k)
    if (x[k - 1] < 0 && x[k] >= 0) passages.push_back(t[k - 1] + (t[k] - t[k - 1]) * x[k - 1] / (x[k - 1] - x[k]));
  const double period = passages.back() - passages[passages.size() - 2];
  CHECK(branch.orbits.front().period == doctest::Approx(period).epsilon(1e-4));  // a passage is read off a chord
}

// A small oscillation grows by a share each period; shooting takes its growth for the way to rest.
TEST_CASE("FirstOrbit_IsFoundFromFarInside") {
  const auto first = [](const char* start, double mu) {
    const std::string text = edited(van_der_pol(100), "translation: 1.5 m", std::string("translation: ") + start);
    const Branch branch = followed(text, "mu", mu, mu + 0.1);
    INFO(branch.message);
    REQUIRE(branch.solved());
    return branch.orbits.front();
  };
  for (const double mu : {0.05, 0.1}) {
    CAPTURE(mu);
    const OrbitAtValue near = first("0.5 m", mu), far = first("1 mm", mu);
    CHECK(far.period == doctest::Approx(near.period).epsilon(1e-5));  // to which orbits are found
    CHECK(far.excursions.front().highest == doctest::Approx(near.excursions.front().highest).epsilon(1e-3));  // a step
  }
}

// Periods are counted that are run, however far off the first guess is.
TEST_CASE("LeadInWithAFoundPeriod_ReportsItsPeriods") {
  for (const char* about : {"6.5 s", "4.55 s"}) {
    CAPTURE(about);
    const TemporaryDirectory scratch;
    std::string text = edited(van_der_pol(100), "{about: 6.5 s}", std::string("{about: ") + about + "}");
    text = edited(text, ", multipliers: 1", "");
    std::vector<CycleProgress> reported;
    Options options{.results = scratch / "run.h5"};
    options.on_cycle = [&](const CycleProgress& cycle) {
      if (cycle.leads_in) reported.push_back(cycle);
    };
    const Summary summary = simulate(rig(text), options);
    INFO(summary.message);
    REQUIRE(summary.message.find("with the period 6.6") != std::string::npos);
    REQUIRE(static_cast<int>(reported.size()) == summary.lead_in_cycles);
    for (std::size_t k = 0; k < reported.size(); ++k) CHECK(reported[k].number == static_cast<int>(k) + 1);
    CHECK(reported.back().change < 1e-4);  // of its swing: the last period repeats
  }
}

TEST_CASE("Branch_SaysWhyItHasNoBeginning") {
  const Branch rests = followed(van_der_pol(100), "mu", -0.5, 0.5);
  CHECK(!rests.solved());
  CHECK(rests.message.find("comes to rest") != std::string::npos);
  CHECK(rests.message.find("begin nearer to it") != std::string::npos);
  BranchOptions options;
  options.from = 80, options.to = 90;
  options.observed = {"joints.slide.coordinate"};
  CHECK_THROWS_WITH_AS((void)follow_branch([](double) { return rig(duffing(100)); }, options),
                       doctest::Contains("joints.slide.coordinates"), InputError);
  const std::string unsought = edited(van_der_pol(100), ", lead_in: shooting", "");
  CHECK_THROWS_AS((void)rig(unsought), InputError);
}

}  // namespace orbits_test
}  // namespace hersey::run
