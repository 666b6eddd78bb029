#include "hersey/model/plausibility.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hersey::model {
namespace {

// Peak film pressures that the layers of highly loaded engine bearings are designed for are of this order; soft ones
// (white metal) yield far below it.
constexpr double kUsualPressure = 200e6;
// Roughness of finely ground journals and bored shells that have run in; for bearings whose roughness is not given.
constexpr double kLeastRoughness = 0.1e-6;

bool deforms(const Bearing& bearing) {
  return bearing.shell_surface || bearing.journal_surface || bearing.film.compliance > 0;
}

/// Rms of both surfaces together, 0 where it is not given.
double roughness_of(const Bearing& bearing) {
  const bool has_summits = bearing.film.asperities.model != film::AsperityModel::none;
  return has_summits ? bearing.film.asperities.sigma : bearing.film.roughness.composite_sigma();
}

std::string gap_warning(const Bearing& bearing, double h_min) {
  const double sigma = roughness_of(bearing);
  if (sigma == 0)
    return h_min < kLeastRoughness
               ? fmt::format(
                     "its smallest film: {:.2g} um is below the roughness of the finest surfaces (about 0.1 um); say "
                     "how rough they are (`asperities`), or lower the load",
                     1e6 * h_min)
               : "";
  if (h_min >= sigma) return "";
  const bool has_contact = bearing.film.asperities.model != film::AsperityModel::none;
  return fmt::format("its smallest film: {:.2g} um is below the roughness, {:.2g} um: the surfaces touch{}",
                     1e6 * h_min, 1e6 * sigma,
                     has_contact ? ", and wear; lower the load, or give more viscous oil, width or smoother surfaces"
                                 : ", which `asperities` counts");
}

std::string pressure_warning(const Bearing& bearing, double p_max) {
  if (p_max <= bearing.permissible_pressure.value_or(kUsualPressure)) return "";
  const std::string limit =
      bearing.permissible_pressure
          ? fmt::format("its permissible_pressure, {:.3g} MPa", 1e-6 * *bearing.permissible_pressure)
          : "what layers of bearings usually bear (of the order of 200 MPa in engines, far less of white metal; "
            "`permissible_pressure` states that of this one)";
  return fmt::format("its peak pressure: {:.3g} MPa is above {}; {}", 1e-6 * p_max, limit,
                     deforms(bearing) ? "lower the load or give more width"
                                      : "elastic surfaces spread it (`shell_surface`, or `compliance`)");
}

}  // namespace

std::vector<std::string> surface_warnings(const Bearing& bearing, double p_max, double h_min) {
  std::vector<std::string> warnings;
  if (std::string warning = pressure_warning(bearing, p_max); !warning.empty()) warnings.push_back(std::move(warning));
  if (std::isfinite(h_min)) {
    if (std::string warning = gap_warning(bearing, h_min); !warning.empty()) warnings.push_back(std::move(warning));
  }
  return warnings;
}

std::vector<std::string> regime_warnings(const Bearing& bearing, double reynolds_max, double laminar_share) {
  const film::Turbulence& turbulence = bearing.film.turbulence;
  if (turbulence.counts() || laminar_share >= 1) return {};
  return {fmt::format(
      "{:.3g} % of the film lies above a Reynolds number of {:g}, where films cease to be laminar (largest: {:.4g}): "
      "computed as laminar, its friction is too small; `turbulence: {{model: ng_pan}}` accounts for it",
      100 * (1 - laminar_share), turbulence.onset, reynolds_max)};
}

std::vector<std::string> rotation_warnings(const Bearing& bearing, double turned, double travelled) {
  constexpr double round_off = 1e-9;  // rad
  if (!bearing.heated_journal || (travelled > round_off && std::abs(turned) > 0.5 * travelled)) return {};
  const double degrees = 180 / std::numbers::pi;
  const std::string how = travelled > round_off
                              ? fmt::format("swings in its shell: {:.3g} deg to and fro, {:.3g} deg of it one way",
                                            degrees * travelled, degrees * std::abs(turned))
                              : std::string("does not rotate in its shell");
  return {"a journal whose temperatures are those of a body " + how +
          ": that heat enters it evenly around is an estimate"};
}

}  // namespace hersey::model
