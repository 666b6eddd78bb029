#include "hersey/report/instant.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "base64.h"

namespace hersey::report {
namespace instant_test {

TEST_CASE("Instant_HasEverythingThatWasWritten") {
  results::Writer writer(results::InMemory{.keeps_all = true});
  const std::vector<double> corners(60, 0.1), axis{0, 0, 1};
  writer.attribute("/", "title", "a machine");
  writer.attribute("/bodies/rod", "mass", 2);
  writer.attribute("/joints/main", "coordinate_names", std::vector<std::string>{"rotation"});
  writer.constant("/bodies/rod/shapes/mesh/corners", corners, "m", "of a mesh", results::Writer::xyz);
  writer.constant("/joints/main/axis", axis, "1", "of the joint", results::Writer::xyz);
  const results::Series position = writer.series("/bodies/rod/position", 3, "m", "origin");
  (void)writer.series("/bodies/rod/velocity", 3, "m/s", "of the origin");  // without a row
  position.append({1, 2, 3});
  position.append({4, 5, 6});
  const nlohmann::json run = nlohmann::json::parse(instant_json(writer, "one"));
  CHECK(run["name"] == "one");
  CHECK(run["attributes"]["/"]["title"] == "a machine");
  CHECK(run["attributes"]["/bodies/rod"]["mass"] == 2);
  CHECK(run["attributes"]["/joints/main"]["coordinate_names"] == nlohmann::json{"rotation"});
  for (const char* group : {"/bodies", "/bodies/rod/shapes", "/bodies/rod/shapes/mesh", "/joints"})
    CHECK(run["attributes"].contains(group));
  const nlohmann::json& datasets = run["datasets"];
  CHECK(datasets.size() == 3);
  CHECK(datasets["/bodies/rod/position"]["shape"] == nlohmann::json{1, 3});
  CHECK(datasets["/bodies/rod/position"]["data"] == base64_float64(std::vector<double>{4, 5, 6}));
  CHECK(datasets["/bodies/rod/shapes/mesh/corners"]["type"] == "f4");
  CHECK(datasets["/bodies/rod/shapes/mesh/corners"]["data"] == base64_float32(corners));
  CHECK(datasets["/joints/main/axis"]["data"] == base64_float64(axis));
}

TEST_CASE("WriterThatKeepsNotAll_HasRowsOnly") {
  results::Writer writer{results::InMemory{}};
  writer.attribute("/", "title", "a machine");
  writer.constant("/x", std::vector<double>{1}, "m", "x");
  CHECK(writer.kept().attributes.empty());
  CHECK(writer.kept().constants.empty());
}

}  // namespace instant_test
}  // namespace hersey::report
