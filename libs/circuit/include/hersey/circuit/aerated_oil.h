#pragma once

namespace hersey::circuit {

/// A volume of oil that yields to pressure: by its walls, by the oil's own compressibility and by the air in it.
///
/// Air is dissolved by Henry's law, at once; what is not dissolved is bubbles at the temperature of the oil. Without
/// air the volume answers to pressure by walls and oil alone.
struct Storage {
  double volume = 1e-4;         ///< at ambient pressure [m^3], > 0
  double wall_compliance = 0;   ///< by which it grows with pressure [m^3/Pa], >= 0
  double bulk_modulus = 1.5e9;  ///< of oil without bubbles [Pa], > 0
  double free_air = 0;          ///< fraction of the volume that is bubbles at ambient pressure [-], in [0, 1)
  double solubility = 0.09;     ///< Bunsen's coefficient: air dissolved at ambient pressure over oil [-], >= 0

  /// The oil in the volume, as its volume at ambient pressure, and its derivative.
  struct Content {
    double value = 0;  ///< [m^3]
    double slope = 0;  ///< [m^3/Pa]
  };
  /// Returns its content of oil at a pressure (circuit.8).
  /// @param p  above ambient [Pa]; below a tenth of the ambient pressure, absolute, bubbles are those at that pressure
  /// @param ambient  absolute pressure of the surroundings [Pa], > 0
  [[nodiscard]] Content content(double p, double ambient) const;
};

/// Absolute pressure of the surroundings [Pa].
inline constexpr double standard_atmosphere = 101325;

}  // namespace hersey::circuit
