#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Pads that tilt are bodies with films on arcs: their steady motion with the journal, and what it is equal to.
namespace hersey::run {
namespace tilting_pads_test {

constexpr double degree = std::numbers::pi / 180, R = 0.05, c = 100e-6;

struct Pads {
  std::vector<double> pivots{-36, 36, 108, 180, 252};  // [deg]
  std::string speed = "3000 rpm";
  double turned = 0;  // [deg]
  double sign = 1;    // -1: mirrored
  std::string joint = "revolute";
  std::string simulation = "{analysis: steady}";
};

/// A journal of 100 mm under 7854 N along x, and pads of 60 deg with a preload of 0.5, pivoted in their surfaces.
std::string model_of(const Pads& pads) {
  std::string frames, bodies, joints, bearings;
  for (std::size_t k = 0; k < pads.pivots.size(); ++k) {
    const double angle = pads.sign * pads.pivots[k] + pads.turned;
    const std::string pivot = fmt::format("{{origin: [{:.17g} m, {:.17g} m, 0 m]}}", R * std::cos(angle * degree),
                                          R * std::sin(angle * degree));
    frames += fmt::format("p{}: {}, ", k, pivot);
    bodies += fmt::format(
        "  pad{}: {{mass: 1 kg, inertia: {{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}, frames: "
        "{{face: {{origin: 0 0 0 m}}, pivot: {}}}}}\n",
        k, pivot);
    joints += pads.joint == "fixed"
                  ? fmt::format("  j{0}: {{type: fixed, between: [ground.p{0}, pad{0}.pivot]}}\n", k)
                  : fmt::format("  j{0}: {{type: revolute, between: [ground.p{0}, pad{0}.pivot], axis: z}}\n", k);
    bearings += fmt::format(R"(  pad{0}: {{shell: pad{0}.face, journal: rotor, diameter: 100 mm, width: 50 mm,
         radial_clearance: 100 um, lubricant: oil, grid: {{circumferential: 120, axial: 13}},
         arcs: {{pad: {{middle: {1:.17g} deg, arc: 60 deg, preload: 0.5}}}}}}
)",
                            k, angle);
  }
  const double W = 7853.981634;
  return fmt::format(R"(hersey: 1
lubricants: {{oil: {{viscosity: 20 mPa.s}}}}
bodies:
  ground: {{frames: {{{0}}}}}
  rotor: {{mass: 100 kg, inertia: {{xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}}
{1}joints:
  spin: {{type: planar, between: [ground, rotor], axis: z}}
{2}forces:
  load: {{type: force, body: rotor, axes: ground, components: [{3:.17g} N, {4:.17g} N, 0 N]}}
drives: {{motor: {{joint: spin, coordinate: rotation, speed: {5}}}}}
bearings:
{6}simulation: {7}
)",
                     frames, bodies, joints, W * std::cos(pads.turned * degree), W * std::sin(pads.turned * degree),
                     pads.speed, bearings, pads.simulation);
}

class Solved {
 public:
  explicit Solved(const std::string& text)
      : summary_(simulate(model::read_text(text, "m.yaml"), {.results = scratch_ / "run.h5"})) {
    REQUIRE(summary_.status == Status::completed);
  }

