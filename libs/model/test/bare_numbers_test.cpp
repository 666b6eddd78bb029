#include "hersey/model/bare_numbers.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

namespace hersey::model::bare_numbers_test {

constexpr const char* kModel = R"(hersey: 1
gravity: [0, 0, -9.81]
parameters: {load: 500, share: 0.5, one: 2, two: 3}
lubricants: {oil: {viscosity: 0.015}}
bearings:
  main:
    {diameter: 45 mm, width: 0.0156, radial_clearance: 34e-6, lubricant: oil, grid: {circumferential: 40, axial: 7},
     operating_point: {journal_speed: "${one} * ${two}", load: "${load}"}}
)";

std::map<std::string, BareNumber> found(const std::vector<std::string>& overrides = {}) {
  std::map<std::string, BareNumber> by_path;
  for (const BareNumber& each : bare_numbers(kModel, "model.yaml", overrides)) by_path[each.path] = each;
  return by_path;
}

TEST_CASE("BareNumbers_AreFoundWithTheUnitOfTheirKey") {
  const auto numbers = found();
  CHECK(numbers.size() == 6);  // a 0 is any quantity, and counts and shares have no unit
  CHECK(numbers.at("gravity.2").unit == "m/s^2");
  CHECK(numbers.at("lubricants.oil.viscosity").unit == "Pa.s");
  CHECK(numbers.at("bearings.main.width").unit == "m");
  CHECK(numbers.at("bearings.main.radial_clearance").unit == "m");
}

TEST_CASE("BareNumbers_OfAParameterNameIt") {
  const auto numbers = found();
  const std::string point = "bearings.main.operating_point.";
  CHECK(numbers.at(point + "load").parameter == "load");
  CHECK(numbers.at(point + "load").unit == "N");
  CHECK(numbers.at(point + "journal_speed").parameter.empty());  // of two: neither is the one
}

TEST_CASE("BareNumbers_OfOverridesCount") {
  CHECK(found({"load=700 N"}).count("bearings.main.operating_point.load") == 0);
  CHECK(found({"bearings.main.diameter=0.045"}).at("bearings.main.diameter").unit == "m");
  CHECK(bare_numbers("a: [", "model.yaml", {}).empty());
}

}  // namespace hersey::model::bare_numbers_test
