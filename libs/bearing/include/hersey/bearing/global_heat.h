#pragma once

namespace hersey::bearing {

/// One effective temperature of a bearing's oil by a balance of heat (theory manual, thermal.18): the oil takes all of
/// it along, warming from T_supply and being effective half-way, or the housing gives all of it off.
struct GlobalHeat {
  double T_supply = 313.15;  ///< of the oil that comes [K]; of no account with cooling by the surroundings
  bool cools_by_surroundings = false;
  double transfer = 0;        ///< coefficient of heat transfer from the housing [W/(m^2 K)], > 0
  double area = 0;            ///< of the housing [m^2], > 0
  double T_ambient = 293.15;  ///< around it [K]
};

/// What that balance comes to.
struct EffectiveTemperature {
  double T = 0;      ///< of the oil [K]
  double T_out = 0;  ///< of the oil that leaves [K]; T where the housing cools
};

}  // namespace hersey::bearing
