#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/run/steady_motion.h"
#include "hersey/study/bearing_study.h"
#include "relative.h"

// Floating rings by themselves: an independent solution, closed forms, and what other kinds of bearing say of their
// parts.
namespace hersey::study {
namespace floating_ring_study_test {

constexpr double degree = std::numbers::pi / 180;

const std::string ring_model = R"(hersey: 1
parameters: {load: 8 N, ratio: none, a: -90 deg, nu: 1, s: 6000 rad/s, around: 72, axial: 11, cavitation: reynolds}
lubricants:
  warm: {viscosity: 8 mPa.s}
  cool: {viscosity: 12 mPa.s}
bearings:
  main:
    kind: floating_ring
    lubricant: cool
    cavitation: "${cavitation}"
    cavitated_shear: full
    shear_force: torque_only
    inner: {diameter: 11 mm, width: 7 mm, radial_clearance: 20 um, supply: {line: widest_gap}, lubricant: warm,
            grid: {circumferential: "${around}", axial: "${axial}"}}
    outer: {diameter: 17 mm, width: 9 mm, diametral_clearance: 80 um, supply: {line: widest_gap},
            grid: {circumferential: "${around}", axial: "${axial}"}}
    ring: {mass: 5 g}
    operating_point: {journal_speed: "${s}", load: "${load}", eccentricity_ratio: "${ratio}", load_angle: "${a}",
                      eccentricity_angle: "${a}", whirl_ratio: "${nu}"}
)";

BearingSolution ring_with(const std::vector<std::string>& overrides, const std::string& text = ring_model,
                          const std::string& bearing = "main") {
  BearingSolution solution =
      BearingSolver().solve(model::read_text(text, "m.yaml", overrides), {.bearing = bearing, .grid_error = false});
  REQUIRE_MESSAGE(solution.solved(), solution.message);
  return solution;
}

double ratio_of(const BearingSolution& solution) {
  return solution.pads->ring->speed / solution.state.point.journal_speed;
}

Eigen::Matrix2d stiffness(const BearingSolution& s) { return s.state.coefficients.stiffness.topLeftCorner<2, 2>(); }
Eigen::Matrix2d damping(const BearingSolution& s) { return s.state.coefficients.damping.topLeftCorner<2, 2>(); }

void check_same(const Eigen::Matrix2d& found, const Eigen::Matrix2d& expected, double tolerance) {
  CAPTURE(found);
  CAPTURE(expected);
  CHECK((found - expected).cwiseAbs().maxCoeff() < tolerance * expected.cwiseAbs().maxCoeff());
}

// floating_ring.json of the independent solution: W = 40 N, shear over the whole gap.
TEST_CASE("FloatingRing_MatchesAnIndependentSolution") {
  const BearingSolution found = ring_with({"load=40 N", "around=120", "axial=17"});
  const RingState& ring = *found.pads->ring;
  constexpr double of_grid = 1e-3;  // of the reference's grids and these
  CHECK(ratio_of(found) == relative(0.18897253).epsilon(of_grid));
  CHECK(ring.films[0].e.norm() / 20e-6 == relative(0.19974690).epsilon(of_grid));
  CHECK(ring.films[1].e.norm() / 40e-6 == relative(0.54734594).epsilon(of_grid));
  CHECK(-ring.films[0].film.torque_journal == relative(0.014613448).epsilon(of_grid));
  CHECK(ring.films[1].film.torque_shell == relative(0.013770332).epsilon(of_grid));
  CHECK(ring.films[0].film.power_film + ring.films[1].film.power_film == relative(87.680689).epsilon(of_grid));
}

TEST_CASE("RingInAMachine_IsThatByItself") {
  std::string machine = ring_model;
  machine.replace(machine.find("    lubricant: cool"), 4, "    shell: ground\n    journal: shaft\n    ");
  machine += R"(bodies: {shaft: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}
joints: {shaft: {type: planar, between: [ground, shaft], axis: z}}
drives: {motor: {joint: shaft, coordinate: rotation, speed: 6000 rad/s}}
forces: {load: {type: force, body: shaft, components: [0 N, -8 N, 0 N]}}
simulation: {analysis: steady}
)";
  const BearingSolution alone = ring_with({}, machine);
  const run::SteadyMotion motion = run::find_steady_motion(model::read_text(machine, "m.yaml"));
  REQUIRE_MESSAGE(motion.solved(), motion.message);
  const RingState& ring = *alone.pads->ring;
  constexpr double solved_for = 1e-6;  // the steady motion is found to 1e-9
  CHECK(motion.bearings.at(1).position.speed == relative(ring.speed).epsilon(solved_for));
  CHECK(motion.bearings[0].film.h_min == relative(ring.films[0].film.h_min).epsilon(solved_for));
  CHECK(motion.bearings[1].film.power_film == relative(ring.films[1].film.power_film).epsilon(solved_for));
}

// (rings.2): mu omega R^3 L/c on either side.
TEST_CASE("ConcentricRing_RotatesByTheClosedForm") {
  const double outer = 12e-3 * std::pow(8.5, 3) * 9 / 40, inner = 8e-3 * std::pow(5.5, 3) * 7 / 20;
  for (const char* speed : {"s=6000 rad/s", "s=-600 rad/s"})
    CHECK(ratio_of(ring_with({"load=none", "ratio=0", speed})) ==
          relative(1 / (1 + outer / inner)).epsilon(1e-6));  // the steady motion is found to 1e-9
}

