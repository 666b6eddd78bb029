#include <numbers>

#include "model_text.h"

namespace hersey::model {
namespace {

// A bearing without bodies. Line numbers matter.
const std::string bearing_alone = R"(hersey: 1
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  main:
    diameter: 45 mm
    width: 15 mm
    radial_clearance: 34 um
    lubricant: oil
    operating_point:
      journal_speed: 3000 rpm
      load: 500 N
)";

TEST_CASE("BearingAlone_NeedsNoMachine") {
  const Model model = read_text(bearing_alone, "m.yaml");
  CHECK(model.is_of_bearings_alone());
  REQUIRE(model.bearings.size() == 1);
  REQUIRE(model.bearings[0].operating_point);
  const OperatingPoint& point = *model.bearings[0].operating_point;
  CHECK(point.journal_speed == doctest::Approx(100 * std::numbers::pi));
  CHECK(point.shell_speed == 0);
  CHECK(point.load == 500);
  CHECK(point.load_angle == doctest::Approx(-std::numbers::pi / 2));
  CHECK_FALSE(point.eccentricity_ratio);
}

TEST_CASE("Machine_StillNeedsAllItsParts") {
  const std::string faults = faults_of(bearing_alone + "bodies:\n  rod: {mass: 2 kg}\n");
  CHECK(faults.find("missing key 'simulation'; expected simulation settings") != std::string::npos);
  CHECK(faults.find("m.yaml:5:3: bearings.main: missing key 'shell'; expected a body or body.frame, such as "
                    "rod.big_end") != std::string::npos);
  CHECK(faults.find("missing key 'journal'") != std::string::npos);
  CHECK(faults_of("hersey: 1\n").find("missing key 'bodies'") != std::string::npos);
}

TEST_CASE("LoadAndPosition_ExcludeEachOther") {
  CHECK(faults_of(bearing_alone + "      eccentricity_ratio: 0.5\n") ==
        "m.yaml:13:7: bearings.main.operating_point.eccentricity_ratio: keys 'load' and 'eccentricity_ratio' together; "
        "expected exactly one of them; with --set, give the other one as 'none'");
  CHECK(faults_of(edited(bearing_alone, "      load: 500 N\n", "")) ==
        "m.yaml:10:5: bearings.main.operating_point: neither 'load' nor 'eccentricity_ratio'; expected exactly one of "
        "them");
  const Model model =
      read_text(bearing_alone, "m.yaml",
                {"bearings.main.operating_point.load=none", "bearings.main.operating_point.eccentricity_ratio=0.5"});
  CHECK_FALSE(model.bearings[0].operating_point->load);
  CHECK(model.bearings[0].operating_point->eccentricity_ratio == 0.5);
}

TEST_CASE("ImpossibleOperatingPoints_AreFaults") {
  CHECK(faults_of(edited(bearing_alone, "3000 rpm", "3000 rpm\n      shell_speed: -3000 rpm"))
            .find("speeds that drag no oil into the gap") != std::string::npos);
  CHECK(faults_of(bearing_alone + "      tilt_x: 1 deg\n").find("touches the shell") != std::string::npos);
  CHECK(faults_of(edited(bearing_alone, "load: 500 N", "load: -500 N")).find("a force > 0") != std::string::npos);
  CHECK(faults_of(edited(bearing_alone, "load: 500 N", "eccentricity_ratio: 1")).find(">= 0 and < 1") !=
        std::string::npos);
}

}  // namespace
}  // namespace hersey::model
