#pragma once

#include <string_view>
#include <variant>

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// Viscosity and density of the oil in a restrictor, which is as warm as it is supplied.
struct RestrictorOil {
  double mu = 0.015;     ///< dynamic viscosity [Pa s], > 0
  double density = 850;  ///< [kg/m^3], > 0
};

/// Laminar flow through a long, narrow bore (hydrostatic.2). To choose where the bearing's stiffness shall not depend
/// on the oil's temperature: film and restrictor thin alike.
/// @source Hagen (1839), Poiseuille (1840)
struct Capillary {
  static constexpr std::string_view name = "capillary";
  double length = 0.02;      ///< [m], > 0
  double diameter = 0.5e-3;  ///< of its bore [m], > 0
  /// Returns the flow under a drop of pressure and its slope, as Restrictor::flow() does.
  [[nodiscard]] ValueAndSlope flow(double drop, const RestrictorOil& oil) const;
};

/// Flow in proportion to the drop of pressure, whatever the oil: a capillary, slot or porous plug that has been
/// measured.
struct FlowResistance {
  static constexpr std::string_view name = "resistance";
  double resistance = 1e12;  ///< [Pa s/m^3], > 0
  /// Returns the flow under a drop of pressure and its slope, as Restrictor::flow() does.
  [[nodiscard]] ValueAndSlope flow(double drop, const RestrictorOil& oil) const;
};

/// A sharp-edged hole (hydrostatic.3): inertia at large flows, creeping flow at small ones, one smooth law through
/// zero.
/// @source Sampson (1891) for creeping flow; a coefficient of discharge for large flows
struct Orifice {
  static constexpr std::string_view name = "orifice";
  double diameter = 0.5e-3;            ///< [m], > 0
  double discharge_coefficient = 0.6;  ///< of flow at large Reynolds numbers [-], in (0, 1]
  /// Returns the flow under a drop of pressure and its slope, as Restrictor::flow() does.
  [[nodiscard]] ValueAndSlope flow(double drop, const RestrictorOil& oil) const;
};

/// A pump of its own that delivers a constant flow, whose relief valve takes it back as the pressure nears a limit
/// (hydrostatic.4).
struct ConstantFlow {
  static constexpr std::string_view name = "constant_flow";
  double rate = 1e-6;  ///< [m^3/s], > 0
  /// Drop below the limit at which the relief valve begins to open [Pa]; 0: there is no limit.
  double relief_band = 0;
  /// Returns the flow under a drop of pressure and its slope, as Restrictor::flow() does.
  [[nodiscard]] ValueAndSlope flow(double drop, const RestrictorOil& oil) const;
};

/// A law of flow over drop of pressure. A new one is a struct like these and an alternative here.
using RestrictorLaw = std::variant<Capillary, FlowResistance, Orifice, ConstantFlow>;

/// A restrictor between a supply and what it feeds: a recess of a film, or a node of a circuit. Oil is incompressible
/// in it, and it has no state of its own.
/// @verified_by restrictor_test.cpp
struct Restrictor {
  RestrictorLaw law;
  RestrictorOil oil;

  /// Returns the flow [m^3/s] under a drop of pressure [Pa] from the supply to what is fed, and its slope, which is
  /// nowhere negative.
  [[nodiscard]] ValueAndSlope flow(double drop) const {
    return std::visit([&](const auto& of) { return of.flow(drop, oil); }, law);
  }
  /// True if the supply's own pressure does work in it: a pump of constant flow delivers at the pressure behind it.
  [[nodiscard]] bool throttles() const { return !std::holds_alternative<ConstantFlow>(law); }
  /// True if a pressure of the supply counts: that of a throttle, or the limit of a pump.
  [[nodiscard]] bool has_supply_pressure() const {
    const auto* pump = std::get_if<ConstantFlow>(&law);
    return pump == nullptr || pump->relief_band > 0;
  }
  /// Its name in the model file.
  [[nodiscard]] std::string_view name() const {
    return std::visit([](const auto& of) { return of.name; }, law);
  }
};

}  // namespace hersey::film
