#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>

#include "answers_support.h"
#include "hersey/session/session.h"
#include "temporary_directory.h"

namespace hersey::workbench {
namespace answers_bearing_test {

double figure(const Json& answer, const std::string& key) {
  const auto found = std::find_if(answer["figures"].begin(), answer["figures"].end(),
                                  [&](const Json& one) { return one["key"] == key; });
  REQUIRE(found != answer["figures"].end());
  return (*found)["value"];
}

Json solved(const Answers& answers, std::vector<std::string> set, const std::string& previous = "",
            bool averaged = false) {
  Json request = example_request("bearing_alone/model.yaml");
  set.emplace_back("bearings.main.grid.circumferential=60");
  set.emplace_back("bearings.main.grid.axial=13");
  request["set"] = set, request["previous"] = previous, request["averaged"] = averaged;
  return Json::parse(answers.bearing(request.dump()));
}

TEST_CASE("FromThePreviousSolution_TheAnswerIsTheSame") {
  const Answers answers(examples_folder());
  const Json first = solved(answers, {});
  REQUIRE(first["solved"] == true);
  CHECK(first["started_from"].is_null());
  const Json warm = solved(answers, {"load=2600 N"}, first["id"]), cold = solved(answers, {"load=2600 N"});
  CHECK(warm["started_from"] == first["id"]);
  CHECK(cold["started_from"].is_null());
  CHECK(warm["id"] != first["id"]);
  // Newton's method ends far below its tolerance, 1e-9 of the load.
  for (const char* key : {"eccentricity_ratio", "h_min", "p_max", "torque_journal", "load"})
    CHECK(figure(warm, key) == doctest::Approx(figure(cold, key)).epsilon(1e-9));  // tolerance of the search
  CHECK(figure(warm, "load") == doctest::Approx(2600).epsilon(1e-9));              // the same
}

TEST_CASE("Averaged_TheFiguresAreThoseOfTheCommand") {
  const Answers answers(examples_folder());
  const Json answer = solved(answers, {}, "", true);
  const session::Session session(examples_folder() + "/bearing_alone/model.yaml",
                                 {"bearings.main.grid.circumferential=60", "bearings.main.grid.axial=13"});
  const study::BearingSolution solution = session.solve_bearing(study::BearingSolver(), {.grid_error = false});
  const std::vector<study::BearingFigure> figures = study::figures_of(solution);
  REQUIRE(answer["figures"].size() == figures.size());
  for (std::size_t i = 0; i < figures.size(); ++i) {
    CHECK(answer["figures"][i]["key"] == figures[i].key);
    if (std::isfinite(figures[i].value)) CHECK(answer["figures"][i]["value"] == figures[i].value);
  }
}

TEST_CASE("FieldsAskedFor_AreThere") {
  const Answers answers(examples_folder());
  const Json solution = solved(answers, {})["solution"];
  const Json& datasets = solution["datasets"];
  CHECK(datasets["/bearings/main/fields/pressure"]["shape"] == Json{1, 60, 13});
  CHECK(datasets.contains("/bearings/main/fields/thickness"));
  CHECK_FALSE(datasets.contains("/bearings/main/fields/fill"));
}

TEST_CASE("APositionReplacesALoad") {
  const Answers answers(examples_folder());
  const Json by_load = solved(answers, {});
  const double ratio = figure(by_load, "eccentricity_ratio"), angle = figure(by_load, "eccentricity_angle");
  std::ostringstream at, towards;
  at.precision(17), towards.precision(17);
  at << "eccentricity_ratio=" << ratio, towards << "eccentricity_angle=" << angle << " deg";
  const Json by_position = solved(answers, {at.str(), towards.str()});
  CHECK(figure(by_position, "load") == doctest::Approx(figure(by_load, "load")).epsilon(1e-8));  // of the search
}

TEST_CASE("ABearingOfAMachine_IsSolvedAtAPointOfTheRequest") {
  Json request = example_request("slider_crank/model.yaml");
  request["set"] = {"load=2 kN", "bearings.big_end.operating_point.journal_speed=3000 rpm"};
  const Answers answers(examples_folder());
  CHECK(Json::parse(answers.bearing(request.dump()))["solved"] == true);
  request["set"] = Json::array();
  CHECK(status_of([&] { return answers.bearing(request.dump()); }) == 422);
  request["bearing"] = "small_end";
  CHECK(status_of([&] { return answers.bearing(request.dump()); }) == 422);
}

TEST_CASE("AfterATableHasChanged_TheModelIsReadAnew") {
  const TemporaryDirectory folder;
  const std::filesystem::path table = folder / "force.csv";
  const auto write = [&](const std::string& rows) { std::ofstream(table) << rows; };
  const auto age = [&](int hours) {
    std::filesystem::last_write_time(table, std::filesystem::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  const std::string text =
      "hersey: 1\nbodies:\n  pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}\n"
      "joints:\n  main: {type: revolute, between: [ground, pin]}\n"
      "forces:\n  push: {type: force, body: pin, direction: 1 0 0, axes: ground, magnitude: {table: {file: force.csv, "
      "x: time, y: force}}}\n"
      "simulation: {duration: 4 ms, step: 0.1 ms}\n";
  const Json request{{"path", "a.yaml"}, {"text", text}, {"joint", "main"}, {"value", 0.1}};
  const Answers answers(folder.path());
  const auto status = [&] { return status_of([&] { return answers.move(request.dump()); }); };
  const std::string good = "time [s], force [N]\n0, 1\n1, 2\n", bad = "time [s], force [N]\n0, 1\n1, x\n";
  write(good), age(3);
  CHECK(status() == 0);
  CHECK(status() == 0);
  write(bad), age(2);  // of the same size
  CHECK(status() == 422);
  write(good), age(1);
  CHECK(status() == 0);
  // Just written: a later change may have the same time.
  write(good);
  const auto now = std::filesystem::last_write_time(table);
  CHECK(status() == 0);
  write(bad);
  std::filesystem::last_write_time(table, now);
  CHECK(status() == 422);
}

TEST_CASE("MeshInfo_NamesSetsAndBores") {
  const Answers answers(examples_folder());
  std::string mesh;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples_folder() + "/meshes"))
    if (entry.path().extension() == ".inp" || entry.path().extension() == ".msh")
      mesh = entry.path().lexically_relative(examples_folder()).generic_string();
  REQUIRE(!mesh.empty());
  const Json info = Json::parse(answers.mesh_info(Json{{"path", mesh}, {"length_unit", "mm"}}.dump()));
  CHECK(info["mesh"]["nodes"] > 0);
  CHECK(info["mesh"]["sets"].is_object());
  CHECK(info["found"].is_array());
  CHECK(status_of([&] { return answers.mesh_info(R"({"path": "none.inp"})"); }) == 422);
}

}  // namespace answers_bearing_test
}  // namespace hersey::workbench
