#include <cmath>
#include <limits>
#include <numbers>

#include "answers_support.h"
#include "hersey/core/spatial.h"
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

/// Place of a point of a body in ground.
Vector3 point_of(const Json& pose, const Vector3& r) {
  const auto q = pose["orientation"].get<std::vector<double>>();
  const auto p = pose["position"].get<std::vector<double>>();
  return Vector3(p[0], p[1], p[2]) + Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * r;
}

TEST_CASE("MoveOfACrank_TakesTheRodOfItsFilmAlong") {
  const Json start = move_of("slider_crank/model.yaml", "main", 0);
  const Vector3 big_end(0, -0.14, 0), pin(0, 0.04, 0);
  const auto apart = [&](const Json& moved) {
    return (point_of(moved["bodies"]["rod"], big_end) - point_of(moved["bodies"]["crank"], pin)).norm();
  };
  for (const double angle : {0.6, -1.2, 3.0, 6.3}) {
    const Json moved = move_of("slider_crank/model.yaml", "main", angle);
    CHECK(moved["residual"] < kRoundOff);
    CHECK(std::abs(apart(moved) - apart(start)) < 10 * kRoundOff);
    // Closed form of the slider-crank.
    const double r = 0.04, l = 0.14, s = r * std::sin(angle);
    const double height = r * std::cos(angle) + std::sqrt(l * l - s * s);
    CHECK(moved["bodies"]["piston"]["position"][1].get<double>() == doctest::Approx(height).epsilon(100 * kRoundOff));
    CHECK(moved["joints"]["wrist"][0]["value"].get<double>() ==
          doctest::Approx(-std::asin(s / l)).epsilon(100 * kRoundOff));
  }
}

TEST_CASE("MoveOfAPiston_TurnsTheCrankThroughTheFilm") {
  const Json by_crank = move_of("slider_crank/model.yaml", "main", 0.5);
  const Json by_piston = move_of("slider_crank/model.yaml", "bore", by_crank["joints"]["bore"][0]["value"]);
  // Either way round: the top, where the run starts, is the fork of both.
  CHECK(std::abs(by_piston["joints"]["main"][0]["value"].get<double>()) ==
        doctest::Approx(0.5).epsilon(1e4 * kRoundOff));  // turned by a lever
}

TEST_CASE("MoveOfEveryExample_KeepsItClosed") {
  const Answers answers(examples_folder());
  for (const std::string& path : example_models()) {
    CAPTURE(path);
    Json request = example_request(path);
    request["depth"] = "text";
    const Json joints = Json::parse(answers.check(request.dump()))["scene"]["joints"];
    int moving = 0, all = 0;
    for (const auto& item : joints.items()) {
      const Json& coordinates = item.value();
      if (coordinates.empty()) continue;
      ++all;
      request["joint"] = item.key(), request["coordinate"] = coordinates[0]["name"];
      request["value"] = coordinates[0]["value"].get<double>() + 1e-3;  // [rad, m]: all of them reach so far
      double residual = 0;
      // A piston at its dead centre moves nothing.
      if (status_of([&] { residual = Json::parse(answers.move(request.dump()))["residual"]; }) == 0) ++moving;
      CHECK(residual < kRoundOff);
    }
    CHECK((moving > 0) == (all > 0));
  }
}

Json scene_of(const Json& request) { return Json::parse(Answers(examples_folder()).check(request.dump()))["scene"]; }

Json load_of(const Json& scene, const std::string& name) {
  for (const Json& load : scene["loads"])
    if (load["name"] == name) return load;
  return {};
}

