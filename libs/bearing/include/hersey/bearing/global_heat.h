#pragma once

#include <optional>

#include "hersey/film/thermal_model.h"

namespace hersey::bearing {

/// Below this fraction of the clearance as given one at temperature is closed.
inline constexpr double seized = 0.01;

/// Thermal expansion of walls around a film of one temperature.
struct WallExpansion {
  film::ThermalExpansion material;
  std::optional<double> T_shell = {}, T_journal = {};  ///< means of the walls [K]; unset: that of the oil

  /// By how much the radial clearance of a bearing of radius R [m] has grown with oil of temperature T [K]
  /// (theory manual, thermal.42).
  [[nodiscard]] double growth(double R, double T) const {
    return material.growth(R, T_shell.value_or(T), T_journal.value_or(T));
  }
};

/// One effective temperature of a bearing's oil by a balance of heat (theory manual, thermal.20): the oil takes all of
/// it along, warming from T_supply and being effective half-way, or the housing gives all of it off.
struct GlobalHeat {
  double T_supply = 313.15;  ///< of the oil that comes [K]; of no account with cooling by the surroundings
  bool cools_by_surroundings = false;
  double transfer = 0;                          ///< coefficient of heat transfer from the housing [W/(m^2 K)], > 0
  double area = 0;                              ///< of the housing [m^2], > 0
  double T_ambient = 293.15;                    ///< around it [K]
  std::optional<WallExpansion> expansion = {};  ///< unset: the walls keep their size
};

/// What that balance comes to.
struct EffectiveTemperature {
  double T = 0;      ///< of the oil [K]
  double T_out = 0;  ///< of the oil that leaves [K]; T where the housing cools
};

}  // namespace hersey::bearing
