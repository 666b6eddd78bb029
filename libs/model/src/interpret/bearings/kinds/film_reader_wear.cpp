#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "hersey/core/two_pi.h"
#include "interpret/bearings/kinds/film_reader.h"
#include "schema/film_vocabulary.h"

// Wear of both surfaces of a bearing.
namespace hersey::model {
namespace {

/// Number of lines around a whole journal that lie as close as those of a film.
long lines_around(const film::Grid& grid) {
  double covered = 0;
  int intervals = 0;
  for (int i = 0; i < grid.n_phi; ++i) {
    const int next = grid.next(i);
    if (next < 0) continue;
    ++intervals;
    covered += grid.phi(next) - grid.phi(i) + (next > i ? 0 : two_pi);
  }
  return std::lround(intervals * two_pi / covered);
}

/// Names what differs between films that are to wear one moving surface; empty where they can.
std::string difference(const Bearing& one, const Bearing& other) {
  if (one.kind->name() != other.kind->name()) return "another kind";
  if (one.journal.body != other.journal.body || one.journal.frame != other.journal.frame)
    return "another " + one.kind->moving_surface();
  if (one.film.R != other.film.R || one.film.L != other.film.L) return "another size";
  if (one.film.grid.n_z != other.film.grid.n_z || one.film.grid.heights != other.film.grid.heights)
    return "other rows of its grid";
  if (one.wear->around != other.wear->around) return "another `around`";
  if (one.wear->acceleration != other.wear->acceleration) return "another `acceleration`";
  const bool is_local = one.wear->around == bearing::WearAround::local;
  return is_local && lines_around(one.film.grid) != lines_around(other.film.grid)
             ? "other distances of its grid's lines"
             : "";
}

}  // namespace

void check_worn_groups(Context& context) {
  const std::vector<Bearing>& bearings = context.model.bearings;
  for (const auto& [name, value] : section(context.root, "bearings")) {
    const auto is_named = [&wanted = name](const Bearing& bearing) { return bearing.name == wanted; };
    const auto own = std::find_if(bearings.begin(), bearings.end(), is_named);
    if (own == bearings.end() || !own->wear || own->worn_group.empty() || context.has_fault_in(value.path)) continue;
    const auto first = std::find_if(bearings.begin(), own, [&](const Bearing& bearing) {
      return bearing.wear && bearing.worn_group == own->worn_group;
    });
    if (first == own || context.has_fault_in("bearings." + first->name)) continue;
    if (const std::string differs = difference(*own, *first); !differs.empty())
      context.fault(*value.find("wear")->find(own->kind->moving_surface())->find("group"),
                    fmt::format("a film with {} than bearing '{}' of that group", differs, first->name),
                    "films of one surface, with the same size, rows and way of wearing it");
  }
}

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
  if (const Value* moving = wear->find(surfaces_.moving); moving != nullptr && !moving->broken) {
    if (moving->has("around")) bearing_.wear->around = meaning_of(*moving, "around", wear_around_words);
    if (const Value* group = moving->find("group"); group != nullptr) bearing_.worn_group = group->text;
  }
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
