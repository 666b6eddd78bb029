#include <cmath>
#include <limits>
#include <numbers>

#include "answers_support.h"
#include "hersey/model/read.h"

namespace hersey::workbench {
namespace answers_scene_test {

std::size_t bodies_in(const Json& scene) {
  std::size_t count = 0;
  for (const auto& [path, dataset] : scene["datasets"].items())
    if (path.starts_with("/bodies/") && path.ends_with("/position")) ++count;
  return count;
}

TEST_CASE("EveryExample_HasNoFaultAndAllItsPartsInTheScene") {
  const Answers answers(examples_folder());
  REQUIRE(example_models().size() > 30);
  for (const std::string& path : example_models()) {
    CAPTURE(path);
    Json request = example_request(path);
    request["depth"] = "text";
    const Json answer = Json::parse(answers.check(request.dump()));
    const model::Model model = model::read(examples_folder() + "/" + path);
    CHECK(answer["faults"].empty());
    const Json& scene = answer["scene"];
    REQUIRE(scene.is_object());
    CHECK(scene["open"] == "");
    CHECK(bodies_in(scene) == model.bodies.size());
    CHECK(scene["bearings"].size() == model.bearings.size());
    const int lines = static_cast<int>(lines_of(request["text"]).size());
    for (const model::Body& body : model.bodies) {
      CAPTURE(body.name);
      CHECK(scene["attributes"].contains("/bodies/" + body.name));
      REQUIRE(scene["sources"].contains("/bodies/" + body.name));
      const Json& source = scene["sources"]["/bodies/" + body.name];
      CHECK(source["line"] >= 1);
      CHECK(source["endLine"] >= source["line"]);
      CHECK(source["endLine"] <= lines);
    }
    for (const model::Joint& joint : model.joints) CHECK(scene["sources"].contains("/joints/" + joint.name));
    for (const model::Bearing& bearing : model.bearings) {
      CHECK(scene["sources"].contains("/bearings/" + bearing.name));
      const Json& film = scene["bearings"][bearing.name];
      CHECK(film["grid"]["along"].size() == static_cast<std::size_t>(bearing.film.grid.n_phi));
      CHECK(film["features"].size() == bearing.film.features.size());
    }
  }
}

TEST_CASE("Sources_AreTheLinesOfTheirParts") {
  const Json request = example_request("slider_crank/model.yaml");
  const Json scene = Json::parse(Answers(examples_folder()).check(request.dump()))["scene"];
  const std::vector<std::string> lines = lines_of(request["text"]);
  for (const auto& item : scene["sources"].items()) {
    const std::string path = item.key();
    const Json& source = item.value();
    const std::string name = path.substr(path.rfind('/') + 1);
    const std::string& line = lines[source["line"].get<std::size_t>() - 1];
    CAPTURE(path);
    CHECK(line.substr(source["column"].get<std::size_t>() - 1).starts_with(name + ":"));
  }
}

Json move_of(const std::string& path, const std::string& joint, double value) {
  Json request = example_request(path);
  request["joint"] = joint, request["value"] = value;
  return Json::parse(Answers(examples_folder()).move(request.dump()));
}

double distance(const Json& a, const Json& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum = std::hypot(sum, a[i].get<double>() - b[i].get<double>());
  return sum;
}

constexpr double kRoundOff = 1e-12;  // of the assembly: a relative residual of 1e-12 of lengths below 1 m

TEST_CASE("MoveToWhereTheJointIs_ChangesNothing") {
  const Json start = move_of("four_bar/model.yaml", "main", 0);
  const double there = start["joints"]["pin"][0]["value"];
  const Json same = move_of("four_bar/model.yaml", "pin", there);
  CHECK(same["bodies"] == start["bodies"]);
}

TEST_CASE("Move_ClosesLoopsAndReachesItsValue") {
  for (const double value : {-3.0, -0.4, 0.2, 1.5, 7.0}) {
    const Json moved = move_of("four_bar/model.yaml", "main", value);
    CHECK(moved["residual"] < kRoundOff);
    CHECK(moved["joints"]["main"][0]["value"].get<double>() == doctest::Approx(value).epsilon(kRoundOff));
  }
}

TEST_CASE("MoveByARevolution_LeadsBack") {
  // Loops stay on their branch all the way round.
  const Json start = move_of("four_bar/model.yaml", "main", 0);
  const Json round = move_of("four_bar/model.yaml", "main", 2 * std::numbers::pi);
  for (const auto& [name, pose] : start["bodies"].items())
    CHECK(distance(pose["position"], round["bodies"][name]["position"]) < 10 * kRoundOff);
}

TEST_CASE("MoveOfASlider_TurnsItsCrank") {
  // The same position from either end of the loop.
  const Json by_crank = move_of("four_bar/model.yaml", "main", 0.5);
  const double pivot = by_crank["joints"]["pivot"][0]["value"];
  const Json by_rocker = move_of("four_bar/model.yaml", "pivot", pivot);
  for (const auto& [name, pose] : by_crank["bodies"].items())
    CHECK(distance(pose["position"], by_rocker["bodies"][name]["position"]) < 1e3 * kRoundOff);  // turned by a lever
}

TEST_CASE("MoveBeyondReach_IsRefused") {
  Json request = example_request("four_bar/model.yaml");
  request["joint"] = "pivot", request["value"] = 6;
  const Answers answers(examples_folder());
  CHECK(status_of([&] { return answers.move(request.dump()); }) == 422);
  request["joint"] = "pivott";
  CHECK(status_of([&] { return answers.move(request.dump()); }) == 422);
}

}  // namespace answers_scene_test
}  // namespace hersey::workbench
