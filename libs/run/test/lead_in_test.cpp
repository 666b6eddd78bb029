// Cycles on half grids before those of the run: they save cycles, and change no answer.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "edited.h"
#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "start/start.h"
#include "temporary_directory.h"
#include "time_stepping/periodic_start.h"

namespace hersey::run {
namespace lead_in_test {

// Relative change of the figures with which the cycles of these tests end.
constexpr double kTolerance = 0.002;

/// The rig under a load that changes as the crank rotates, over cycles of one revolution.
std::string rig_led_in(const std::string& lead_in, const std::string& line = "") {
  std::string text =
      rig_with("  duration: \"${duration}\"\n",
               "  cycle: {period: 360 deg, until_converged: 0.002, most: 30, lead_in: " + lead_in + "}\n");
  text = edited(text, "grid: {circumferential: 24, axial: 5}", "grid: {circumferential: 48, axial: 9}");
  text = edited(text, "components: [0 N, \"-${load}\", 0 N]",
                "direction: y, magnitude: {expression: \"-500*(1 + 0.5*sin(main.rotation))\", unit: N}");
  return line.empty() ? text : edited(text, "    supply: {line: widest_gap, pressure: 1 bar}\n", line);
}

struct Answer {
  Summary summary;
  std::vector<CycleProgress> reported;
  double start = 0;                                   ///< eccentricity ratio with which the run begins
  double h_min = 0, p_max = 0, power = 0, T_max = 0;  ///< of the last cycle
  std::vector<double> crank;                          ///< rotation of the crank at the rows [rad]
};

Answer answer_of(const std::string& text) {
  const TemporaryDirectory scratch;
  Answer answer;
  Options options{.results = scratch / "run.h5"};
  options.on_cycle = [&](const CycleProgress& cycle) { answer.reported.push_back(cycle); };
  answer.summary = simulate(rig(text), options);
  INFO(answer.summary.message);
  REQUIRE(answer.summary.status == Status::completed);
  const results::Reader reader(options.results);
  const auto last = [&](const char* name) {
    return reader.read(std::string("/bearings/big_end/cycles/fields/") + name).values.back();
  };
  answer.start = reader.read("/bearings/big_end/eccentricity_ratio").values.front();
  answer.h_min = last("moft"), answer.p_max = last("pofp"), answer.power = last("power_film");
  answer.crank = reader.read("/joints/main/coordinates").values;
  return answer;
}

/// Both have stopped where the cycle before differed by less than the tolerance; as each cycle leaves a share of the
/// difference, so that those that would follow differ by as much again at most.
void check_same_cycle(const Answer& a, const Answer& b) {
  CHECK(a.h_min == doctest::Approx(b.h_min).epsilon(2 * kTolerance));
  CHECK(a.p_max == doctest::Approx(b.p_max).epsilon(2 * kTolerance));
  CHECK(a.power == doctest::Approx(b.power).epsilon(2 * kTolerance));
}

TEST_CASE("LeadIn_SavesCyclesAndLeadsToTheSameOne") {
  const Answer plain = answer_of(rig_led_in("none")), led = answer_of(rig_led_in("half_grids"));
  check_same_cycle(plain, led);
  CHECK(plain.summary.lead_in_cycles == 0);
  CHECK(led.summary.lead_in_cycles >= 2);
  CHECK(led.summary.cycles < plain.summary.cycles);
  CHECK(led.summary.message.find("converged in cycle") == 0);
  CHECK(led.summary.message.find("cycles on half grids") != std::string::npos);
  // The run itself begins at its start, with the crank where the model puts it, and has whole cycles of its own.
  CHECK(led.crank.front() == doctest::Approx(plain.crank.front()));
  CHECK(led.crank.size() == static_cast<std::size_t>(led.summary.cycles * 180 + 1));
  CHECK(led.crank.back() - led.crank.front() == doctest::Approx(2 * M_PI * led.summary.cycles));
  CHECK(plain.start < 0.01);  // the journal stands in the middle of its bore
  CHECK(led.start > 0.1);
  const auto of_lead_in = [](const CycleProgress& cycle) { return cycle.leads_in; };
  CHECK(std::count_if(led.reported.begin(), led.reported.end(), of_lead_in) == led.summary.lead_in_cycles);
  CHECK(std::is_partitioned(led.reported.begin(), led.reported.end(), of_lead_in));
}

TEST_CASE("LeadIn_ForgetsWhereTheModelStarts") {
  const std::string text = rig_led_in("half_grids");
  check_same_cycle(answer_of(text), answer_of(edited(text, "initial: {x: 0 um}", "initial: {x: 20 um}")));
}

TEST_CASE("LeadInOfAMirroredMachine_IsMirrored") {
  const std::string text = rig_led_in("half_grids");
  std::string mirrored = edited(text, "initial: {rotation_rate: 3000 rpm}", "initial: {rotation_rate: -3000 rpm}");
  mirrored = edited(mirrored, "coordinate: rotation, speed: 3000 rpm", "coordinate: rotation, speed: -3000 rpm");
  mirrored = edited(mirrored, "sin(main.rotation)", "sin(-main.rotation)");
  const Answer a = answer_of(text), b = answer_of(mirrored);
  constexpr double round_off = 1e-6;  // of Newton's iterations to 1e-8, over some hundred steps
  CHECK(a.summary.cycles == b.summary.cycles);
  CHECK(a.start == doctest::Approx(b.start).epsilon(round_off));
  CHECK(a.h_min == doctest::Approx(b.h_min).epsilon(round_off));
}

TEST_CASE("LeadInOfAWarmFilm_BringsItsTemperatures") {
  const std::string heat =
      "    supply: {line: widest_gap, pressure: 1 bar}\n"
      "    thermal: {model: film, supply_temperature: 40 degC, layers: 3, shell: {wall: ring, outer_diameter: 60 mm, "
      "ambient: 30 degC}, journal: {wall: free}}\n";
  const auto with = [&](const char* lead_in) {
    return answer_of(edited(rig_led_in(lead_in, heat), "viscosity: 15 mPa.s", "grade: iso_vg_22"));
  };
  const Answer plain = with("none"), led = with("half_grids");
  check_same_cycle(plain, led);
  CHECK(led.summary.cycles < plain.summary.cycles);
}

TEST_CASE("LeadInOnGridsTooSmallToHalve_IsTheRunItself") {
  const std::string small =
      edited(rig_led_in("half_grids"), "{circumferential: 48, axial: 9}", "{circumferential: 20, axial: 5}");
  const Answer led = answer_of(small), plain = answer_of(edited(small, "half_grids", "none"));
  check_same_cycle(plain, led);
  CHECK(led.summary.lead_in_cycles == plain.summary.cycles);
  CHECK(led.summary.cycles == 2);  // the first repeats already; the second shows it
}

TEST_CASE("StoppedLeadIn_LeavesARunThatStarts") {
  const TemporaryDirectory scratch;
  const std::atomic<bool> stop{true};
  const Summary summary = simulate(rig(rig_led_in("half_grids")), {.results = scratch / "run.h5", .stop = &stop});
  CHECK(summary.status == Status::stopped);
  CHECK(summary.lead_in_cycles == 0);
  CHECK(summary.steps == 1);
  // Going on means to begin anew, with the lead-in.
  const Summary whole = simulate(rig(rig_led_in("half_grids")), {.results = scratch / "run.h5", .resume = true});
  CHECK(whole.status == Status::completed);
  CHECK(whole.lead_in_cycles >= 2);
}

TEST_CASE("ResumedRunBehindALeadIn_HasNoSecondOne") {
  const TemporaryDirectory scratch;
  const model::Model model = rig(rig_led_in("half_grids"));
  const Summary whole = simulate(model, {.results = scratch / "whole.h5"});
  std::atomic<bool> stop{false};
  Options options{.results = scratch / "parts.h5", .stop = &stop};
  int steps = 0;
  options.on_progress = [&](const Progress&) { stop = ++steps > 50; };
  REQUIRE(simulate(model, options).status == Status::stopped);
  std::vector<CycleProgress> reported;
  const Summary rest =
      simulate(model, {.results = scratch / "parts.h5", .resume = true, .on_cycle = [&](const CycleProgress& cycle) {
                         reported.push_back(cycle);
                       }});
  REQUIRE(rest.status == Status::completed);
  CHECK(rest.message == whole.message);
  CHECK(rest.lead_in_cycles == whole.lead_in_cycles);
  CHECK(std::none_of(reported.begin(), reported.end(), [](const CycleProgress& cycle) { return cycle.leads_in; }));
  const auto h_min = [&](const char* file) {
    return results::Reader(scratch / file).read("/bearings/big_end/h_min").values;
  };
  CHECK(h_min("whole.h5") == h_min("parts.h5"));  // to the last bit
}

TEST_CASE("StartThatIsNoneOfTheMachines_IsGivenUp") {
  const model::Model model = rig();
  model::Machine machine = model::build(model);
  solver::State state = starting_state(model, machine);
  const solver::State plain = state;
  PeriodicStart of_another{.cycles = 3, .state = plain};
  of_another.state.q.conservativeResize(plain.q.size() + 1);
  PeriodicStart outside{.cycles = 3, .state = plain};
  outside.state.q.array() += 1;  // rad and m: far beyond the bore
  for (const PeriodicStart& start : {of_another, outside}) {
    const PeriodicStart made = begin_in(start, model, machine, state);
    CHECK(made.cycles == 0);
    CHECK(made.message.find("the lead-in was given up: ") == 0);
    CHECK(state.q == plain.q);
    CHECK(state.vdot == plain.vdot);
  }
}

TEST_CASE("LeadInToCyclesThatAreAllRun_IsRefused") {
  const std::string text = edited(rig_led_in("half_grids"), "until_converged: 0.002", "until_converged: 0");
  CHECK_THROWS_WITH_AS((void)rig(text), doctest::Contains("a lead-in to cycles that are all run"), InputError);
}

}  // namespace lead_in_test
}  // namespace hersey::run