  /// Last row of a series.
  [[nodiscard]] std::vector<double> last(const std::string& path) const {
    const results::Array array = results::Reader(summary_.results).read(path);
    return {array.values.end() - static_cast<std::ptrdiff_t>(array.width()), array.values.end()};
  }
  [[nodiscard]] double number(const std::string& path) const { return last(path).front(); }
  /// Component of a series of vectors in the plane along the load.
  [[nodiscard]] double along(const std::string& path, double turned) const {
    const std::vector<double> v = last(path);
    return v[0] * std::cos(turned * degree) + v[1] * std::sin(turned * degree);
  }
  [[nodiscard]] double size(const std::string& path) const {
    const std::vector<double> v = last(path);
    return std::hypot(v[0], v[1]);
  }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

// Of a program of another hand (finite differences, pads of 128 x 48 nodes), without shear. Shear pushes pads round
// their pivots and moves the journal across by 0.0015 c.
TEST_CASE("FivePadsLoadedBetweenTwo_MatchAnIndependentProgram") {
  const Solved found(model_of({}));
  const std::array<double, 5> load{0.63036, 0.63036, 0.02433, 0.00491, 0.02433};      // over that of the journal
  const std::array<double, 5> thinnest{0.25335, 0.25335, 1.10331, 1.71055, 1.10331};  // over c
  CHECK(found.last("bodies/rotor/position")[0] == doctest::Approx(0.82803 * c).epsilon(0.001));
  CHECK(std::abs(found.last("bodies/rotor/position")[1]) < 0.002 * c);  // by shear
  for (std::size_t k = 0; k < 5; ++k) {
    CAPTURE(k);
    const std::string pad = "bearings/pad" + std::to_string(k);
    CHECK(found.number(pad + "/h_min") == doctest::Approx(thinnest[k] * c).epsilon(0.015));
    CHECK(std::abs(found.size(pad + "/force") / 7853.98 - load[k]) < 0.006);
  }
}

TEST_CASE("TiltingPads_HaveTheSameFilmsTurnedAndMirrored") {
  const Solved one(model_of({})), turned(model_of({.turned = 50})),
      mirrored(model_of({.speed = "-3000 rpm", .sign = -1}));
  constexpr double solved_for = 1e-6;  // the steady motion is found to 1e-9 of its forces
  for (const Solved* other : {&turned, &mirrored}) {
    for (std::size_t k = 0; k < 5; ++k) {
      CAPTURE(k);
      const std::string pad = "bearings/pad" + std::to_string(k);
      for (const char* key : {"/h_min", "/p_max", "/power_film", "/flow_left", "/eccentricity_ratio"})
        CHECK(other->number(pad + key) == relative(one.number(pad + key)).epsilon(solved_for));
    }
  }
  CHECK(turned.along("bodies/rotor/position", 50) ==
        relative(one.along("bodies/rotor/position", 0)).epsilon(solved_for));
}

TEST_CASE("PadsThatDoNotTilt_AreABoreOfArcs") {
  const Solved pads(model_of({.joint = "fixed"}));
  std::string text = model_of({.pivots = {}});
  text.replace(text.find("ground: {frames: {}}"), 20, "ground: {frames: {centre: {origin: 0 0 0 m}}}");
  text.replace(text.find("bearings:\n"), 10, R"(bearings:
  bore: {shell: ground.centre, journal: rotor, diameter: 100 mm, width: 50 mm, radial_clearance: 100 um, lubricant: oil,
         grid: {circumferential: 120, axial: 13}, bore: {type: lobes, count: 5, preload: 0.5, groove: 12 deg, angle: 36 deg}}
)");
  const Solved bore(text);
  constexpr double solved_for = 1e-6;  // the steady motion is found to 1e-9 of its forces
  const auto at = [](const Solved& s) { return s.last("bodies/rotor/position"); };
  for (const std::size_t axis : {0U, 1U}) CHECK(std::abs(at(pads)[axis] - at(bore)[axis]) < solved_for * c);
  double power = 0, thinnest = 1;
  for (std::size_t k = 0; k < 5; ++k) {
    const std::string pad = "bearings/pad" + std::to_string(k);
    power += pads.number(pad + "/power_film");
    thinnest = std::min(thinnest, pads.number(pad + "/h_min"));
  }
  CHECK(bore.number("bearings/bore/power_film") == relative(power).epsilon(solved_for));
  CHECK(bore.number("bearings/bore/h_min") == relative(thinnest).epsilon(solved_for));
}

TEST_CASE("SettledPads_AreThoseOfTheSteadyMotion") {
  const Solved steady(model_of({})), settled(model_of({.simulation = "{duration: 80 ms, step: 0.4 ms}"}));
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(k);
    const std::string pad = "bearings/pad" + std::to_string(k);
    for (const char* key : {"/h_min", "/p_max", "/eccentricity_ratio", "/flow_trailing"})
      CHECK(settled.number(pad + key) == relative(steady.number(pad + key)).epsilon(1e-3));  // what has not settled
  }
  for (const char* pad : {"pad0", "pad3"})
    CHECK(settled.number(std::string("bearings/") + pad + "/mass_balance_error") < 1e-9);  // films are solved to 1e-10
}

}  // namespace tilting_pads_test
}  // namespace hersey::run
