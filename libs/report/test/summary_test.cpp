#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "hersey/report/report.h"
#include "small_run.h"

namespace hersey::report {
namespace {

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

TEST_CASE("Extremes_ComeWithInstantAndPlace") {
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
  const SummaryRow& row = find(rows, "worst power-balance error of the system");
  CHECK(row.value == -2e-6);
  CHECK(row.unit == "W");
  // The largest power of the run is 40 W, put in by the loads.
  CHECK(find(rows, "the same, share of the largest power").value == doctest::Approx(5e-8).epsilon(round_off));
}

TEST_CASE("SingleRow_HasItsOwnValueAsMean") {
  const auto rows = summary_of({.rows = 1});
  CHECK(find(rows, "mean side flow, left").value == doctest::Approx(300).epsilon(round_off));
}

TEST_CASE("QuantitiesTheFileLacks_AreLeftOut") {
  for (const SummaryRow& row : summary_of({})) CHECK(row.name.find("supply") == std::string::npos);
}

TEST_CASE("Json_SaysTheSameAsTheTable") {
  const TemporaryDirectory directory;
  SmallRun().write(directory / "run.h5");
  const auto rows = summary_table({directory / "run.h5"});
  const auto json = nlohmann::json::parse(summary_json({directory / "run.h5"}));
  REQUIRE(json.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(json[i]["name"] == rows[i].name);
    CHECK(json[i]["value"] == rows[i].value);
    CHECK(json[i]["unit"] == rows[i].unit);
    CHECK(json[i]["where"] == rows[i].where);
  }
}

}  // namespace
}  // namespace hersey::report
