#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "interpret/context/interpret.h"
#include "schema/format.h"
#include "schema/machine_vocabulary.h"

// Meshes of gear wheels, by the data of their teeth.
namespace hersey::model {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TypePtr error_format() {
  return object(
      "a transmission error",
      {required("amplitude", quantity("m", "2 um", Range::not_negative()),
                "Amplitude along the normal of the flanks, once a tooth."),
       defaulted(
           "phase", quantity("rad", "90 deg"), "0 deg",
           "Of the tooth at the start; at 0 deg the teeth press most there. It grows as the first wheel turns the "
           "way of `torque_on_first`: with the other wheel named first, the phase has the other sign.")});
}

/// Radii of the base circles and helix angle on them (rotors.16).
void set_teeth(const Value& value, double module, double pressure, double helix, mbd::GearMesh::Data& data) {
  const Value* teeth = value.find("teeth");
  const double transverse = std::atan(std::tan(pressure) / std::cos(helix));
  for (std::size_t i = 0; i < 2; ++i) {
    data.teeth[i] = static_cast<int>(std::lround(teeth->members[i].value.number));
    data.base_radius[i] = 0.5 * module * data.teeth[i] / std::cos(helix) * std::cos(transverse);
  }
  // Tip circles of wheels without profile shift, which stand out by a module, touch there; shifts that make wheels
  // larger move their axes apart by nearly as much.
  data.reach = module * (0.5 * (data.teeth[0] + data.teeth[1]) / std::cos(helix) + 2);
  data.base_helix = std::asin(std::sin(helix) * std::cos(pressure));
}

}  // namespace

std::vector<Key> gear_mesh_keys() {
  constexpr double kMostPressure = 35 * kDegree, kMostHelix = 60 * kDegree;
  return {
      required(
          "between", list("two frames", reference(Refers::frame, "shaft.pinion"), 2),
          "First and second wheel: frames in the middle of their faces, whose z-axes are the wheels' axes and point "
          "the same way."),
      required("teeth", list("two numbers of teeth", integer(23, {.low = 1}), 2), "Of the first and the second wheel."),
      required("normal_module", quantity("m", "4 mm", Range::positive()),
               "Normal module: the pitch of the teeth along the normal of the flanks' trace, over pi."),
      defaulted("pressure_angle", quantity("rad", "20 deg", {.low = 0, .high = kMostPressure, .low_open = true}),
                "20 deg", "Normal pressure angle of the basic rack, at most 35 deg."),
      defaulted("helix_angle", quantity("rad", "15 deg", {.low = -kMostHelix, .high = kMostHelix}), "0 deg",
                "Helix angle of the first wheel at its reference circle: positive for right-handed teeth, negative for "
                "left-handed ones, at most 60 deg; the second wheel has the other hand."),
      required("torque_on_first", choice(torque_sign_words),
               "Sign of the torque by which its shaft, or on an idler all but this mesh, acts on the first wheel. It "
               "says on "
               "which flanks teeth touch; they touch there at all times."),
      required("stiffness", quantity("N/m", "400 MN/m", Range::not_negative()),
               "Mesh stiffness along the normal of the flanks, of all teeth in contact together."),
      defaulted("damping", quantity("N.s/m", "2 kN.s/m", Range::not_negative()), "0 N.s/m", "Likewise."),
      optional("transmission_error", error_format(),
               "Deviation of the flanks, once a tooth of the first wheel. `hersey rotor` leaves it out.", "none"),
  };
}

GearMesh gear_mesh_of(Context& context, const Value& value) {
  GearMesh mesh;
  std::tie(mesh.from, mesh.to) = pair_of(context, value);
  mesh.data.side = meaning_of(value, "torque_on_first", torque_sign_words) ? 1 : -1;
  mesh.data.stiffness = number_of(value, "stiffness");
  mesh.data.damping = number_of(value, "damping");
  if (const Value* error = value.find("transmission_error"); error != nullptr && !error->broken) {
    mesh.data.error = number_of(*error, "amplitude");
    mesh.data.error_phase = number_of(*error, "phase");
  }
  const double module = number_of(value, "normal_module"), pressure = number_of(value, "pressure_angle");
  if (!context.has_fault_in(value.path)) set_teeth(value, module, pressure, number_of(value, "helix_angle"), mesh.data);
  return mesh;
}

}  // namespace hersey::model
