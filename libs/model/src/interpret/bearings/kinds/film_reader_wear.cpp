#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "interpret/bearings/kinds/film_reader.h"

// Wear of both surfaces of a bearing.
namespace hersey::model {

void FilmReader::read_wear() {
  const Value* wear = value_.find("wear");
  if (wear == nullptr || wear->broken) return;
  const Value* const asperities = value_.find("asperities");
  const bool is_broken = asperities != nullptr && context_.has_fault_in(asperities->path);
  if (film_.asperities.model == film::AsperityModel::none && !is_broken)
    context_.fault_at_key(*wear, "`wear` of surfaces that never touch", "`asperities` beside it",
                          "only contact of asperities wears");
  if (wear->find(surfaces_.moving) != nullptr && std::holds_alternative<film::Plane>(film_.surface))
    context_.fault_at_key(*wear->find(surfaces_.moving), "wear of what slides over a plane pad",
                          "wear of the pad: of what passes it nobody knows how long it is");
  if (wear->find(surfaces_.moving) != nullptr && std::holds_alternative<film::Skirt>(film_.surface))
    context_.fault_at_key(*wear->find(surfaces_.moving), "wear of a liner, along which the skirt moves",
                          "wear of the skirt: where on the liner it rubs is not followed");
  if (wear->find(surfaces_.fixed) == nullptr && wear->find(surfaces_.moving) == nullptr)
    context_.fault_at_key(*wear, "`wear` of no surface",
                          fmt::format("`{}` or `{}` or both", surfaces_.fixed, surfaces_.moving));
  const Value* cycle = wear->find("cycle");
  bearing_.wear = bearing::WearModel{.fixed = wear_of(*wear, surfaces_.fixed),
                                     .moving = wear_of(*wear, surfaces_.moving),
                                     .acceleration = number_of(*wear, "acceleration"),
                                     .cycle = cycle != nullptr && !cycle->broken ? cycle->number : 0};
  if (const Value* moving = wear->find(surfaces_.moving); moving != nullptr && moving->find("around") != nullptr)
    bearing_.wear->around = meaning_of(*moving, "around", wear_around_words);
  if (const Value* run_in = wear->find("running_in"); run_in != nullptr && !run_in->broken)
    bearing_.wear->running_in = running_in_of(*run_in);
}

bearing::RunningIn FilmReader::running_in_of(const Value& run_in) {
  bearing::RunningIn read;
  if (context_.has_fault_in(run_in.path) || film_.asperities.model == film::AsperityModel::none) return read;
  const double end = number_of(run_in, "roughness"), start = film_.asperities.sigma;
  if (end > start)
    context_.fault(*run_in.find("roughness"),
                   fmt::format("surfaces that run in from {:.4g} um to {:.4g} um", 1e6 * start, 1e6 * end),
                   fmt::format("at most `asperities.roughness`, {:.4g} um", 1e6 * start),
                   "surfaces that get rougher as they wear are not modelled");
  return {.ratio = std::min(end / start, 1.0), .depth = number_of(run_in, "depth")};
}

bearing::SurfaceWear FilmReader::wear_of(const Value& wear, const std::string& surface) {
  bearing::SurfaceWear worn;
  const Value* given = wear.find(surface);
  if (given == nullptr || given->broken) return worn;
  if (const Value* lining = given->find("lining"); lining != nullptr && !lining->broken) worn.lining = lining->number;
  const Value* energy = given->find("energy_density");
  if (energy == nullptr) {
    worn.coefficient = number_of(*given, "coefficient");
    return worn;
  }
  if (energy->broken) return worn;
  if (film_.asperities.model != film::AsperityModel::none && film_.asperities.mu_friction == 0)
    context_.fault_at_key(*energy, "wear by work of friction without friction", "`asperities.friction` above 0",
                          "or give `coefficient`");
  worn.coefficient = film_.asperities.mu_friction / energy->number;
  return worn;
}

}  // namespace hersey::model
