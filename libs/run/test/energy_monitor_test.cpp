// Steps that gain energy from nowhere: rejected, and where that does not help the end of the run.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_bar.h"
#include "source_dir.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace energy_monitor_test {

using Overrides = std::vector<std::string>;

Summary run(const std::string& text, const Overrides& overrides = {}) {
  const TemporaryDirectory folder;
  return simulate(model::read_text(text, "m.yaml", overrides), {.results = folder / "r.h5"});
}

std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(source_dir()) / "examples" / name / "model.yaml";
}

/// The largest sum of kinetic, spring and strain energy, and its value at the start.
struct Energies {
  double start = 0, most = 0;
};

Energies energies_of(const std::filesystem::path& file) {
  const results::Reader reader(file);
  const auto T = reader.read("/energy/kinetic").values, U = reader.read("/energy/springs").values,
             S = reader.read("/energy/strain").values;
  Energies found{.start = T[0] + U[0] + S[0]};
  for (std::size_t i = 0; i < T.size(); ++i) found.most = std::max(found.most, T[i] + U[i] + S[i]);
  return found;
}

/// A mass that whirls on a stiff spring, in units of the given size: 5 kJ in SI.
std::string whirling_mass(double kg, double m, double s, const std::string& spring) {
  return fmt::format(R"(hersey: 1
bodies:
  m: {{mass: {0:.17g} kg, inertia: {{xx: {1:.17g} kg.m^2, yy: {1:.17g} kg.m^2, zz: {1:.17g} kg.m^2}}}}
  ground: {{frames: {{size: {{origin: {2:.17g} 0 0 m}}}}}}
joints:
  j: {{type: free, between: [ground, m], initial: {{position: {2:.17g} 0 0 m, velocity: 0 {3:.17g} 0 m/s}}}}
forces:
  s: {{type: spring_damper, between: [ground, m], {4}}}
simulation: {{duration: {5:.17g} s, step: {6:.17g} s, spectral_radius: 0.9}}
)",
                     kg, 0.01 * kg * m * m, m, 3 * m / s, spring, 20 * s, 0.2 * s);
}

std::string linear_spring(double kg, double m, double s) {
  return fmt::format("stiffness: {:.17g} N/m, free_length: {:.17g} m", 1e6 * kg / (s * s), 0.9 * m);
}

TEST_CASE("ExplodingSpring_EndsAsFailedInAnyUnits") {
  const Summary si = run(whirling_mass(1, 1, 1, linear_spring(1, 1, 1)));
  REQUIRE(si.status == Status::failed);
  CHECK(si.t_end < 1);
  CHECK(si.message.find("t = 0.2") == 0);
  CHECK(si.message.find("were lost without a sink, of late in body m, where force s acts") != std::string::npos);
  CHECK(si.message.find("give a shorter `simulation.step`") != std::string::npos);
  CHECK(si.energy.share_from_nowhere() < 0.2);
  CHECK(si.energy.available == doctest::Approx(5004.5).epsilon(1e-6));  // 4.5 J of motion, 5 kJ in the spring
  for (const auto& [kg, m, s] : {std::tuple{1e-6, 1e-3, 1e-3}, std::tuple{1e4, 30.0, 1.0}}) {
    const Summary other = run(whirling_mass(kg, m, s, linear_spring(kg, m, s)));
    CHECK(other.status == Status::failed);
    // The round-off remainder of a planned step may become one more step: one of some 65, which loses 3 %.
    CHECK(std::abs(other.steps - si.steps) <= 1);
    CHECK(std::abs(other.rejected_steps - si.rejected_steps) <= 1);
    CHECK(other.energy.error() == doctest::Approx(si.energy.error()).epsilon(0.05));
  }
}

