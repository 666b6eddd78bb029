#pragma once

namespace hersey::fem {

/// Thermal constants of a solid, the same in all directions.
struct ThermalMaterial {
  double conductivity = 0;  ///< thermal conductivity k [W/(m K)], > 0 where heat is conducted
  double expansion = 0;     ///< coefficient of linear expansion alpha [1/K]
};

}  // namespace hersey::fem
