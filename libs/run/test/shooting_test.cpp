// Shooting: the motion that repeats, found in fewer cycles than it takes to wait for it, and its Floquet multipliers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edited.h"
#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace shooting_test {

constexpr double kSpeed = 3000 * std::numbers::pi / 30, kPeriod = 2 * std::numbers::pi / kSpeed;

/// An oscillator beside the rig that the crank's rotation excites; it decays by a fifth in ten periods.
struct Oscillator {
  double mass = 0.2, frequency = 0.37 * kSpeed, decay = 1.1, force = 3;  // [kg, rad/s, 1/s, N]
  [[nodiscard]] double stiffness() const { return mass * (frequency * frequency + decay * decay); }
  [[nodiscard]] double damping() const { return 2 * mass * decay; }
  /// Amplitude of the motion that repeats [m].
  [[nodiscard]] double amplitude() const {
    return force / std::hypot(stiffness() - mass * kSpeed * kSpeed, damping() * kSpeed);
  }
};

std::string rig_by(const std::string& lead_in, const std::string& tolerance = "1e-5") {
  std::string text =
      rig_with("  duration: \"${duration}\"\n",
               "  cycle: {period: 360 deg, until_converged: " + tolerance + ", most: 60, lead_in: " + lead_in + "}\n");
  text = edited(text, "spectral_radius: 0.6", "spectral_radius: 0.95");
  return edited(text, "components: [0 N, \"-${load}\", 0 N]",
                "direction: y, magnitude: {expression: \"-500*(1 + 0.5*sin(main.rotation))\", unit: N}");
}

std::string with_oscillator(std::string text, const Oscillator& of) {
  text = edited(text, "bodies:\n",
                "bodies:\n  weight: {mass: " + std::to_string(of.mass) +
                    " kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}\n");
  text = edited(text, "joints:\n", "joints:\n  slide: {type: prismatic, between: [ground, weight], axis: x}\n");
  return edited(text, "forces:\n",
                "forces:\n  spring: {type: sliding_spring, joint: slide, stiffness: " + std::to_string(of.stiffness()) +
                    " N/m, damping: " + std::to_string(of.damping()) +
                    " N.s/m}\n  shake: {type: force, body: weight, direction: x, magnitude: {expression: \"" +
                    std::to_string(of.force) + "*sin(main.rotation)\", unit: N}}\n");
}

struct Answer {
  Summary summary;
  std::vector<double> h_min;  ///< over the last cycle
  std::vector<double> slide;
  std::vector<double> magnitude, frequency;
};

Answer answer_of(const std::string& text) {
  const TemporaryDirectory scratch;
  Answer answer;
  const Options options{.results = scratch / "run.h5"};
  answer.summary = simulate(rig(text), options);
  INFO(answer.summary.message);
  REQUIRE(answer.summary.status == Status::completed);
  const results::Reader reader(options.results);
  answer.h_min = reader.read("/bearings/big_end/h_min").values;
  answer.h_min.erase(answer.h_min.begin(), answer.h_min.end() - 180);
  if (reader.has("/joints/slide")) answer.slide = reader.read("/joints/slide/coordinates").values;
  if (!reader.has("/cycles/multipliers")) return answer;
  answer.magnitude = reader.read("/cycles/multipliers/fields/magnitude").values;
  answer.frequency = reader.read("/cycles/multipliers/fields/frequency").values;
  return answer;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]) / b[i]);
  return largest;
}

TEST_CASE("Shooting_FindsTheMotionThatWaitingLeadsTo") {
  const Answer waited = answer_of(rig_by("none", "1e-7")), shot = answer_of(rig_by("shooting"));
  CHECK(largest_difference(shot.h_min, waited.h_min) < 1e-4);  // of the orbit
  CHECK(shot.summary.cycles == 2);
  CHECK(shot.summary.message.find("cycles of shooting") != std::string::npos);
}

// A wheel on a torsion spring swings by most of a revolution to either side: where it is a whole revolution off, the
// spring pulls it elsewhere.
TEST_CASE("Shooting_CountsTheRevolutionsOfWhatSwings") {
  const Oscillator of{.mass = 1e-3, .force = 426};  // [kg m^2, N m]
  std::string text = edited(rig_by("shooting"), "bodies:\n",
                            "bodies:\n  wheel: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 "
                            "kg.m^2}}\n");
  text = edited(text, "joints:\n", "joints:\n  slide: {type: revolute, between: [ground, wheel]}\n");
  text = edited(text, "forces:\n",
                "forces:\n  spring: {type: torsion_spring, joint: slide, stiffness: " + std::to_string(of.stiffness()) +
                    " N.m/rad, damping: " + std::to_string(of.damping()) +
                    " N.m.s/rad}\n  shake: {type: torque, body: wheel, direction: z, magnitude: {expression: \"" +
                    std::to_string(of.force) + "*cos(main.rotation)\", unit: N.m}}\n");
  const Answer shot = answer_of(text);
  INFO(shot.summary.message);
  REQUIRE(shot.summary.message.find("cycles of shooting") != std::string::npos);
  REQUIRE(of.amplitude() > 1.4 * std::numbers::pi);
  const double tolerance = 2e-3 * of.amplitude();  // 2 deg a step: period and amplitude are off by its square
  const double lags = std::atan2(of.damping() * kSpeed, of.stiffness() - of.mass * kSpeed * kSpeed);
  for (std::size_t k = 0; k < shot.slide.size(); ++k) {
    CAPTURE(k);
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / 180 - lags;
    CHECK(std::abs(shot.slide[k] - of.amplitude() * std::cos(angle)) < tolerance);
  }
}