TEST_CASE("ExplodingSpringByExpression_EndsLikeThatByStiffness") {
  for (const std::string law : {"tension: {expression: \"1e6*(length - 0.9)\", unit: N}",
                                "tension: {expression: \"1e6*(length - 0.9) + 1e8*(length - 0.9)^3\", unit: N}"}) {
    CAPTURE(law);
    const Summary summary = run(whirling_mass(1, 1, 1, law));
    CHECK(summary.status == Status::failed);
    CHECK(summary.t_end < 1);
  }
}

const std::string kOnASpring = R"(hersey: 1
gravity: 0 0 0 m/s^2
bodies:
  a: {mass: 1 kg, inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.01 kg.m^2}}
joints:
  g: {type: prismatic, between: [ground, a], axis: x, initial: {translation: 0.1 m}}
forces:
  s: {type: sliding_spring, joint: g, force: {expression: "1000*stretch + 5e4*stretch^3", unit: N}}
simulation: {duration: 2 s, step: 1 ms, spectral_radius: 1}
)";

TEST_CASE("EnergyOfASpringByExpression_IsItsIntegral") {
  const TemporaryDirectory folder;
  const Summary summary = simulate(model::read_text(kOnASpring, "m.yaml"), {.results = folder / "r.h5"});
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.rejected_steps == 0);
  CHECK(summary.energy.dampers == 0);
  const results::Reader reader(folder / "r.h5");
  const auto x = reader.read("/joints/g/coordinates").values, U = reader.read("/energy/springs").values;
  // Sums of a thousand integrals, each to round-off.
  for (std::size_t i = 0; i < U.size(); i += 50)
    CHECK(U[i] == doctest::Approx(500 * x[i] * x[i] + 1.25e4 * std::pow(x[i], 4)).epsilon(1e-11));
}

TEST_CASE("Work_OfALoadThatIsASpringIsThatOfItsPotential") {
  // The same law as a load puts in what the spring gives back: Simpson's rule is exact for it.
  const Summary spring = run(kOnASpring);
  std::string text = kOnASpring;
  text.replace(
      text.find("{type: sliding_spring"), text.find("simulation:") - text.find("{type: sliding_spring"),
      "{type: force, body: a, components: [{expression: \"-1000*g.translation - 5e4*g.translation^3\", unit: N}, "
      "0 N, 0 N]}\n");
  const Summary load = run(text);
  CHECK(load.status == Status::completed);
  CHECK(load.energy.available == doctest::Approx(6.25).epsilon(1e-3));  // put in at most the energy of the spring
  // Errors of a step's end: the rule's round-off and the tolerance of the step, 1e-8 of its forces each.
  CHECK(load.energy.from_nowhere == doctest::Approx(spring.energy.from_nowhere).epsilon(1e-6));
}

TEST_CASE("EnergyThatIsPutIn_IsNotFromNowhere") {
  const auto with = [](const std::string& force) {
    std::string text = kOnASpring;
    text.replace(text.find("{type: sliding_spring"), text.find("simulation:") - text.find("{type: sliding_spring"),
                 force + "\n");
    return run(text);
  };
  // A pendulum's swing pumped at twice its frequency, a released preload, an unstable rest.
  const Summary pumped = with(
      "{type: force, body: a, components: [{expression: \"-1000*(1 + 0.4*sin(63.2456*t))*g.translation\", unit: N}, 0 "
      "N, 0 N]}");
  CHECK(pumped.status == Status::completed);
  CHECK(pumped.energy.stored > 100);
  const Summary released =
      with("{type: sliding_spring, joint: g, force: {expression: \"stretch > 0 ? 1e4*stretch : 0\", unit: N}}");
  CHECK(released.status == Status::completed);
  const Summary fallen = with("{type: sliding_spring, joint: g, force: {expression: \"-100*stretch\", unit: N}}");
  CHECK(fallen.status == Status::completed);
  CHECK(fallen.energy.available > 1e6);
  for (const Summary* summary : {&pumped, &released, &fallen}) {
    CHECK(summary->energy.share_from_nowhere() < 0.01);
  }
}

