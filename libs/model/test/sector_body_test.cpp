#include <cmath>
#include <numbers>
#include <string>

#include "hersey/model/build.h"
#include "model_text.h"

// Bodies that are sectors of rings, meshed by the program.
namespace hersey::model {
namespace sector_body_test {

const std::string kPad = R"(hersey: 1
bodies:
  pad:
    flexible:
      sector:
        inner_radius: 50 mm
        thickness: 10 mm
        width: 30 mm
        middle: 350 deg
        arc: 40 deg
        seat: {angle: -10 deg, arc: 4 deg, width: 10 mm}
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
    frames: {foot: {nodes: seat, connection: average}}
joints:
  stand: {type: fixed, between: [ground, pad.foot]}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

TEST_CASE("SectorOfARing_IsABodyWithSidesAndASeat") {
  const Model model = read_text(kPad, "m.yaml");
  const fem::Mesh& mesh = *model.bodies.front().flexible->mesh;
  for (const char* name : {"inner", "outer", "first_end", "last_end", "low_side", "high_side"}) {
    CHECK(mesh.node_sets.count(name) == 1);
    CHECK(mesh.surfaces.count(name) == 1);
  }
  // The seat's angle is the same a turn away.
  const Vector3 foot = model.bodies.front().frames.front().X_BF.r;
  CHECK(std::atan2(foot.y(), foot.x()) == doctest::Approx(-10 * std::numbers::pi / 180));
  const Machine machine = build(model);
  CHECK(machine.flexibles.size() == 1);
}

TEST_CASE("FaultsOfASector_SayWhatItNeeds") {
  CHECK(faults_of(
            edited(kPad, "      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}\n", ""))
            .find("a sector without `material`") != std::string::npos);
  CHECK(faults_of(edited(kPad, "angle: -10 deg", "angle: 9 deg")).find("reaches beyond its sector") !=
        std::string::npos);
  CHECK(faults_of(edited(kPad, "width: 10 mm", "width: 31 mm")).find("reaches beyond its sector") != std::string::npos);
  CHECK(faults_of(edited(kPad, "      sector:", "      length_unit: 1 mm\n      sector:"))
            .find("`length_unit` of a sector") != std::string::npos);
  CHECK(faults_of(edited(kPad, "nodes: seat", "nodes: foot")).find("unknown node set 'foot'") != std::string::npos);
}

}  // namespace sector_body_test
}  // namespace hersey::model
