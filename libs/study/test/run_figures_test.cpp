#include "hersey/study/run_figures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "hersey/results/writer.h"
#include "temporary_directory.h"

namespace hersey::study {
namespace run_figures_test {

constexpr int kRows = 11;

// A results file whose series are linear in time, so that the trapezoidal rule is exact; not physics, but known.
class KnownRun {
 public:
  KnownRun() {
    results::Writer writer(path());
    add(writer, "/time", "s", [](int k) { return 1e-3 * k; });
    add(writer, "/bearings/main/h_min", "m", [](int k) { return 1e-6 * (10 + std::abs(k - 7)); });
    add(writer, "/bearings/main/power_film", "W", [](int k) { return 2.0 * k; });
    add(writer, "/bearings/main/mass_balance_error", "1", [](int k) { return k == 3 ? -2e-6 : 1e-6; });
    add(writer, "/contacts/stop/friction_power", "W", [](int k) { return 4.0 * k; });
    const results::Series force = writer.series("/bearings/main/force", 3, "N", "force on the shell");
    for (int k = 0; k < kRows; ++k) force.append({3.0 * k, -4.0 * k, 0.0});
    const results::Series moft = writer.series("/bearings/main/cycles/fields/moft", 1, "m", "MOFT of a cycle");
    for (const double value : {11e-6, 12e-6}) moft.append(value);
    writer.constant("/modes/fields/frequency", std::array{40.0, 95.0}, "Hz", "natural frequency");
    writer.finish(results::Status::completed);
  }

  [[nodiscard]] std::vector<RunFigure> figures(const std::vector<std::string>& wanted = {}) const {
    return figures_of(results::Reader(path()), wanted);
  }

 private:
  [[nodiscard]] std::filesystem::path path() const { return directory_ / "run.h5"; }

  static void add(results::Writer& writer, const char* name, const char* unit,
                  const std::function<double(int)>& value) {
    const results::Series series = writer.series(name, 1, unit, "test series");
    for (int k = 0; k < kRows; ++k) series.append(value(k));
  }

  TemporaryDirectory directory_;
};

std::optional<double> value_of(const std::string& key, const std::vector<RunFigure>& figures) {
  for (const RunFigure& figure : figures)
    if (figure.key == key) return figure.value;
  return std::nullopt;
}

// A short sum, a division: a few roundings.
const double round_off = 16 * std::numeric_limits<double>::epsilon();

TEST_CASE("FiguresOfTheClosingTable_GoByTheirNames") {
  const std::vector<RunFigure> figures = KnownRun().figures();
  CHECK(value_of("bearings.main.moft", figures).value() == doctest::Approx(10e-6).epsilon(round_off));
  CHECK(value_of("bearings.main.max_force", figures) == 50);
  CHECK(value_of("bearings.main.film_loss", figures).value() == doctest::Approx(10).epsilon(round_off));
  CHECK(value_of("bearings.main.mass_balance_error.peak", figures) == -2e-6);
  // (0 + 40) W / 2 over 10 ms.
  CHECK(value_of("contacts.stop.friction_power.integral", figures).value() == doctest::Approx(0.2).epsilon(round_off));
}

TEST_CASE("FiguresOfCycles_AreThoseOfTheLast") {
  CHECK(value_of("bearings.main.cycle.moft", KnownRun().figures()) == 12e-6);
}

TEST_CASE("Modes_AreNumberedFromOne") {
  const std::vector<RunFigure> figures = KnownRun().figures();
  CHECK(value_of("modes.1.frequency", figures) == 40);
  CHECK(value_of("modes.2.frequency", figures) == 95);
  CHECK_FALSE(value_of("modes.3.frequency", figures));
}

TEST_CASE("SeriesThatAreWanted_AreSummedUpAsTheirNamesSay") {
  const std::vector<RunFigure> figures =
      KnownRun().figures({"bearings.main.force.x.max", "bearings.main.force.y.min", "bearings.main.force.1.mean",
                          "bearings.main.power_film.rms", "bearings.main.h_min.end"});
  CHECK(value_of("bearings.main.force.x.max", figures) == 30);
  CHECK(value_of("bearings.main.force.y.min", figures) == -40);
  CHECK(value_of("bearings.main.force.1.mean", figures).value() == doctest::Approx(-20).epsilon(round_off));
  // The trapezoidal rule on (2 k)^2, k = 0 to 10: 4 (385 - 50) / 10.
  CHECK(value_of("bearings.main.power_film.rms", figures).value() ==
        doctest::Approx(std::sqrt(134.0)).epsilon(round_off));
  CHECK(value_of("bearings.main.h_min.end", figures).value() == doctest::Approx(13e-6).epsilon(round_off));
}

TEST_CASE("WhatTheFileHasNot_IsNoFigure") {
  const std::vector<std::string> wanted{"bearings.main.p_max.max", "bearings.main.force.7.max", "time", "h_min.min"};
  const std::vector<RunFigure> figures = KnownRun().figures(wanted);
  for (const std::string& name : wanted) CHECK_FALSE(value_of(name, figures));
}

TEST_CASE("EachFigure_HasItsNameOnce") {
  std::vector<std::string> keys;
  for (const RunFigure& figure : KnownRun().figures({"bearings.main.moft", "bearings.main.h_min.end"}))
    keys.push_back(figure.key);
  std::sort(keys.begin(), keys.end());
  CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
}

TEST_CASE("EveryFigureOfARun_IsAmongTheNames") {
  const std::vector<std::string> names = run_figure_keys();
  for (const RunFigure& figure : KnownRun().figures()) {
    CAPTURE(figure.key);
    CHECK(is_among(figure.key, names));
  }
}

TEST_CASE("NamesOfSeries_AreKnownWithoutARun") {
  CHECK(is_of_a_series("bearings.main.force.x.max"));
  CHECK(is_of_a_series("bearings.main.h_min.rms"));
  CHECK_FALSE(is_of_a_series("bearings.main.h_min"));
  CHECK_FALSE(is_of_a_series("bearings.main.h_mni.rms"));
  CHECK_FALSE(is_of_a_series("bearings.main.h_min.median"));
}

TEST_CASE("MistypedSeries_HasOnesLikeIt") {
  const std::vector<std::string> like = series_like("bodies.shaft.positoin.x.max");
  CHECK(std::find(like.begin(), like.end(), "bodies.shaft.position.x.max") != like.end());
  CHECK(series_like("nonsense").empty());
}

TEST_CASE("Patterns_StandForOnePartOfAName") {
  CHECK(is_among("bearings.main.moft", {"bearings.<b>.moft"}));
  CHECK(is_among("thermal.T_journal.max", {"thermal.T_<body>.max"}));
  CHECK_FALSE(is_among("bearings.main.cycle.moft", {"bearings.<b>.moft"}));
  CHECK_FALSE(is_among("bearings..moft", {"bearings.<b>.moft"}));
}

}  // namespace run_figures_test
}  // namespace hersey::study
