#pragma once

namespace hersey::film {

/// Friction of a fully turbulent film (theory manual, turbulence.3 to turbulence.8).
enum class TurbulenceModel {
  none,            ///< the film is laminar at every Reynolds number
  ng_pan,          ///< Reichardt's eddy viscosity, integrated across the film, linearised about its sliding
  constantinescu,  ///< powers of the Reynolds number, from a mixing length
  hirs,            ///< bulk flow with Blasius' friction of a smooth wall
};

/// Number that decides about the transition of a film (turbulence.1, turbulence.9).
enum class TransitionNumber {
  reynolds,  ///< Re = rho v h/mu of the sliding
  taylor,    ///< Re sqrt(h/R), of the vortices between a journal and its bore
};

/// Turbulence of a film: friction where it is fully turbulent, and the band in which it becomes so.
struct Turbulence {
  TurbulenceModel model = TurbulenceModel::none;
  TransitionNumber number = TransitionNumber::reynolds;
  double onset = 900;    ///< number up to which a film is laminar [-], > 0
  double full = 1600;    ///< number from which it is fully turbulent [-], > onset
  double prandtl = 0.9;  ///< eddy viscosity over eddy diffusivity of heat, turbulent Prandtl number [-], > 0

  /// True if it changes anything.
  [[nodiscard]] bool counts() const { return model != TurbulenceModel::none; }
};

/// A factor of friction over that of a laminar film, with its derivatives by the logarithms of the Reynolds number, at
/// fixed film thickness, and of the film thickness, at fixed Reynolds number [-].
struct FrictionFactor {
  double value = 1, by_reynolds = 0, by_thickness = 0;
};

/// Friction of a film over that of a laminar one (turbulence.2): of sliding, and of flow along pressure in the
/// direction of sliding and across it.
struct TurbulentFriction {
  double fraction = 0;  ///< of turbulent friction in the mixture: 0 laminar, 1 fully turbulent [-]
  FrictionFactor sliding, along, across;
};

/// Friction of a fully turbulent film at a Reynolds number > 0, whatever the transition says. For
/// TurbulenceModel::none it is that of a laminar one.
/// @see Ng and Pan (1965), J. Basic Eng. 87, 675-688; Constantinescu (1959), Proc. IMechE 173, 881-900; Hirs (1973), J.
/// Lubr. Technol. 95, 137-146.
[[nodiscard]] TurbulentFriction fully_turbulent(TurbulenceModel model, double reynolds);

/// Number that decides about a film of this Reynolds number and thickness [m] on a surface of the radius R [m].
[[nodiscard]] double transition_number(const Turbulence& turbulence, double reynolds, double h, double R);

/// Friction in a film of this Reynolds number and thickness: laminar up to the onset, to the bit; fully turbulent
/// beyond the band; a mixture with a continuous slope between (turbulence.9, turbulence.10).
[[nodiscard]] TurbulentFriction turbulent_friction(const Turbulence& turbulence, double reynolds, double h, double R);

}  // namespace hersey::film
