#include "hersey/report/bearing_page.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/results/error.h"
#include "temporary_directory.h"

namespace hersey::report {
namespace bearing_page_test {

using nlohmann::json;

PageFilm small_film() {
  PageFilm film;
  film.features = {{"inlet", true, 1.0, 0.002, 0.3, 0.004}};
  film.clearance = 30e-6;
  film.e = {1e-6, -2e-6};
  film.phi = Eigen::VectorXd::LinSpaced(4, 0, 3);
  film.z = Eigen::VectorXd::LinSpaced(3, -0.01, 0.01);
  for (const char* name : {"pressure", "thickness", "fill", "asperity_pressure"})
    film.fields.push_back({name, "1", "what it is", Eigen::VectorXd::Constant(12, 0.5)});
  return film;
}

PageSolution small_solution() {
  PageSolution solution;
  solution.set_solved(true);
  solution.values = {{"load", "100 N"}};
  solution.figures = {{"h_min", "film", "minimum film thickness", "um", 5.6, 0.03},
                      {"critical_mass", "stability", "critical mass", "kg", std::numeric_limits<double>::infinity(), -1,
                       "none: stable at every mass"}};
  solution.load = {0, -100};
  solution.films.push_back(small_film());
  return solution;
}

json data_of(const std::filesystem::path& path) {
  std::ostringstream stream;
  stream << std::ifstream(path).rdbuf();
  const std::string page = stream.str(), opening = R"(<script id="hersey-data" type="application/json">)";
  const std::size_t from = page.find(opening) + opening.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST_CASE("BearingPage_HoldsFiguresFeaturesAndFields") {
  const TemporaryDirectory directory;
  BearingPage page{.title = "</script> of mine", .bearing = "main", .solutions = {small_solution()}};
  page.solutions.push_back(no_answer<PageSolution>("no equilibrium"));
  page.solutions.back().label = "load = 1 MN";
  page.solutions.back().values = {{"load", "1 MN"}};
  write_html(page, directory.path() / "page.html");
  const json data = data_of(directory.path() / "page.html");
  CHECK(data["title"] == "</script> of mine");
  const json& solution = data["bearing"]["solutions"][0];
  CHECK(solution["figures"][0]["grid_error"] == 0.03);
  CHECK(solution["figures"][1]["value"].is_null());  // infinite
  CHECK(solution["figures"][1]["words"] == "none: stable at every mass");
  CHECK_FALSE(solution["figures"][0].contains("words"));
  CHECK_FALSE(solution["figures"][1].contains("grid_error"));
  REQUIRE(solution["films"].size() == 1);
  const json& film = solution["films"][0];
  CHECK(film["bearing"] == "main");
  CHECK(film["features"][0]["name"] == "inlet");
  CHECK(film["features"][0]["round"] == true);
  CHECK(film["clearance"] == 30e-6);
  CHECK(film["e"] == json{1e-6, -2e-6});
  CHECK(solution["datasets"]["/bearings/main/fields/pressure"]["shape"] == json{1, 4, 3});
  CHECK(solution["datasets"]["/bearings/main/fields/fill"]["description"] == "what it is");
  CHECK(data["bearing"]["solutions"][1]["error"] == "no equilibrium");
  CHECK(data["bearing"]["solutions"][1]["datasets"].empty());
}

TEST_CASE("BearingPage_HasTheFieldsOfEachFilmOfARing") {
  const TemporaryDirectory directory;
  BearingPage page{.title = "t", .bearing = "turbine", .solutions = {small_solution()}};
  std::vector<PageFilm>& films = page.solutions.front().films;
  films.push_back(small_film());
  films[0].name = "inner";
  films[1].name = "outer";
  films[1].fields[0].values.setConstant(7);
  write_html(page, directory.path() / "page.html");
  const json data = data_of(directory.path() / "page.html"), solution = data["bearing"]["solutions"][0];
  CHECK(solution["films"][0]["bearing"] == "turbine_inner");
  CHECK(solution["films"][1]["bearing"] == "turbine_outer");
  const json inner = solution["datasets"]["/bearings/turbine_inner/fields/pressure"],
             outer = solution["datasets"]["/bearings/turbine_outer/fields/pressure"];
  CHECK(inner["shape"] == json{1, 4, 3});
  CHECK(outer["shape"] == json{1, 4, 3});
  CHECK(inner["data"] != outer["data"]);
}

TEST_CASE("BearingPage_FaultsAreReported") {
  const TemporaryDirectory directory;
  BearingPage page{.title = "t", .bearing = "main"};
  CHECK_THROWS_AS(write_html(page, directory.path() / "page.html"), ContractError);
  page.solutions = {small_solution()};
  CHECK_THROWS_AS(write_html(page, directory.path() / "nowhere" / "page.html"), results::WriteError);
}

}  // namespace bearing_page_test
}  // namespace hersey::report
