// Published motions of elastic machines at steps far too long for their fastest vibrations (docs/decisions/0020).
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace large_steps_test {

/// Simo and Vu-Quoc's beam in free flight: EA = GA = 1e4, EI = 500, rho A = 1, rho I = 10, 10 long, with a force and a
/// moment at its first node. In the plane (1986) 8 and -80 until 2.5 s; in space (1988) 20 and 200 about two axes at
/// the peak of a triangle that ends at 5 s.
std::string flying_beam(bool in_space, double step, double spectral_radius) {
  const std::string triangle = "(t <= 2.5 ? {0}*t : (t <= 5 ? {0}*(5 - t) : 0))";
  const auto term = [&](double size, const char* unit) {
    return fmt::format("{{expression: \"{}\", unit: {}}}",
                       in_space ? fmt::format(fmt::runtime(triangle), size) : fmt::format("t <= 2.5 ? {} : 0", size),
                       unit);
  };
  return fmt::format(
      R"(hersey: 1
bodies:
  rod:
    beam:
      points: [0 0 0 m, 10 0 0 m]
      section:
        properties: {{area: 1 m^2, shear_y: 2 m^2, shear_z: 2 m^2, I_y: 0.05 m^4, I_z: 0.05 m^4, J: 0.1 m^4}}
        rotary_inertia: {{xx: 20 kg.m, yy: 10 kg.m, zz: 10 kg.m}}
      material: {{youngs_modulus: 10000 Pa, poisson_ratio: 0, density: 1 kg/m^3}}
      elements: 10
joints:
  p: {}
forces:
  f: {{type: force, body: rod, components: [{}, 0 N, 0 N]}}
  m: {{type: torque, body: rod, components: [0 N.m, {}, {}]}}
simulation: {{duration: {} s, step: {} ms, spectral_radius: {}}}
)",
      in_space
          ? "{type: free, between: [ground, rod], initial: {position: 6 0 0 m, orientation: 0 0 2.214297435588181 rad}}"
          : "{type: planar, between: [ground, rod], axis: z, initial: {x: 6 m, rotation: 2.214297435588181 rad}}",
      term(8, "N"), in_space ? term(80, "N.m") : "0 N.m", term(in_space ? 80 : -80, "N.m"), in_space ? 5.2 : 3, step,
      spectral_radius);
}

TEST_CASE("FlyingBeam_HasTheWorkOfItsLoadsAtAnyStep") {
  for (const bool in_space : {false, true})
    for (const double step : {10.0, 40.0})
      for (const double rho : {0.5, 1.0}) {
        CAPTURE(in_space);
        CAPTURE(step);
        CAPTURE(rho);
        const TemporaryDirectory folder;
        const Summary summary =
            simulate(model::read_text(flying_beam(in_space, step, rho), "m.yaml"), {.results = folder / "r.h5"});
        REQUIRE(summary.status == Status::completed);
        CHECK(summary.rejected_steps == 0);
        // Nothing gained but the tolerance of Newton's method; lost what the method damps, 2.4 % at the most.
        CHECK(summary.energy.stored < 1.0001 * summary.energy.put_in);
        CHECK(summary.energy.stored > (step > 10 ? 0.97 : 0.998) * summary.energy.put_in);
      }
}

TEST_CASE("StiffPendulum_KeepsItsEnergyForThirtySeconds") {
  // A mass of 10 kg on a bar of EA = 1e10 N, 3.0443 m long, thrown at 7.72 m/s (Kuhl and Crisfield 1999; Bathe 2007):
  // 298 J, twelve revolutions, the bar vibrates 2900 times a second.
  for (const double step : {5.0, 10.0, 20.0}) {
    CAPTURE(step);
    const TemporaryDirectory folder;
    const Summary summary = simulate(model::read_text(fmt::format(R"(hersey: 1
bodies:
  m: {{mass: 10 kg, inertia: {{xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.1 kg.m^2}}}}
joints:
  p: {{type: planar, between: [ground, m], axis: z, initial: {{x: 3.0443 m, y_rate: 7.72 m/s}}}}
forces:
  s: {{type: spring_damper, between: [ground, m], stiffness: 3284827382.32 N/m, free_length: 3.0443 m}}
simulation: {{duration: 30 s, step: {} ms, spectral_radius: 0.8}}
)",
                                                                  step),
                                                      "m.yaml"),
                                     {.results = folder / "r.h5"});
    REQUIRE(summary.status == Status::completed);
    CHECK(summary.rejected_steps == 0);
    const double lost = -summary.energy.stored / 298;
    CHECK(lost >= 0);
    CHECK(lost < 2e-5 * step * step / 4);  // .14 % at 20 ms: second order
    const results::Reader reader(folder / "r.h5");
    const std::vector<double> q = reader.read("/joints/p/coordinates").values;
    for (std::size_t i = 0; i < q.size(); i += 3)
      CHECK(std::hypot(q[i], q[i + 1]) == doctest::Approx(3.0443).epsilon(1e-5));  // 6e-8 m stretch it
  }
}

}  // namespace large_steps_test
}  // namespace hersey::run