// A ball that meets the floor within one step of 5 ms: an impact lasts 3 ms. It bounced to many times its height.
TEST_CASE("ImpactWithinAStep_PutsNothingIn") {
  const TemporaryDirectory folder;
  const model::Model model = model::read(example("ball_drop"), {"simulation.step=5 ms"});
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  const auto T = reader.read("/energy/kinetic").values, U = reader.read("/energy/potential").values,
             S = reader.read("/energy/springs").values;
  const double start = T[0] + U[0] + S[0];
  for (std::size_t i = 0; i < T.size(); ++i)
    CHECK(T[i] + U[i] + S[i] < start + 0.2 * summary.energy.available);  // allowed gain of a run
}

// Two rods on steps of a tenth of a second and less.
TEST_CASE("DoublePendulum_GainsNothingOnCoarseSteps") {
  for (const std::string step : {"20 ms", "50 ms", "100 ms"}) {
    CAPTURE(step);
    const TemporaryDirectory folder;
    const model::Model model = model::read(example("double_pendulum"), {"simulation.step=" + step});
    const Summary summary = simulate(model, {.results = folder / "r.h5"});
    const results::Reader reader(folder / "r.h5");
    const auto T = reader.read("/energy/kinetic").values, U = reader.read("/energy/potential").values;
    for (std::size_t i = 0; i < T.size(); ++i) CHECK(T[i] + U[i] < T[0] + U[0] + 0.2 * summary.energy.available);
    if (step == "20 ms") CHECK(summary.rejected_steps < 10);  // its swings of some percent are allowed
  }
}

// Four elements whose light first node takes a sudden torque: one step put in 557 J where the loads did 0.4 J.
TEST_CASE("BeamUnderASuddenTorque_HasTheEnergyOfItsLoads") {
  const Summary summary = run(R"(hersey: 1
bodies:
  rod:
    beam:
      points: [0 0 0 m, 10 0 0 m]
      section: {properties: {area: 1 m^2, shear_y: 2 m^2, shear_z: 2 m^2, I_y: 0.05 m^4, I_z: 0.05 m^4, J: 0.1 m^4}}
      material: {youngs_modulus: 10000 Pa, poisson_ratio: 0, density: 1 kg/m^3}
      elements: 4
    frames: {tip: {along: end}}
joints:
  p: {type: planar, between: [ground, rod], axis: z, initial: {x: 6 m, y: 0 m, rotation: 2.214297435588181 rad}}
forces:
  f: {type: force, body: rod, components: [{expression: "t <= 2.5 ? 8 : 0", unit: N}, 0 N, 0 N]}
  m: {type: torque, body: rod, components: [0 N.m, 0 N.m, {expression: "t <= 2.5 ? -80 : 0", unit: N.m}]}
simulation: {duration: 0.02 s, step: 5 ms, spectral_radius: 0.9}
)");
  const bool is_sound = summary.status == Status::completed && summary.energy.stored < 8;  // 5.1 J are right
  CHECK((is_sound || summary.status == Status::failed));
}

// Elastic bodies and films do not keep a step from being checked: the exploding mass beside a film and at a beam's end.
TEST_CASE("FilmsAndBeams_DoNotHideAnExplosion") {
  const std::string mass = R"(
  m: {mass: 1 kg, inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.01 kg.m^2}}
joints:
  j: {type: free, between: [ground, m], initial: {position: 1 0 0 m, velocity: 0 3 0 m/s}}
)";
  const std::string spring = R"(
forces:
  s: {type: spring_damper, between: [ground, m], stiffness: 1e6 N/m, free_length: 0.9 m}
simulation: {duration: 0.5 s, step: 5 ms, spectral_radius: 0.9}
)";
  const std::string film = R"(hersey: 1
bodies:
  pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}})" +
                           mass + R"(
  main: {type: cylindrical, between: [ground, pin], axis: z, initial: {rotation_rate: 300 rpm}}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  b:
    shell: ground
    journal: pin
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
    supply: {line: widest_gap, pressure: 1 bar}
)" + spring;
  const std::string beam = R"(hersey: 1