TEST_CASE("Loads_HaveTheirPointDirectionAndSize") {
  Json request = example_request("slider_crank/model.yaml");
  const Json gas = load_of(scene_of(request), "gas");
  CHECK(gas["body"] == "piston");
  CHECK(gas["kind"] == "force");
  CHECK(gas["direction"] == Json{0, -1, 0});
  CHECK(gas["unit"] == "N");
  CHECK(gas["value"].get<double>() > 0);
  std::string text = request["text"];
  const auto replace = [&](const std::string& old, const std::string& now) {
    REQUIRE(text.find(old) != std::string::npos);
    text.replace(text.find(old), old.size(), now);
  };
  // Turned round, twice as large, at another point: the same of the arrow.
  replace("direction: 0 -1 0", "direction: 3 4 0");
  replace("body: piston", "body: crank.pin");
  replace("scale: 4417.86 mm^2", "scale: 8835.72 mm^2");
  request["text"] = text;
  const Json other = load_of(scene_of(request), "gas");
  CHECK(other["body"] == "crank");
  CHECK(other["at"][1].get<double>() == doctest::Approx(0.04));
  CHECK(other["direction"][0].get<double>() == doctest::Approx(0.6));
  CHECK(other["direction"][1].get<double>() == doctest::Approx(0.8));
  CHECK(other["value"].get<double>() == doctest::Approx(2 * gas["value"].get<double>()));
}

TEST_CASE("Loads_ThatBeginWithNothingShowTheirLargest") {
  Json request = example_request("slider_crank/model.yaml");
  const std::string text = request["text"];
  const std::size_t from = text.find("    magnitude:"), to = text.find("    axes: ground");
  REQUIRE(from < to);
  const auto with = [&](const std::string& lines) {
    request["text"] = text.substr(0, from) + lines + text.substr(to);
    return load_of(scene_of(request), "gas");
  };
  const Json constant = with("    magnitude: 300 N\n");
  CHECK(constant["when"] == "always");
  CHECK(constant["value"] == 300);
  const Json wave = with("    magnitude: {expression: \"-300*sin(t*1000)\", unit: N}\n");
  CAPTURE(wave.dump());
  CHECK(wave["when"] == "largest");
  CHECK(wave["value"].get<double>() == doctest::Approx(300).epsilon(1e-3));  // sampled
}

TEST_CASE("FramesAndCircuit_AreWhatTheTextSays") {
  const Json scene = scene_of(example_request("slider_crank/model.yaml"));
  CHECK(scene["frames"]["rod"][0]["name"] == "big_end");
  CHECK(scene["frames"]["rod"][0]["position"][1].get<double>() == doctest::Approx(-0.14));
  CHECK(scene["sources"].contains("/bodies/rod/frames/big_end"));
  CHECK(scene["sources"].contains("/gravity"));
  const Json oil = scene_of(example_request("oil_circuit/model.yaml"));
  const Json& circuit = oil["circuit"];
  CHECK(circuit["nodes"].size() == 4);
  CHECK(circuit["nodes"][0]["pressure"] == 0);
  CHECK(!circuit["nodes"][1].contains("pressure"));
  CHECK(circuit["elements"] == Json{"pump", "relief", "drilling", "jet"});
  CHECK(oil["attributes"]["/circuit"]["element_pump"] == Json{"pump", "sump", "gallery"});
  CHECK(circuit["feeds"].size() == 2);
  CHECK(oil["sources"].contains("/circuit/elements/jet"));
  CHECK(oil["sources"].contains("/circuit/nodes/gallery"));
  // A function of time is shown as it begins; one of anything else is a fault, and nothing is drawn.
  Json request = example_request("oil_circuit/model.yaml");
  const std::string text = request["text"];
  const auto sump = [&](const std::string& pressure) {
    const std::string from = "pressure: 0 bar";
    request["text"] = std::string(text).replace(text.find(from), from.size(), "pressure: " + pressure);
    const Json scene = scene_of(request);
    return scene.is_null() ? scene : scene["circuit"]["nodes"][0]["pressure"];
  };
  CHECK(sump("{expression: 2 + t, unit: bar}") == 2e5);
  CHECK(sump("{expression: 2 + turning.rotation, unit: bar}").is_null());
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
