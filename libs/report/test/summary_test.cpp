#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hersey/report/report.h"
#include "small_run.h"

namespace hersey::report {
namespace summary_test {

const SummaryRow& find(const std::vector<SummaryRow>& rows, const std::string& name) {
  for (const SummaryRow& row : rows)
    if (row.name == name) return row;
  throw std::runtime_error("no row " + name);
}

std::vector<SummaryRow> summary_of(const SmallRun& run) {
  const TemporaryDirectory directory;
  run.write(directory / "run.h5");
  return summary_table({directory / "run.h5"});
}

// Values pass through one multiplication or a short sum: a few roundings.
const double round_off = 16 * std::numeric_limits<double>::epsilon();

TEST_CASE("Extremes_HaveInstantAndLocation") {
  const auto rows = summary_of({});
  const SummaryRow& moft = find(rows, "minimum film thickness (MOFT)");
  CHECK(moft.run == "run");
  CHECK(moft.group == "big_end");
  CHECK(moft.value == doctest::Approx(10).epsilon(round_off));
  CHECK(moft.unit == "µm");
  CHECK(moft.where == "t = 7 ms, crank 126.0°, φ = 70.0°, z = -7.80 mm");
  const SummaryRow& pofp = find(rows, "peak film pressure (POFP)");
  CHECK(pofp.value == doctest::Approx(5).epsilon(round_off));
  CHECK(pofp.where == "t = 4 ms, crank 72.0°");
}

TEST_CASE("PlaceOfAnExtreme_IsNoSideOfASkirt") {
  for (const SummaryRow& row : summary_of({})) {
    CAPTURE(row.name);
    CHECK(!row.name.ends_with(" side"));
  }
}

TEST_CASE("Load_IsTheLongestForceVector") {
  CHECK(find(summary_of({}), "largest load").value == doctest::Approx(50).epsilon(round_off));
}

TEST_CASE("Means_AreOverTime") {
  const auto rows = summary_of({});
  CHECK(find(rows, "mean power loss in the film").value == doctest::Approx(5).epsilon(round_off));
  CHECK(find(rows, "mean side flow, left").value == doctest::Approx(300).epsilon(round_off));
}

TEST_CASE("WorstBalanceError_IsTheLargestInSize") {
  const auto rows = summary_of({});
  const SummaryRow& row = find(rows, "largest residual power of the equations of motion");
  CHECK(row.value == -2e-6);
  CHECK(row.unit == "W");
  // The largest power of the run is 40 W, put in by the loads.
  CHECK(find(rows, "the same, share of the largest power").value == doctest::Approx(5e-8).epsilon(round_off));
}

TEST_CASE("DifferencesOfCycles_AreReportedFromTheSecondOn") {
  const TemporaryDirectory directory;
  {
    results::Writer writer(directory / "run.h5");
    const results::Series time = writer.series("/time", 1, "s", "test series");
    const results::Series end = writer.series("/cycles/fields/time", 1, "s", "test series");
    const results::Series change = writer.series("/cycles/fields/change", 1, "1", "test series");
    time.append(0), time.append(0.06);
    const std::array<double, 3> changes{std::nan(""), 0.25, 0.004};
    for (std::size_t k = 0; k < changes.size(); ++k) {
      end.append(0.02 * static_cast<double>(k + 1));
      change.append(changes[k]);
    }
    writer.finish(results::Status::completed);
  }
  const auto rows = summary_table({directory / "run.h5"});
  CHECK(find(rows, "cycles").value == 3);
  const SummaryRow& third = find(rows, "cycle 3: change from the one before");
  CHECK(third.value == doctest::Approx(0.4).epsilon(round_off));
  CHECK(third.unit == "%");
  CHECK(third.where == "ended at t = 0.06 s");
  CHECK(find(rows, "cycle 2: change from the one before").value == doctest::Approx(25).epsilon(round_off));
  CHECK_THROWS(find(rows, "cycle 1: change from the one before"));
}

void write_cycles(const std::filesystem::path& path, double complete, double contact) {
  results::Writer writer(path, {.overwrite = true});
  const std::string bearing = "/bearings/big_end/", cycles = bearing + "cycles/fields/";
  const results::Series time = writer.series("/time", 1, "s", "test series");
  const std::vector<std::pair<std::string, double>> rows{
      {"begin", 0.02},          {"end", 0.04},
      {"complete", complete},   {"energy_film", 3},
      {"energy_asperity", 0.5}, {"power_film", 150},
      {"power_asperity", 25},   {"moft", 2e-6},
      {"moft_time", 0.03},      {"moft_phi", 0.5},
      {"moft_z", 1e-3},         {"contact", contact},
      {"contact_time", 0.025},  {"contact_phi", 1.5},
      {"contact_z", 0},         {"friction_mean_effective_pressure", 7000}};
  writer.constant(bearing + "fields/phi", std::vector<double>{0, 1.5, 3}, "rad", "bearing angle");
  writer.constant(bearing + "fields/z", std::vector<double>{-0.01, 0.01}, "m", "axial position");
  for (const auto& [name, value] : rows) {
    const results::Series series = writer.series(cycles + name, 1, "1", "test series");
    series.append(0.0);  // of the cycle before
    series.append(value);
  }
  const results::Series wear = writer.field(cycles + "wear_load", {3, 2}, "W/m^2", "wear load");
  wear.append(std::vector<double>(6, 9e9));
  wear.append(std::vector<double>{0, 1e6, 2e6, 7e6, 3e6, 0});
  for (const double t : {0.0, 0.01, 0.02, 0.03, 0.04}) time.append(t);
  writer.finish(results::Status::completed);
}

TEST_CASE("LastCycle_HasItsLossesAndLoads") {
  const TemporaryDirectory directory;
  write_cycles(directory / "run.h5", 1, 80e6);
  const auto rows = summary_table({directory / "run.h5"});
  const SummaryRow& film = find(rows, "energy lost in the film, last cycle");
  CHECK(film.value == 3);
  CHECK(film.unit == "J");
  CHECK(film.where == "t = 20 to 40 ms");
  CHECK(find(rows, "mean power loss in asperity contact, last cycle").value == 25);
  const SummaryRow& moft = find(rows, "minimum film thickness (MOFT), last cycle");
  CHECK(moft.value == doctest::Approx(2).epsilon(round_off));
  CHECK(moft.where == "t = 30 ms, φ = 28.6°, z = 1.00 mm");
  CHECK(find(rows, "largest contact pressure, last cycle").value == doctest::Approx(80).epsilon(round_off));
  const SummaryRow& friction = find(rows, "friction mean effective pressure of the skirt, last cycle");
  CHECK(friction.value == doctest::Approx(0.07).epsilon(round_off));
  CHECK(friction.unit == "bar");
  const SummaryRow& wear = find(rows, "largest wear load, last cycle");
  CHECK(wear.value == doctest::Approx(7).epsilon(round_off));
  CHECK(wear.unit == "W/mm²");
  CHECK(wear.where == "φ = 85.9°, z = 10.00 mm");
}

TEST_CASE("WholeRunWithoutContact_HasItsEnergiesOnly") {
  const TemporaryDirectory directory;
  write_cycles(directory / "run.h5", 0, 0);
  const auto rows = summary_table({directory / "run.h5"});
  CHECK(find(rows, "energy lost in asperity contact").value == 0.5);
  for (const SummaryRow& row : rows) {
    CAPTURE(row.name);
    CHECK(row.name.find("last cycle") == std::string::npos);
    CHECK(row.name.find("wear") == std::string::npos);
  }
}

TEST_CASE("MedianOfIterations_LeavesOutTheStart") {
  // 2, then ten steps of 4 and 2 alternately.
  CHECK(find(summary_of({}), "median Newton iterations per step").value == 3);
}

TEST_CASE("SingleRow_HasItsOwnValueAsMean") {
  const auto rows = summary_of({.rows = 1});
  CHECK(find(rows, "mean side flow, left").value == doctest::Approx(300).epsilon(round_off));
}

TEST_CASE("QuantitiesTheFileLacks_AreLeftOut") {
  for (const SummaryRow& row : summary_of({})) CHECK(row.name.find("supply") == std::string::npos);
}

TEST_CASE("Json_SaysTheSameAsTheTableInSi") {
  const TemporaryDirectory directory;
  SmallRun().write(directory / "run.h5");
  const auto rows = summary_table({directory / "run.h5"});
  const auto json = nlohmann::json::parse(summary_json({directory / "run.h5"}));
  REQUIRE(json.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(json[i]["name"] == rows[i].name);
    CHECK(json[i]["where"] == rows[i].where);
  }
  const auto in_si = [&](const std::string& name) {
    return *std::find_if(json.begin(), json.end(), [&](const auto& entry) { return entry["name"] == name; });
  };
  const auto in_table = [&](const std::string& name) {
    return *std::find_if(rows.begin(), rows.end(), [&](const SummaryRow& row) { return row.name == name; });
  };
  const std::string thickness = "minimum film thickness (MOFT)", force = "largest load",
                    peak = "peak film pressure (POFP)";
  CHECK(in_si(thickness)["unit"] == "m");
  // Round-off of units.
  CHECK(in_si(thickness)["value"].get<double>() == doctest::Approx(1e-6 * in_table(thickness).value).epsilon(1e-14));
  CHECK(in_si(peak)["unit"] == "Pa");
  CHECK(in_si(peak)["value"].get<double>() == doctest::Approx(1e6 * in_table(peak).value).epsilon(1e-14));
  CHECK(in_si(force)["unit"] == "N");
  CHECK(in_si(force)["value"] == in_table(force).value);
  // none of the table's own units
  for (const auto& entry : json)
    for (const char* foreign : {"µ", "MPa", "mm", "°", "ms", "mJ", "%"})
      CHECK(entry["unit"].get<std::string>().find(foreign) == std::string::npos);
}

}  // namespace summary_test
}  // namespace hersey::report
