// Gear meshes in the model file (theory manual, rotors.16).
#include <cmath>
#include <numbers>

#include "model_text.h"

namespace hersey::model {
namespace gear_mesh_model_test {

const std::string kStage = R"(hersey: 1
bodies:
  ground: {frames: {second: {origin: 165.6 0 0 mm}}}
  pinion: {mass: 3 kg, inertia: {xx: 0.003 kg.m^2, yy: 0.003 kg.m^2, zz: 0.004 kg.m^2}}
  wheel: {mass: 14 kg, inertia: {xx: 0.05 kg.m^2, yy: 0.05 kg.m^2, zz: 0.09 kg.m^2}}
joints:
  turning: {type: revolute, between: [ground, pinion], axis: z, initial: {rotation: 20 deg}}
  other: {type: revolute, between: [ground.second, wheel], axis: z, initial: {rotation: -7 deg}}
forces:
  mesh:
    type: gear_mesh
    between: [pinion, wheel]
    teeth: [23, 57]
    normal_module: 4 mm
    helix_angle: 15 deg
    torque_on_first: negative
    stiffness: 400 MN/m
simulation: {duration: 1 ms, step: 0.1 ms}
)";

constexpr double kRoundOff = 1e-12;  // of some dozens of operations

TEST_CASE("Teeth_GiveTheBaseCirclesOfTheirPitch") {
  const Model model = read_text(kStage, "m.yaml");
  const mbd::GearMesh::Data data = model.forces.at(0).as<GearMesh>()->data;
  CHECK(data.side == -1);
  CHECK(data.teeth == std::array{23, 57});
  // Along the normal of the flanks one tooth follows the other after the base pitch of the basic rack.
  const double pitch = 2 * std::numbers::pi * data.base_radius[0] / 23 * std::cos(data.base_helix);
  CHECK(pitch == doctest::Approx(std::numbers::pi * 4e-3 * std::cos(20 * std::numbers::pi / 180)).epsilon(kRoundOff));
  // Tip circles, a module outside the reference circles, touch there.
  CHECK(data.reach == doctest::Approx(4e-3 * 80 / 2 / std::cos(15 * std::numbers::pi / 180) + 8e-3).epsilon(kRoundOff));
  // The lead is that of the reference cylinder.
  const double reference = 4e-3 * 23 / 2 / std::cos(15 * std::numbers::pi / 180);
  CHECK(std::tan(data.base_helix) / data.base_radius[0] ==
        doctest::Approx(std::tan(15 * std::numbers::pi / 180) / reference).epsilon(kRoundOff));
}

TEST_CASE("FaultsOfAGearMesh_NameTheKey") {
  const auto after = [](const char* from, const char* to) { return faults_of(edited(kStage, from, to)); };
  CHECK(after("teeth: [23, 57]", "teeth: [23]").find("forces.mesh.teeth") != std::string::npos);
  CHECK(after("teeth: [23, 57]", "teeth: [23, 0]").find("forces.mesh.teeth") != std::string::npos);
  CHECK(after("torque_on_first: negative", "torque_on_first: backward").find("positive") != std::string::npos);
  CHECK(after("    torque_on_first: negative\n", "").find("torque_on_first") != std::string::npos);
  CHECK(after("helix_angle: 15 deg", "helix_angle: 75 deg").find("forces.mesh.helix_angle") != std::string::npos);
  CHECK(after("between: [pinion, wheel]", "between: [pinion, pinion]").find("frames of two bodies") !=
        std::string::npos);
}

TEST_CASE("AWheelMeshingWithItself_IsOneFault") {
  const std::string faults = faults_of(edited(kStage, "between: [pinion, wheel]", "between: [pinion, pinion]"));
  CHECK(faults.find("frames of two bodies") != std::string::npos);
  CHECK(faults.find("two wheels") == std::string::npos);
}

}  // namespace gear_mesh_model_test
}  // namespace hersey::model