TEST_CASE("Shooting_FindsMotionsThatDecaySlowly") {
  const Oscillator oscillator;
  const Answer shot = answer_of(with_oscillator(rig_by("shooting"), oscillator));
  const auto [least, most] = std::minmax_element(shot.slide.begin(), shot.slide.end());
  // Steps of two degrees, of second order.
  CHECK((*most - *least) / 2 == doctest::Approx(oscillator.amplitude()).epsilon(2e-3));
  CHECK(std::abs(*most + *least) < 2e-3 * oscillator.amplitude());  // the same, and what is left of the start
  // Waiting takes ln(1e5) over the decay in a period.
  CHECK(shot.summary.lead_in_cycles + shot.summary.cycles < std::log(1e5) / (oscillator.decay * kPeriod) / 20);
}

TEST_CASE("Multipliers_AreThoseOfTheOscillator") {
  const Oscillator oscillator;
  const Answer shot = answer_of(edited(with_oscillator(rig_by("shooting"), oscillator), "lead_in: shooting",
                                       "lead_in: shooting, multipliers: 1"));
  REQUIRE(shot.magnitude.size() == 1);
  // Steps of two degrees, of second order, and the accuracy to which multipliers are found.
  CHECK(shot.magnitude[0] == doctest::Approx(std::exp(-oscillator.decay * kPeriod)).epsilon(2e-3));
  CHECK(shot.frequency[0] == doctest::Approx(oscillator.frequency / (2 * std::numbers::pi)).epsilon(2e-3));
  CHECK(shot.summary.message.find("unstable") == std::string::npos);
}

TEST_CASE("MirroredMachine_HasTheSameMultipliers") {
  const auto with = [](const std::string& sense) {
    std::string text = edited(rig_by("shooting"), "lead_in: shooting", "lead_in: shooting, multipliers: 1");
    if (sense.empty()) return answer_of(text);
    text = edited(text, "initial: {rotation_rate: 3000 rpm}", "initial: {rotation_rate: -3000 rpm}");
    text = edited(text, "coordinate: rotation, speed: 3000 rpm", "coordinate: rotation, speed: -3000 rpm");
    return answer_of(edited(text, "sin(main.rotation)", "sin(-main.rotation)"));
  };
  const Answer a = with(""), b = with("-");
  REQUIRE(a.magnitude.size() == 1);
  REQUIRE(b.magnitude.size() == 1);
  CHECK(a.magnitude[0] < 1);
  CHECK(a.magnitude[0] == doctest::Approx(b.magnitude[0]).epsilon(2e-3));  // to which multipliers are found
  CHECK(largest_difference(a.h_min, b.h_min) < 1e-4);                      // of the orbit
}

TEST_CASE("MultipliersOfAMotionThatIsNotLookedFor_AreRefused") {
  const std::string text = edited(rig_by("half_grids"), "lead_in: half_grids", "lead_in: half_grids, multipliers: 2");
  CHECK_THROWS_WITH_AS((void)rig(text), doctest::Contains("`lead_in: shooting` beside them"), InputError);
}

TEST_CASE("ShootingOfMachinesThatNeverRepeat_IsRefused") {
  const std::string wears = edited(rig_by("shooting"), "    supply: {line",
                                   "    wear: {shell: {coefficient: 2e-15 1/Pa}}\n    "
                                   "asperities: {model: greenwood_tripp, roughness: 1 "
                                   "um, composite_modulus: 115 GPa, friction: 0.1}\n    supply: {line");
  CHECK_THROWS_WITH_AS((void)rig(wears), doctest::Contains("between surfaces that wear"), InputError);
  std::string controlled =
      edited(rig_by("shooting"), "  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}\n", "");
  controlled =
      edited(controlled, "forces:\n",
             "forces:\n  motor: {type: speed_control, joint: main, speed: 3000 rpm, proportional: 1 N.m.s/rad}\n");
  const std::string chosen = edited(rig_by("shooting"), "step: 2 deg", "step: {tolerance: 1e-4}");
  CHECK_THROWS_WITH_AS((void)rig(chosen), doctest::Contains("steps chosen by their error"), InputError);
  CHECK_THROWS_WITH_AS((void)rig(controlled), doctest::Contains("whose controller stores"), InputError);
}

}  // namespace shooting_test
}  // namespace hersey::run
