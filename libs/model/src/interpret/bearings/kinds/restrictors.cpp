#include "interpret/bearings/kinds/restrictors.h"

#include <optional>
#include <variant>

#include "hersey/film/film_model.h"
#include "schema/restrictor_laws.h"

namespace hersey::model {
namespace {

// Part of a pump's limit over which its relief valve opens: what valves of hydraulic power units have, 3 to 10 %.
constexpr double kReliefBand = 0.05;

/// Temperature of the oil that feeds a feature [K]; none where the film has the one of its lubricant.
std::optional<double> supply_temperature(const Bearing& bearing, std::size_t feature) {
  if (const auto* film = std::get_if<film::ThermalModel>(&bearing.heat))
    return film->T_features.empty() ? film->T_supply : film->T_features[feature];
  if (const auto* global = std::get_if<bearing::GlobalHeat>(&bearing.heat))
    if (!global->cools_by_surroundings) return global->T_supply;
  return std::nullopt;
}

}  // namespace

void read_restrictor(Context& context, const Value& value, const Function& pressure, film::SurfaceFeature& feature) {
  const Value* given = value.find("restrictor");
  if (given == nullptr || given->broken || context.has_fault_in(given->path)) return;
  feature.restrictor = film::Restrictor{read_alternative(*given, restrictor_laws()), {}};
  const Value* supply = value.find("pressure");
  const Value* node = value.find("circuit");
  auto* pump = std::get_if<film::ConstantFlow>(&feature.restrictor->law);
  if (pump != nullptr && node != nullptr) {
    context.fault(*given, "a pump of its own behind a node of the circuit",
                  "a restrictor that throttles, or no `circuit`");
    return;
  }
  if (pump == nullptr) {
    if (supply == nullptr && node == nullptr)
      context.fault_at_key(*given, "a restrictor without a supply", "'pressure' of the supply before it",
                           "`restrictor: {type: constant_flow, flow: ...}` needs none");
    return;
  }
  feature.is_fed = true;
  if (supply == nullptr) return;
  if (!pressure.is_constant()) {
    context.fault(*supply, "a limit of a pump that varies", "a constant pressure");
    return;
  }
  pump->relief_band = kReliefBand * feature.pressure;
  if (feature.pressure <= 0)
    context.fault(*supply, "a pump whose limit is no pressure",
                  "a `pressure` above 0, or none: then there is no limit");
}

void complete_restrictors(Context& context, const Value& value, Bearing& bearing) {
  film::FilmModel& film = bearing.film;
  if (!film::has_restrictors(film)) return;
  for (std::size_t f = 0; f < film.features.size(); ++f) {
    if (!film.features[f].restrictor) continue;
    film::Lubricant oil = film.lubricant;
    if (const std::optional<double> T = supply_temperature(bearing, f)) oil = film::at_temperature(oil, *T);
    film.features[f].restrictor->oil = {.mu = oil.mu0, .density = oil.density};
  }
  if (bearing.solver == film::FilmSolver::sor)
    context.fault(*value.find("solver"), "`sor` with restrictors, whose pressures sweeps from node to node do not find",
                  "`newton` or `multigrid`");
}

}  // namespace hersey::model
