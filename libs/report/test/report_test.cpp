#include "hersey/report/report.h"

#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "base64.h"
#include "hersey/core/contract.h"
#include "small_run.h"

namespace hersey::report {
namespace report_test {

using nlohmann::json;

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// What stands in the page's data element.
json data_of(const std::string& page) {
  const std::string opening = R"(<script id="hersey-data" type="application/json">)";
  const std::size_t from = page.find(opening) + opening.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// The reverse of base64_float32 and base64_float64, written apart from them.
template <class Number>
std::vector<Number> decode(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, buffer = 0;
  for (const char c : text) {
    if (c == '=') break;
    buffer = buffer << 6 | static_cast<unsigned>(alphabet.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(buffer >> (bits -= 8) & 0xff);
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

struct Page {
  TemporaryDirectory directory;
  std::string text;
  json data;

  explicit Page(const std::vector<SmallRun>& runs, const ReportOptions& options = {}) {
    std::vector<std::filesystem::path> files;
    for (const SmallRun& run : runs) {
      files.push_back(directory / ("run" + std::to_string(files.size()) + ".h5"));
      run.write(files.back());
    }
    write_html(files, directory / "report.html", options);
    text = content(directory / "report.html");
    data = data_of(text);
  }
};

TEST_CASE("Base64_MatchesKnownText") {
  // 1.0f is 00 00 80 3f, 2.0 is 00 00 00 00 00 00 00 40, both little-endian.
  CHECK(base64_float32(std::vector<double>{1.0}) == "AACAPw==");
  CHECK(base64_float64(std::vector<double>{2.0}) == "AAAAAAAAAEA=");
  CHECK(base64_float32({}).empty());
  const std::vector<double> values{-1.5, 3.25, 1e-12, 7};
  CHECK(decode<double>(base64_float64(values)) == values);
}

TEST_CASE("Report_HoldsTheNumbersOfTheRun") {
  const SmallRun run;
  const Page page({run});
  const json& shown = page.data["runs"][0];
  CHECK(shown["attributes"]["/"]["title"] == "Small run");
  CHECK(shown["attributes"]["/"]["status"] == "completed");
  CHECK(shown["assumptions"][0][0] == "cavitation");
  CHECK(shown["rows"] == 11);
  const json& thickness = shown["datasets"]["/bearings/big_end/h_min"];
  CHECK(thickness["unit"] == "m");
  const auto h = decode<float>(thickness["data"]);
  REQUIRE(h.size() == 11);
  for (int k = 0; k < 11; ++k) CHECK(h[static_cast<std::size_t>(k)] == static_cast<float>(run.h_min(k)));
  const auto time = decode<double>(shown["datasets"]["/time"]["data"]);
  CHECK(time[10] == 10 * run.dt);
  CHECK(shown["datasets"]["/bearings/big_end/fields/pressure"]["shape"] == json({11, 4, 3}));
  CHECK(shown["summary"][0]["unit"] == "µm");
}

TEST_CASE("Report_LoadsNothingFromElsewhere") {
  const Page page({SmallRun{}});
  const std::regex loads(R"re((src|href)\s*=\s*["']?\s*(https?:)?//|@import|url\(\s*["']?(https?:)?//)re",
                         std::regex::icase);
  CHECK_FALSE(std::regex_search(page.text, loads));
  CHECK(page.text.find("http-equiv=\"Content-Security-Policy\"") != std::string::npos);
}

TEST_CASE("TextThatLooksLikeMarkup_StaysText") {
  // The model's comment holds a closing script tag: escaped in the page, whole again in the data.
  const Page page({{.title = "<b>bold & \"quoted\"</b>"}});
  CHECK(page.text.find("</script> must not") == std::string::npos);
  CHECK(page.data["runs"][0]["model"] == "hersey: 1\n# </script> must not end the page\n");
  CHECK(page.data["runs"][0]["attributes"]["/"]["title"] == "<b>bold & \"quoted\"</b>");
}

TEST_CASE("LongRuns_AreThinnedButKeepTheirEnd") {
  const SmallRun run{.rows = 1000};
  const Page page({run}, {.series_rows = 301, .field_bytes = 100 * 12 * sizeof(std::uint16_t)});
  const json& shown = page.data["runs"][0];
  CHECK(shown["series_stride"] == 4);
  CHECK(shown["field_stride"] == 10);
  const auto time = decode<double>(shown["datasets"]["/time"]["data"]);
  CHECK(time.size() == 250);
  CHECK(time.back() == 999 * run.dt);
  const auto instants = decode<double>(shown["datasets"]["/bearings/big_end/fields/time"]["data"]);
  CHECK(instants.size() == 100);
  CHECK(instants.back() == 999 * run.dt);
  CHECK(shown["datasets"]["/bearings/big_end/fields/pressure"]["shape"] == json({100, 4, 3}));
  CHECK(shown["datasets"]["/bearings/big_end/fields/phi"]["shape"] == json({4}));  // a grid is not an instant
}

TEST_CASE("FieldsBeyondTheBudget_LieBesideThePage") {
  const TemporaryDirectory directory;
  const SmallRun run{.rows = 1000};
  run.write(directory / "run.h5");
  const std::filesystem::path page = directory / "page.html", file = directory / "page_fields" / "0_0.js";
  const auto shown_with = [&](std::size_t field_bytes) {
    write_html({directory / "run.h5"}, page, {.field_bytes = field_bytes});
    return data_of(content(page))["runs"][0];
  };
  CHECK(shown_with(1000 * 12 * 2)["beside"].empty());
  CHECK_FALSE(std::filesystem::exists(file));
  const json beside = shown_with(100 * 12 * 2)["beside"];
  REQUIRE(beside.size() == 1);
  CHECK(beside[0]["bearing"] == "big_end");
  CHECK(beside[0]["file"] == "page_fields/0_0.js");
  CHECK(beside[0]["instants"] == 1000);
  const std::string script = content(file);
  CHECK(beside[0]["bytes"] == script.size());
  const std::string call = "herseyFields(";
  REQUIRE(script.starts_with(call));
  const json given = json::parse(script.substr(call.size(), script.rfind(')') - call.size()));
  CHECK(given["run"] == "run");
  const json& pressure = given["datasets"]["/bearings/big_end/fields/pressure"];
  CHECK(pressure["shape"] == json({1000, 4, 3}));
  const auto low = decode<float>(pressure["low"]);
  CHECK(low[123] == static_cast<float>(run.p_max(123)));
  CHECK_FALSE(given["datasets"].contains("/bearings/big_end/fields/phi"));  // the page has the grid
}

TEST_CASE("Fields_TakeTwoBytesANumber") {
  const SmallRun run;
  const Page page({run});
  const json& pressure = page.data["runs"][0]["datasets"]["/bearings/big_end/fields/pressure"];
  CHECK(pressure["type"] == "u2");
  const auto codes = decode<std::uint16_t>(pressure["data"]);
  const auto low = decode<float>(pressure["low"]), step = decode<float>(pressure["step"]);
  REQUIRE(codes.size() == 11 * 12);
  REQUIRE(low.size() == 11);
  // Every instant's pressure is uniform: stored exactly, in the page's single precision.
  for (std::size_t k = 0; k < 11; ++k)
    CHECK(low[k] + step[k] * codes[12 * k] == static_cast<float>(run.p_max(static_cast<int>(k))));
}

TEST_CASE("Runs_TakeTheNamesGiven") {
  const Page page({{.load = "100 N"}, {.load = "2500 N"}}, {.names = {"light", "heavy"}});
  CHECK(page.data["runs"][0]["name"] == "light");
  CHECK(page.data["runs"][1]["name"] == "heavy");
  const TemporaryDirectory directory;
  SmallRun().write(directory / "run.h5");
  const std::vector<std::filesystem::path> twice{directory / "run.h5", directory / "run.h5"};
  CHECK(summary_table(twice, {"a", "b"}).back().run == "b");
  CHECK_THROWS_AS(summary_table(twice, {"a"}), ContractError);
  CHECK_THROWS_AS(summary_table(twice, {"a", "a"}), ContractError);
}

TEST_CASE("Study_ShowsEveryRunWithItsParameters") {
  const Page page({{.load = "100 N"}, {.load = "2500 N"}}, {.title = "Two loads"});
  CHECK(page.data["title"] == "Two loads");
  REQUIRE(page.data["runs"].size() == 2);
  CHECK(page.data["runs"][1]["attributes"]["/parameters"]["load"] == "2500 N");
  CHECK(page.data["runs"][0]["attributes"]["/"]["study_parameters"] == json({"load"}));
}

TEST_CASE("FailuresOfFiles_AreReportedWithThePath") {
  using Paths = std::vector<std::filesystem::path>;
  const TemporaryDirectory directory;
  CHECK_THROWS_WITH_AS(write_html(Paths{directory / "none.h5"}, directory / "r.html"),
                       doctest::Contains("no such file"), results::ReadError);
  SmallRun().write(directory / "run.h5");
  CHECK_THROWS_WITH_AS(write_html(Paths{directory / "run.h5"}, directory / "missing" / "r.html"),
                       doctest::Contains("cannot write the report: No such file or directory"), results::WriteError);
  CHECK_THROWS_WITH_AS(write_html(Paths{directory / "run.h5"}, "/dev/full"),
                       doctest::Contains("No space left on device"), results::WriteError);
  CHECK_THROWS_AS(write_html(Paths{}, directory / "r.html"), ContractError);
}

}  // namespace report_test
}  // namespace hersey::report
