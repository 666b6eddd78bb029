#include <array>

#include "hersey/bearing/quantities.h"

namespace hersey::bearing {

std::span<const Quantity> heat_quantities() {
  static constexpr auto table = std::to_array<Quantity>({
      {"bore_growth", "", "m", "growth of the bore's radius by temperature, mean",
       "growth of the bore's radius by the temperature of its body, mean over the nodes"},
      {"journal_growth", "", "m", "growth of the journal's radius by temperature, mean",
       "growth of the journal's radius by the temperature of its body, mean over the nodes"},
      {"clearance_of_bodies", "", "m", "radial clearance with what bodies have grown (hot), mean",
       "radial clearance with what bodies have grown, mean over the nodes"},
      {"T_max", "T_max", "degC", "hottest oil", "temperature of the hottest oil"},
      {"T_max_phi", "", "rad", "angle of the hottest oil"},
      {"T_max_z", "", "m", "axial position of the hottest oil"},
      {"T_max_r", "", "m", "radius of the hottest oil"},
      {"T_max_y", "", "m", "position along the sliding direction of the hottest oil"},
      {"T_face_max", "", "degC", "hottest place of the pads' faces", "highest temperature of the pads' faces"},
      {"T_face_mean", "", "degC", "mean temperature of the pads' faces"},
      {"T_face_max_angle", "", "rad", "angle of the hottest place of the pads' faces"},
      {"T_face_max_y", "", "m", "position along the sliding direction of the hottest place of the pad's face"},
      {"T_runner", "", "degC", "mean temperature of the runner's surface"},
      {"heat_to_pads", "", "W", "heat into the pads", "heat into the pads, or the stator"},
      {"heat_to_runner", "", "W", "heat into the runner"},
      {"T_shell_max", "", "degC", "hottest place of the shell", "highest temperature of the shell's surface"},
      {"T_shell_mean", "", "degC", "mean temperature of the shell's surface"},
      {"T_journal", "T_J", "degC", "mean temperature of the journal's surface"},
      {"T_body_max", "", "degC", "hottest place of the shell's body",
       "temperature of the hottest place of the shell's body"},
      {"T_journal_body_max", "", "degC", "hottest place of the journal's body",
       "temperature of the hottest place of the journal's body"},
      {"T_film", "", "degC", "mean temperature of the oil in the film"},
      {"T_side", "", "degC", "temperature of the side flow",
       "temperature of the oil that leaves over the edges; NaN where none does"},
      {"T_supply_<name>", "", "degC", "temperature in <name>", "temperature of the fully mixed oil in this supply"},
      {"heat_dissipated", "", "W", "heat made", "heat made in the film and by asperities"},
      {"heat_to_oil", "", "W", "heat carried away by the oil",
       "heat of the oil that leaves less that of the oil that comes"},
      {"heat_to_shell", "", "W", "heat into the shell"},
      {"heat_to_journal", "", "W", "heat into the journal"},
      {"heat_stored", "", "W", "rate of the heat in the film", "rate of the heat in the film's oil"},
      {"heat_balance_error", "", "1", "error of the balance of heat",
       "what is missing in the balance of heat, over its largest term"},
      {"T_effective", "", "degC", "effective temperature of the oil"},
      {"T_out", "", "degC", "temperature of the oil that leaves"},
      {"T_max_angle", "", "rad", "angle of the hottest oil", "T_max_phi of a steady solution"},
      {"T_shell_max_angle", "", "rad", "angle of the hottest place of the shell"},
      {"bore_distortion", "", "m", "largest deviation from the mean growth of the bore's radius, around and along"},
      {"journal_distortion", "", "m", "largest deviation from the mean growth of the journal's radius, along"},
      {"T_node_<name>", "", "degC", "temperature of <name>, with the heat of this bearing alone"},
      {"network_balance_error", "", "1", "error of the balance of heat of the bodies around"},
  });
  return table;
}

}  // namespace hersey::bearing
