#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "edited.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "small_rig.h"
#include "temporary_directory.h"

// Machines whose films warm lumped bodies and whose clearances follow.
namespace hersey::run {
namespace warm_machine_test {

const std::string network = R"(thermal:
  nodes:
    block: {heat_capacity: 3 J/K, temperature: 45 degC}
    shaft: {heat_capacity: 1 J/K, temperature: 40 degC}
    room: {fixed: 25 degC}
  paths:
    housing: {between: [block, room], conductance: 4 W/K}
    stub: {between: [shaft, room], conductance: 1 W/K}
simulation:
)";

const std::string nodes =
    "model: film, supply_temperature: 40 degC, layers: 3, shell: {wall: node, node: block}, journal: {wall: node, "
    "node: "
    "shaft}";
const std::string grows = ", expansion: {shell: 90e-6 1/K, journal: 12e-6 1/K}";

/// The small rig with an oil that thins, and heat.
std::string warm_rig(const std::string& thermal, const std::string& more = "") {
  const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n";
  std::string text = rig_with(line, line + "    thermal: {" + thermal + "}\n" + more);
  text = edited(text, "viscosity: 15 mPa.s", "grade: iso_vg_22, temperature: 40 degC");
  return edited(text, "simulation:\n", network);
}

std::vector<double> series(const results::Reader& file, const std::string& name) { return file.read(name).values; }

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

const std::string bearing = "/bearings/big_end/";

// The clearance moves by micrometres in milliseconds, far faster than any machine's: oil is conserved and energy
// accounted for, with the film's work on the walls.
TEST_CASE("ClearanceThatGrows_KeepsItsOil") {
  const TemporaryDirectory scratch;
  for (const char* coupling : {"monolithic", "{scheme: partitioned, acceleration: quasi_newton}"}) {
    for (const char* speed : {"3000 rpm", "-3000 rpm"}) {
      for (const char* cavitation : {"mass_conserving", "guembel"}) {
        CAPTURE(coupling);
        CAPTURE(speed);
        CAPTURE(cavitation);
        std::string text =
            warm_rig(nodes + grows, std::string("    coupling: ") + coupling + "\n    cavitation: " + cavitation +
                                        "\n    edge_pressure: 1 bar\n");
        for (int k = 0; k < 2; ++k) text = edited(text, " 3000 rpm}", std::string(" ") + speed + " }");
        const Summary summary = simulate(rig(text), {.results = scratch / "grows.h5", .overwrite = true});
        CAPTURE(summary.message);
        REQUIRE(summary.status == Status::completed);
        const results::Reader file(scratch / "grows.h5");
        const std::vector<double> c = series(file, bearing + "clearance"), T_block = series(file, "/thermal/T_block"),
                                  T_shaft = series(file, "/thermal/T_shaft"), t = series(file, "/time");
        REQUIRE(c.size() > 20);
        // At the start by the temperatures there; later by those at the end of the step before, when steps are even.
        const auto wanted = [&](std::size_t k) {
          return 34e-6 + 0.0225 * (90e-6 * (T_block[k] - 20) - 12e-6 * (T_shaft[k] - 20));
        };
        CHECK(c[0] == relative(wanted(0)).epsilon(1e-12));  // round-off
        for (std::size_t k = 2; k < c.size(); ++k) {
          const bool is_even = std::abs((t[k] - t[k - 1]) / (t[k - 1] - t[k - 2]) - 1) < 1e-6;  // round-off
          if (is_even) CHECK(c[k] == relative(wanted(k - 1)).epsilon(1e-6));  // of the lengths of both steps
        }
        CHECK(std::abs(c.back() - c[0]) > 0.3e-6);
        if (std::string(cavitation) == "mass_conserving")
          CHECK(largest(series(file, bearing + "mass_balance_error")) < 1e-9);  // round-off of a step over its flow
        // Put in less what the film's own integrals take: the residual of Newton's method on 500 N, 1e-8 of 100 W, and
        // what the grid leaves where the film ruptures.
        const std::vector<double> error = series(file, bearing + "power_error"),
                                  power = series(file, bearing + "power_film");
        CHECK(largest(error) < 0.02 * largest(power));
        CHECK(largest(series(file, bearing + "heat_balance_error")) < 1e-6);  // the film's residual
        CHECK(largest(series(file, "/thermal/heat_balance_error")) < 1e-9);   // round-off
      }
    }
  }
}

// Work of the film on growing walls counts: the balance of power is as good as that of walls at rest.
TEST_CASE("WorkOnWallsThatGrow_IsAccountedFor") {
  const TemporaryDirectory scratch;
  std::vector<double> missing;
  double work = 0;
  for (const char* capacity : {"3e6 J/K", "3 J/K"}) {
    std::string text =
        warm_rig(nodes + ", expansion: {shell: 90e-6 1/K, journal: 0 1/K}", "    edge_pressure: 20 bar\n");
    text = edited(edited(text, "pressure: 1 bar", "pressure: 20 bar"), "3 J/K", capacity);
    const Summary summary = simulate(rig(text), {.results = scratch / "w.h5", .overwrite = true});
    CAPTURE(summary.message);
    REQUIRE(summary.status == Status::completed);
    const results::Reader file(scratch / "w.h5");
    missing.push_back(largest(series(file, "/power/unexplained")));
    const std::vector<double> c = series(file, bearing + "clearance"), t = series(file, "/time");
    for (std::size_t k = 1; k < c.size(); ++k)
      work =
          std::max(work, std::abs(c[k] - c[k - 1]) / (t[k] - t[k - 1]) * 20e5 * 2 * std::numbers::pi * 0.0225 * 0.0156);
  }
  CAPTURE(work);
  CHECK(work > 0.1);
  CHECK(std::abs(missing[1] - missing[0]) < 0.2 * work);  // of films whose clearances differ by a percent at the end
}

/// The warm rig with a second film of the same kind beside the first.
std::string two_films(const std::string& thermal) {
  std::string text = warm_rig(thermal);
  const std::size_t from = text.find("  big_end:\n"), to = text.find("thermal:\n  nodes:");
  return text.insert(to, edited(text.substr(from, to - from), "  big_end:", "  other_end:"));
}

// Two bearings on one block, as one and as two bodies of half its heat each: the first is the sum of both.
TEST_CASE("BearingsShareABody") {
  const TemporaryDirectory scratch;
  const std::string text = two_films(nodes);
  const Summary both = simulate(rig(text), {.results = scratch / "both.h5"});
  CAPTURE(both.message);
  REQUIRE(both.status == Status::completed);
  const results::Reader file(scratch / "both.h5");
  const std::vector<double> into_block = series(file, "/thermal/heat_from_films_block"),
                            a = series(file, "/bearings/big_end/heat_to_shell"),
                            b = series(file, "/bearings/other_end/heat_to_shell");
  REQUIRE(into_block.size() == a.size());
  for (std::size_t k = 1; k < a.size(); ++k) {
    CHECK(into_block[k] == relative(a[k] + b[k]).epsilon(1e-9));  // round-off of sums over nodes
    CHECK(a[k] == relative(b[k]).epsilon(1e-6));                  // half the load each
  }
  CHECK(largest(series(file, "/thermal/heat_balance_error")) < 1e-9);  // round-off
}

const std::string sump_and_block =
    "model: film, supply_temperature: {node: shaft}, drains_to: shaft, layers: 3, shell: {wall: ring, outer_diameter: "
    "60 mm, ambient: {node: block}}";

// Nodes receive the heat that oil and ring give them: in steps, and over cycles, at whose end both are at the
// temperatures at which the cycle's mean heat flows through them.
TEST_CASE("SumpAndBlock_TakeWhatOilAndRingGive") {
  const TemporaryDirectory scratch;
  for (const bool cycles : {false, true}) {
    CAPTURE(cycles);
    std::string text = warm_rig(sump_and_block);
    if (cycles) text = edited(text, "  duration: \"${duration}\"\n", "  cycle: {period: 10 ms, most: 5}\n");
    const Summary summary = simulate(rig(text), {.results = scratch / "sump.h5", .overwrite = true});
    CAPTURE(summary.message);
    REQUIRE(summary.status == Status::completed);
    const results::Reader file(scratch / "sump.h5");
    const std::vector<double> sump = series(file, "/thermal/T_shaft"), supplied = series(file, bearing + "T_side");
    // Over cycles it warms by what the oil brings; in milliseconds it has but begun to, from 40 degC.
    CHECK((cycles ? sump.back() - sump.front() > 0.05 : std::abs(sump.back() - sump.front()) > 0.01));
    CHECK(supplied.back() > sump.back());
    CHECK(largest(series(file, bearing + "heat_balance_error")) < 1e-6);  // the film's residual
    CHECK(largest(series(file, "/thermal/heat_balance_error")) < 1e-9);   // round-off
    if (!cycles) CHECK(series(file, "/thermal/heat_from_films_shaft").back() > 0);
  }
}

// Whatever two films dissipate in a cycle leaves through the sump and the block that they share, once all temperatures
// are found: powers by integrals over the films, what leaves by the network's temperatures.
TEST_CASE("FilmsInOneSump_WarmItByAllTheirPower") {
  const TemporaryDirectory scratch;
  const std::string text =
      edited(edited(two_films(sump_and_block), "step: 2 deg", "step: 4 deg"), "  duration: \"${duration}\"\n",
             "  cycle: {period: 20 ms, most: 8, until_converged: 0}\n");
  const Summary summary = simulate(rig(text), {.results = scratch / "sump.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader file(scratch / "sump.h5");
  double power = 0;
  for (const char* name : {"big_end", "other_end"})
    power += series(file, std::string("/bearings/") + name + "/cycles/fields/power_film").back();
  const double room = 25, sump = series(file, "/thermal/T_shaft").back(),
               block = series(file, "/thermal/T_block").back();
  CHECK(power > 20);
  CHECK(1.0 * (sump - room) + 4.0 * (block - room) == relative(power).epsilon(1e-3));  // remainder of the last cycles
  CHECK(std::abs(sump - series(file, "/thermal/T_shaft").front()) > 1);
}

// A wall of next to no capacity takes the temperature at which it passes on what it gets, in steps of any length.
TEST_CASE("SmallCapacity_DoesNotLimitTheStep") {
  const TemporaryDirectory scratch;
  const std::string text = edited(warm_rig(nodes), "heat_capacity: 1 J/K", "heat_capacity: 1e-6 J/K");
  const Summary summary = simulate(rig(text), {.results = scratch / "small.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader file(scratch / "small.h5");
  const std::vector<double> T = series(file, "/thermal/T_shaft"), heat = series(file, "/thermal/heat_from_films_shaft");
  for (std::size_t k = 1; k < T.size(); ++k) CHECK(heat[k] == doctest::Approx(T[k] - 25).epsilon(1e-3));  // 1 W/K
  for (std::size_t k = 2; k < T.size(); ++k) CHECK(std::abs(T[k] - T[k - 1]) < 2);  // and does not ring
}

// Walls that are constant within a cycle jump at its end, by kelvins: no motion, and no squeeze of the film.
TEST_CASE("WallsThatSettleOverCycles_DoNotSqueezeTheFilm") {
  const TemporaryDirectory scratch;
  std::vector<double> loads;
  for (const char* expansion : {"", ", expansion: {shell: 12e-6 1/K, journal: 12e-6 1/K}"}) {
    std::string text = warm_rig("model: film, supply_temperature: 40 degC, layers: 3" + std::string(expansion));
    text = edited(text, "  duration: \"${duration}\"\n", "  cycle: {period: 10 ms, most: 5}\n");
    const Summary summary = simulate(rig(text), {.results = scratch / "cycles.h5", .overwrite = true});
    CAPTURE(summary.message);
    REQUIRE(summary.status == Status::completed);
    const results::Reader file(scratch / "cycles.h5");
    const std::vector<double> t = series(file, "/time"), p = series(file, bearing + "p_max"),
                              T = series(file, bearing + "T_journal");
    CHECK(largest(T) - T[0] > 2);  // they do jump
    double after_the_first = 0;
    for (std::size_t k = 0; k < t.size(); ++k)
      if (t[k] > 9.9e-3) after_the_first = std::max(after_the_first, p[k]);
    loads.push_back(after_the_first);
    if (*expansion != 0) {
      const std::vector<double> c = series(file, bearing + "clearance");
      CHECK(largest(c) - *std::min_element(c.begin(), c.end()) > 0.02e-6);  // it does move
      CHECK(largest(series(file, bearing + "mass_balance_error")) < 1e-9);  // round-off of a step over its flow
    }
  }
  CHECK(loads[1] == doctest::Approx(loads[0]).epsilon(0.1));  // of films whose clearances differ by percents
}

TEST_CASE("SeizureInARun_IsReportedWithItsTime_AndKeepsTheResults") {
  const TemporaryDirectory scratch;
  std::string text = warm_rig(nodes + ", expansion: {shell: 0 1/K, journal: 80e-6 1/K}");
  text = edited(text, "heat_capacity: 1 J/K, temperature: 40 degC", "heat_capacity: 0.3 J/K, temperature: 21 degC");
  text = edited(edited(text, "load: 500 N", "load: 20 N"), "line: widest_gap", "line: 90 deg");
  const Summary summary = simulate(rig(text, {"duration=40 ms"}), {.results = scratch / "seized.h5"});
  CAPTURE(summary.message);
  CHECK(summary.status == Status::failed);
  CHECK(summary.message.find("bearing big_end: a seizure: the clearance of 34 um closes to ") != std::string::npos);
  CHECK(summary.message.starts_with("t = "));
  const results::Reader file(scratch / "seized.h5");
  const std::vector<double> c = series(file, bearing + "clearance");
  REQUIRE(c.size() > 3);
  CHECK(c.back() < c.front());
  CHECK(summary.t_results > 0);
}

// With one temperature the clearance is that of the start: the run is that of the clearance given so.
TEST_CASE("IsothermalRun_HasTheClearanceOfItsTemperature") {
  const TemporaryDirectory scratch;
  const double grown = 34e-6 + 0.0225 * (23e-6 - 12e-6) * 40;
  const std::string hot =
      warm_rig("model: isothermal, temperature: 60 degC, expansion: {shell: 23e-6 1/K, journal: 12e-6 1/K}");
  const std::string same =
      edited(warm_rig("model: isothermal, temperature: 60 degC"), "34 um", std::to_string(1e6 * grown) + " um");
  REQUIRE(simulate(rig(hot), {.results = scratch / "hot.h5"}).status == Status::completed);
  REQUIRE(simulate(rig(same), {.results = scratch / "same.h5"}).status == Status::completed);
  const results::Reader a(scratch / "hot.h5"), b(scratch / "same.h5");
  const std::vector<double> h = series(a, bearing + "h_min"), g = series(b, bearing + "h_min"),
                            x = series(a, bearing + "eccentricity_ratio"),
                            y = series(b, bearing + "eccentricity_ratio");
  REQUIRE(h.size() == g.size());
  // A line between nodes restrains the journal the more firmly the larger the given clearance.
  CHECK(h.back() == relative(g.back()).epsilon(1e-3));
  CHECK(x.back() == relative(y.back()).epsilon(1e-3));
  CHECK(series(a, bearing + "clearance").back() == relative(grown).epsilon(1e-12));  // round-off
}

}  // namespace warm_machine_test
}  // namespace hersey::run
