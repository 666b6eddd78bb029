#pragma once

#include <memory>
#include <variant>

#include "hersey/circuit/oil.h"
#include "hersey/core/scalar_function.h"

/// Laws of elements: flow over drop of pressure. A new one is a struct like these and an alternative of Law.
namespace hersey::circuit {

/// How the wall of a drilling brakes the oil.
enum class Friction {
  churchill,  ///< laminar, transitional or turbulent, by the Reynolds number
  laminar,    ///< always as in laminar flow: for comparison with closed forms
};

/// A straight bore with losses at its ends and bends (circuit.3): drillings, pipes, galleries' branches.
struct Drilling {
  double length = 0.05;         ///< [m], > 0
  double diameter = 5e-3;       ///< [m], > 0
  double roughness = 0;         ///< height of its wall's roughness [m], >= 0
  double loss_coefficient = 0;  ///< sum of those of its inlet, outlet and bends, by the velocity in the bore [-], >= 0
  Friction friction = Friction::churchill;
  /// Returns the flow under a drop of pressure [Pa] and its slope.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

/// A sharp-edged hole or a jet (circuit.5): Torricelli's flow at large drops, Sampson's creeping flow at small ones.
/// @source Sampson (1891) for creeping flow; a coefficient of discharge for large flows
struct Orifice {
  double diameter = 1e-3;              ///< [m], > 0
  double discharge_coefficient = 0.7;  ///< of flow at large Reynolds numbers [-], in (0, 1]
  /// Returns the flow under a drop of pressure [Pa] and its slope.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

/// A flow in proportion to the drop of pressure: a filter, a leak that has been measured.
struct Resistance {
  double resistance = 1e9;  ///< [Pa s/m^3], > 0
  /// Returns the flow under a drop of pressure [Pa] and its slope.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

/// A cooler: to the flow a resistance, to the heat a conductance to a coolant of one temperature (circuit.15).
struct Cooler {
  double resistance = 1e9;   ///< [Pa s/m^3], > 0
  double conductance = 100;  ///< from oil to coolant, of all of its surface [W/K], > 0
  /// Returns the flow under a drop of pressure [Pa] and its slope.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
  /// Returns the part of the oil's excess over the coolant that is left at the outlet [-], of oil with the rate rho c Q
  /// of heat capacity [W/K].
  [[nodiscard]] double remaining(double capacity_rate) const;
};

/// A valve that opens at a drop of pressure, the further the more this exceeds it (circuit.6).
struct ReliefValve {
  double opening_pressure = 4e5;  ///< [Pa], > 0
  double conductance = 2e-9;      ///< flow over what the drop exceeds that by [m^3/(Pa s)], > 0
  /// Returns the flow under a drop of pressure [Pa] and its slope.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

/// A pump that displaces a volume with each revolution, of which a part leaks back (circuit.7).
struct DisplacementPump {
  double displacement = 1e-6;  ///< volume per angle of its shaft [m^3/rad], > 0
  double leakage = 0;          ///< back through its gaps, over the rise of pressure [m^3/(Pa s)], >= 0
  /// Displacement times rise of pressure over the torque of its shaft [-], in (0, 1].
  double mechanical_efficiency = 1;
  /// Returns the flow under a drop of pressure [Pa], the negative of its rise, and its slope.
  /// @param setting  with the speed of its shaft
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
  /// Returns the part of it that its gaps let pass, back where it lifts oil against pressure.
  [[nodiscard]] Flow leak(double drop) const { return {leakage * drop, leakage}; }
};

/// A pump whose flow over the rise of pressure has been measured.
struct PumpCurve {
  std::shared_ptr<const ScalarFunction> curve;  ///< flow [m^3/s] of the rise [Pa], nowhere ascending; never null
  /// Returns the flow under a drop of pressure [Pa], the negative of its rise, and its slope.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

/// A flow that nothing changes.
struct GivenFlow {
  double rate = 1e-5;  ///< [m^3/s]
  /// Returns the flow and a slope of 0.
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

/// A hole of one surface that passes over a groove of the other: an orifice as large as both overlap (circuit.13).
/// Choose it where a drilling is fed only during a part of each revolution.
struct HoleOverGroove {
  double discharge_coefficient = 0.7;  ///< of flow at large Reynolds numbers [-], in (0, 1]
  /// Returns the flow under a drop of pressure [Pa] and its slopes; none without overlap.
  /// @param setting  with the area of the overlap
  [[nodiscard]] Flow flow(double drop, const Oil& oil, const Setting& setting) const;
};

using Law = std::variant<Drilling, Orifice, Resistance, ReliefValve, DisplacementPump, PumpCurve, GivenFlow,
                         HoleOverGroove, Cooler>;

}  // namespace hersey::circuit