bodies:
  rod:
    beam:
      points: [0 0 0 m, 1 0 0 m]
      section: {properties: {area: 1e-4 m^2, shear_y: 1e-4 m^2, shear_z: 1e-4 m^2, I_y: 1e-9 m^4, I_z: 1e-9 m^4, J: 2e-9 m^4}}
      material: {youngs_modulus: 200 GPa, poisson_ratio: 0.3, density: 7800 kg/m^3}
      elements: 2)" + mass +
                           R"(
  root: {type: fixed, between: [ground, rod]}
)" + spring;
  for (const std::string& text : {film, beam}) {
    const TemporaryDirectory folder;
    const Summary summary = simulate(model::read_text(text, "m.yaml"), {.results = folder / "r.h5"});
    const Energies energies = energies_of(folder / "r.h5");
    CHECK(summary.rejected_steps > 0);
    CHECK(energies.most < 1.2 * summary.energy.available);  // allowed gain of a run; 3e7 J without the check of steps
  }
}

/// A bar that tumbles freely; `more` goes on with the model.
Summary tumble(const std::string& form, const std::string& step, const std::string& more, Energies& energies) {
  const TemporaryDirectory folder;
  write_bar(folder / "bar.inp", 4);
  std::ofstream(folder / "m.yaml") << R"(hersey: 1
bodies:
  bar:
    flexible:
      mesh: bar.inp
      length_unit: 1 mm
      material: {youngs_modulus: 20 MPa, poisson_ratio: 0.3, density: 1200 kg/m^3}
      )" + form + R"(
    frames: {root: {nodes: left}, tip: {nodes: right}}
joints:
  fly: {type: free, between: [ground, bar.root], initial: {angular_velocity: 20 -30 60 rad/s, velocity: 0 -3 0 m/s}}
)" + more +
                                          "simulation: {duration: 0.2 s, spectral_radius: 0.9, step: " + step + "}\n";
  const Summary summary = simulate(model::read(folder / "m.yaml"), {.results = folder / "r.h5"});
  energies = energies_of(folder / "r.h5");
  return summary;
}

const std::string kModal = "modes: 4", kNodal = "form: nodal\n      strain: finite";

TEST_CASE("TumblingElasticBodies_GainNothing") {
  // Half a second of revolutions at .17 to .7 rad a step; counted from their first frame they gained a seventh.
  for (const std::string& form : {kModal, kNodal})
    for (const std::string step : {"2.5 ms", "10 ms"}) {
      CAPTURE(form);
      CAPTURE(step);
      Energies energies;
      const Summary summary = tumble(form, step, "", energies);
      CHECK(summary.status == Status::completed);
      CHECK(energies.most < 1.03 * energies.start);  // vibrations that steps of this length follow badly
      CHECK(summary.energy.share_from_nowhere() < 0.02);
    }
}

TEST_CASE("ExplodingElasticBodies_EndAsFailedOrAreCut") {
  // A spring whose period of some ms steps of 10 ms do not follow holds the bar's tip: 1.25 J in it.
  for (const std::string& form : {kModal, kNodal}) {
    CAPTURE(form);
    Energies energies;
    const Summary summary =
        tumble(form, "10 ms",
               "forces:\n  s: {type: spring_damper, between: [ground, bar.tip], stiffness: 1e4 N/m, "
               "free_length: 0.064 m}\n",
               energies);
    MESSAGE(summary.message);
    CHECK(summary.rejected_steps > 0);
    CHECK(energies.most < 1.2 * summary.energy.available);  // allowed gain of a run
    if (summary.status == Status::completed) {
      CHECK(summary.energy.share_from_nowhere() < 0.2);
    } else {
      CHECK(summary.message.find("t = ") == 0);
      CHECK(summary.message.find("bar") != std::string::npos);
      CHECK(summary.message.find("give a shorter `simulation.step`") != std::string::npos);
    }
  }
}

}  // namespace energy_monitor_test
}  // namespace hersey::run
