#pragma once

namespace hersey::fem {

/// What a solid does with heat, the same in all directions.
struct ThermalMaterial {
  double conductivity = 0;  ///< of heat, k [W/(m K)], > 0 where heat is conducted
  double expansion = 0;     ///< linear, alpha [1/K]
};

}  // namespace hersey::fem
