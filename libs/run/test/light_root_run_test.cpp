// Runs whose model file begins with a light body.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "hersey/model/read.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace light_root_run_test {

/// A light body m that a bushing holds to a heavy one n, 10 m away, under a torque; joints from ground to either.
std::string pair_of_bodies(bool light_first) {
  return fmt::format(R"(hersey: 1
bodies:
  m: {{mass: 0.1 kg, inertia: {{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}}}
  n: {{mass: 1 kg, inertia: {{xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}, frames: {{a: {{origin: -10 0 0 m}}}}}}
joints:
  j: {}
  k: {{type: planar, between: {}, axis: z}}
forces:
  b: {{type: bushing, between: {}, stiffness: 1e4 1e4 1e4 N/m, rotational_stiffness: 1e3 1e3 1e3 N.m/rad}}
  t: {{type: torque, body: m, components: [0 N.m, 0 N.m, -80 N.m]}}
simulation: {{duration: 0.1 s, step: 2 ms, spectral_radius: 0.9}}
)",
                     light_first ? "{type: planar, between: [ground, m], axis: z}"
                                 : "{type: planar, between: [ground, n], axis: z, initial: {x: 10 m}}",
                     light_first ? "[m, n.a]" : "[n.a, m]", light_first ? "[m, n.a]" : "[n.a, m]");
}

TEST_CASE("LightRootBody_TakesTheStepsOfItsTwin") {
  Summary summaries[2];
  for (const bool light_first : {true, false}) {
    const TemporaryDirectory folder;
    Summary& summary = summaries[light_first ? 0 : 1];
    summary = simulate(model::read_text(pair_of_bodies(light_first), "m.yaml"), {.results = folder / "r.h5"});
    REQUIRE(summary.status == Status::completed);
  }
  // Steps are cut where the error of the light body's own vibration says so, for both alike; 18 steps and 6 J more
  // where it carries the heavy one.
  CHECK(summaries[0].rejected_steps == summaries[1].rejected_steps);
  CHECK(summaries[0].steps == summaries[1].steps);
  CHECK(summaries[0].energy.stored == doctest::Approx(summaries[1].energy.stored).epsilon(2e-3));
  CHECK(summaries[0].energy.stored < summaries[0].energy.put_in);
}

}  // namespace light_root_run_test
}  // namespace hersey::run
