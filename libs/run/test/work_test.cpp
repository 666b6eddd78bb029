// Cost of the steps of a run: counts and parts of the computing time.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>

#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "series/work_record.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace work_test {

TEST_CASE("StepCounts_GiveMedianMeanAndMost") {
  StepCounts counts;
  CHECK(counts.per_step().most == 0);
  for (const int k : {3, 3, 2, 7}) counts.take(k);
  CHECK(counts.per_step().median == 3);
  CHECK(counts.per_step().mean == 3.75);
  CHECK(counts.per_step().most == 7);
  counts.take(2);
  counts.take(2);
  CHECK(counts.per_step().median == 2.5);  // 2 2 2 3 3 7
}

TEST_CASE("Work_SharesAddUpToTheTimeOfTheSteps") {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(rig(), {.results = scratch / "r.h5"});
  REQUIRE(summary.status == Status::completed);
  const Work& work = summary.work;
  double sum = 0;
  for (const WorkPart& part : work.parts) {
    CAPTURE(part.name);
    CHECK(part.seconds > -1e-6);
    sum += part.seconds;
  }
  CHECK(sum == doctest::Approx(work.stepping));
  CHECK(work.start_up > 0);
  CHECK(work.start_up + work.stepping <= summary.wall_time);
  REQUIRE(work.parts.front().name == "film big_end");
  CHECK(work.parts.front().seconds > 0.3 * work.stepping);  // a film and two bodies
  REQUIRE(work.films.size() == 1);
  const FilmCost& film = work.films.front();
  CHECK(film.bearing == "big_end");
  CHECK(film.work.total() > 0.5 * film.seconds);  // surfaces and history are less than the equations
  CHECK(film.work.total() <= film.seconds);
  CHECK(film.work.evaluations >= summary.newton_iterations + summary.steps);
  CHECK(film.work.factorisations <= film.work.evaluations);
  CHECK(work.newton_iterations.mean == doctest::Approx(static_cast<double>(summary.newton_iterations) / summary.steps));
}

TEST_CASE("Work_IsInTheResultsFile") {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(rig(), {.results = scratch / "r.h5"});
  const results::Reader reader(scratch / "r.h5");
  CHECK(reader.number_attribute("/timing", "stepping") == summary.work.stepping);
  CHECK(reader.number_attribute("/timing", "steps") == summary.steps);
  CHECK(reader.number_attribute("/timing", "newton_iterations_median") == summary.work.newton_iterations.median);
  const std::vector<std::string> names = reader.list_attribute("/timing", "part_names");
  REQUIRE(names.size() == summary.work.parts.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    CHECK(reader.number_attribute("/timing/parts", names[i]) == summary.work.parts[i].seconds);
  CHECK(reader.text_attribute("/timing/couplings/big_end", "scheme") == "monolithic");
  const FilmCost& film = summary.work.films.front();
  CHECK(reader.number_attribute("/timing/films/big_end", "nodes") == film.nodes);
  CHECK(reader.number_attribute("/timing/films/big_end", "seconds") == film.seconds);
  CHECK(reader.number_attribute("/timing/films/big_end", "balance") == film.work.balance);
}

TEST_CASE("Work_OfAResumedRun_IsThatOfBothParts") {
  const TemporaryDirectory scratch;
  const model::Model model = rig();
  const Summary whole = simulate(model, {.results = scratch / "whole.h5"});
  std::atomic<bool> stop{false};
  int taken = 0;
  Options options{.results = scratch / "parts.h5", .stop = &stop};
  options.on_progress = [&](const Progress&) { stop = taken++ >= whole.steps / 2; };
  const Summary first = simulate(model, options);
  REQUIRE(first.status == Status::stopped);
  const Summary both = simulate(model, {.results = scratch / "parts.h5", .resume = true});
  REQUIRE(both.status == Status::completed);
  const FilmCost &of_whole = whole.work.films.front(), &of_first = first.work.films.front(),
                 &of_both = both.work.films.front();
  CHECK(of_both.work.factorisations >= of_whole.work.factorisations);  // the second part begins anew
  CHECK(of_both.work.factorisations <= of_whole.work.factorisations + 2);
  CHECK(of_both.seconds > of_first.seconds);
}

TEST_CASE("Work_SaysHowManyExchangesACouplingTook") {
  const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n";
  const auto coupled = [&](const std::string& coupling) {
    const TemporaryDirectory scratch;
    const Summary summary =
        // Steps in which the exchange converges every time. In longer ones it does not always, and which of the next
        // ones are solved monolithically then hangs on round-off.
        simulate(rig(rig_with(line, line + "    coupling: " + coupling + "\n"), {"simulation.step=0.5 deg"}),
                 {.results = scratch / "r.h5"});
    REQUIRE(summary.status == Status::completed);
    const CouplingWork& work = summary.work.couplings.front();
    const results::Reader reader(scratch / "r.h5");
    if (work.exchanges.most > 0) {
      const std::vector<double> all = reader.read("/bearings/big_end/exchanges").values;
      CHECK(*std::max_element(all.begin() + 1, all.end()) == work.exchanges.most);
      // The first evaluation of a step is a prediction, each further one ends a Newton iteration.
      CHECK(work.exchanges.median == summary.work.newton_iterations.median);
    } else {
      CHECK_FALSE(reader.has("/bearings/big_end/exchanges"));
      // One linearisation of the film with each evaluation: a Newton iteration ends with it.
      CHECK(work.film_iterations.median == summary.work.newton_iterations.median + 1);
    }
    return work;
  };
  CHECK(coupled("monolithic").scheme == "monolithic");
  const CouplingWork quasi_newton = coupled("{scheme: partitioned, acceleration: quasi_newton}");
  CHECK(quasi_newton.scheme == "partitioned, quasi-Newton");
  CHECK(quasi_newton.exchanges.median > 2);
  CHECK(quasi_newton.film_iterations.mean > 0.5 * quasi_newton.exchanges.mean);
  const CouplingWork aitken = coupled("{scheme: partitioned, acceleration: aitken}");
  CHECK(aitken.scheme == "partitioned, Aitken");
  CHECK(aitken.exchanges.mean > quasi_newton.exchanges.mean);
}

}  // namespace work_test
}  // namespace hersey::run
