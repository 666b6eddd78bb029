#include "hersey/film/turbulence.h"

#include <algorithm>
#include <cmath>

#include "laws/eddy_profile.h"

namespace hersey::film {
namespace {

/// Returns a + b Re^c over a, as a factor of friction.
FrictionFactor power_fit(double laminar, double b, double c, double reynolds) {
  const double excess = b / laminar * std::pow(reynolds, c);
  return {1 + excess, c * excess};
}

// Hirs' law of friction at a wall, tau/(rho u^2/2) = n (rho u h/mu)^m, with n and m of smooth walls.
constexpr double hirs_n = 0.066, hirs_m = -0.25;

// Half of the width of the rounding, as a fraction of laminar friction, where turbulent friction becomes the larger
// one: it raises friction by a quarter of it, 2.5 %, at most.
constexpr double rounding = 0.1;

/// Returns the larger of turbulent friction and that of a laminar film, 1, with the corner rounded (turbulence.8).
FrictionFactor at_least_laminar(FrictionFactor friction) {
  const double beyond = friction.value - 1 + rounding;
  if (beyond <= 0) return {};
  if (beyond >= 2 * rounding) return friction;
  return {1 + beyond * beyond / (4 * rounding), friction.by_reynolds * beyond / (2 * rounding)};
}

TurbulentFriction by_bulk_flow(double reynolds) {
  const double power = 1 + hirs_m, size = hirs_n * std::pow(reynolds, power);
  const auto factor = [&](double value) { return at_least_laminar({value, power * value}); };
  const double across = size * std::pow(2, -power) / 12;
  return {1, factor(size * std::pow(2, -power - 2)), factor((2 + hirs_m) * across), factor(across)};
}

/// Returns a factor 1 + w (turbulent - 1) of a mixture, w with its derivatives.
FrictionFactor mixed(const FrictionFactor& turbulent, const FrictionFactor& w) {
  const double beyond = turbulent.value - 1;
  return {1 + w.value * beyond, w.value * turbulent.by_reynolds + w.by_reynolds * beyond, w.by_thickness * beyond};
}

}  // namespace

TurbulentFriction fully_turbulent(TurbulenceModel model, double reynolds) {
  switch (model) {
    case TurbulenceModel::none:
      return {};
    case TurbulenceModel::ng_pan: {
      const EddyFriction eddies = eddy_friction(reynolds);
      const auto factor = [](const ValueAndSlope& friction) { return FrictionFactor{friction.value, friction.slope}; };
      return {1, factor(eddies.sliding), factor(eddies.along), factor(eddies.across)};
    }
    case TurbulenceModel::constantinescu:  // (turbulence.7)
      return {1, power_fit(1, 0.0023, 0.855, reynolds), power_fit(12, 0.0260, 0.8265, reynolds),
              power_fit(12, 0.0198, 0.741, reynolds)};
    case TurbulenceModel::hirs:
      return by_bulk_flow(reynolds);
  }
  return {};
}

double transition_number(const Turbulence& turbulence, double reynolds, double h, double R) {
  return turbulence.number == TransitionNumber::taylor ? reynolds * std::sqrt(h / R) : reynolds;
}

TurbulentFriction turbulent_friction(const Turbulence& turbulence, double reynolds, double h, double R) {
  const double number = transition_number(turbulence, reynolds, h, R);
  if (!turbulence.counts() || number <= turbulence.onset) return {};
  const double width = turbulence.full - turbulence.onset;
  const double t = std::min((number - turbulence.onset) / width, 1.0);
  FrictionFactor w{t * t * (3 - 2 * t), 6 * t * (1 - t) * number / width};
  if (turbulence.number == TransitionNumber::taylor) w.by_thickness = 0.5 * w.by_reynolds;
  const TurbulentFriction full = fully_turbulent(turbulence.model, reynolds);
  return {w.value, mixed(full.sliding, w), mixed(full.along, w), mixed(full.across, w)};
}

}  // namespace hersey::film