TEST_CASE("SameRing_HasTheSameNumbersTurnedAndMirrored") {
  constexpr double solved_for = 1e-6;  // equations are solved to 1e-8 and better
  const BearingSolution one = ring_with({}), turned = ring_with({"a=90 deg"}), mirrored = ring_with({"s=-6000 rad/s"});
  for (const BearingSolution* other : {&turned, &mirrored}) {
    CHECK(ratio_of(*other) == relative(ratio_of(one)).epsilon(solved_for));
    CHECK(other->pads->ring->journal.norm() == relative(one.pads->ring->journal.norm()).epsilon(solved_for));
  }
  check_same(turned.state.coefficients.stiffness, one.state.coefficients.stiffness, 1e-5);  // fronts of films
  const Eigen::Vector2d mirror(-1, 1);                                                      // the load's line stays
  check_same(damping(mirrored), mirror.asDiagonal() * damping(one) * mirror.asDiagonal(), 1e-5);  // likewise
}

// For slow motions stiffness is the difference of forces, ring and its speed following; and their limit is that of
// small frequencies.
TEST_CASE("SlowStiffnessOfARing_IsTheDifferenceOfForces") {
  const std::vector<std::string> full{"load=none", "cavitation=full_film"};
  const auto at = [&](double x, double y, const char* nu) {
    std::vector<std::string> overrides = full;
    overrides.insert(overrides.end(), {fmt::format("ratio={:.17g}", std::hypot(x, y)),
                                       fmt::format("a={:.17g} rad", std::atan2(y, x)), nu});
    return ring_with(overrides);
  };
  constexpr double c = 60e-6, d = 1e-5;  // of c, the sum of both clearances
  const auto force = [&](double x, double y) { return Eigen::Vector2d(at(x, y, "nu=1").state.load); };
  Eigen::Matrix2d K;
  K.col(0) = (force(0.3 + d, 0.1) - force(0.3 - d, 0.1)) / (2 * d * c);
  K.col(1) = (force(0.3, 0.1 + d) - force(0.3, 0.1 - d)) / (2 * d * c);
  const BearingSolution slow = at(0.3, 0.1, "nu=0");
  check_same(stiffness(slow), K, 1e-4);  // of differences
  const BearingSolution slower = at(0.3, 0.1, "nu=1e-5");
  check_same(stiffness(slower), stiffness(slow), 1e-5);  // of second order in the frequency
  check_same(damping(slower), damping(slow), 1e-5);      // likewise
}

// A locked ring on springs is a plain bearing in series with a damper's film, the springs and the ring's inertia,
// (rings.5).
TEST_CASE("LockedRing_IsAPlainBearingInSeriesWithADamper") {
  constexpr double k = 1e6, mass = 5e-3, omega = 6000;
  std::string parts = ring_model + R"(  plain: {diameter: 11 mm, width: 7 mm, radial_clearance: 20 um, lubricant: warm,
          grid: {circumferential: 72, axial: 11}, cavitation: full_film, supply: {line: widest_gap}, shear_force: torque_only,
          operating_point: {journal_speed: 6000 rad/s, load: 8 N}}
  damper: {kind: squeeze_film_damper, diameter: 17 mm, width: 9 mm, radial_clearance: 40 um, lubricant: cool,
           grid: {circumferential: 72, axial: 11}, cavitation: full_film, supply: {line: widest_gap}, shear_force: torque_only,
           operating_point: {whirl_speed: 6000 rad/s, eccentricity_ratio: 0.2}}
)";
  // Without lines of supply, whose places between the grid's lines matter.
  for (std::size_t at = parts.find(", supply: {line"); at != std::string::npos; at = parts.find(", supply: {line"))
    parts.erase(at, std::string(", supply: {line: widest_gap}").size());
  const std::vector<std::string> full{"cavitation=full_film",
                                      "bearings.main.ring={rotation: locked, centring_stiffness: 1e6 N/m, mass: 5 g}"};
  const BearingSolution locked = ring_with(full, parts), plain = ring_with(full, parts, "plain"),
                        damper = ring_with(full, parts, "damper");
  constexpr double solved_for = 1e-6;  // equations are solved to 1e-8 and better
  CHECK(locked.pads->ring->centre.norm() == relative(8 / k).epsilon(solved_for));
  CHECK((locked.pads->ring->films[0].e - Eigen::Vector2d(plain.state.e)).norm() < solved_for * 20e-6);
  const std::complex<double> i(0, 1);
  const Eigen::Matrix2cd inner = stiffness(plain) + i * omega * damping(plain);
  const Eigen::Matrix2cd below =
      i * omega * damping(damper) + (k - omega * omega * mass) * Eigen::Matrix2cd::Identity();
  const Eigen::Matrix2cd both = inner - inner * (inner + below).inverse() * inner;
  check_same(stiffness(locked), both.real(), 1e-4);        // means over places of the grid's lines, and one place
  check_same(damping(locked), both.imag() / omega, 1e-4);  // likewise
}

}  // namespace floating_ring_study_test
}  // namespace hersey::study
