#include "hersey/bearing/squeeze_film_damper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/bearings/kinds/kinds.h"

// A squeeze-film damper: the film of a journal with an operating point of its own.
namespace hersey::model {
namespace {

/// Says what of a damper differs around the bore, so that no axes rotate with an orbit in which its film is steady;
/// empty if nothing does.
std::string difference_around(const Bearing& bearing) {
  const film::FilmModel& film = bearing.film;
  if (!film.grid.closes()) return "a bore of arcs";
  if (!film.profiles.empty()) return "a 'shape'";
  if (film.supply.kind == film::SupplyKind::fixed_angle) return "a supply line at an angle";
  for (const film::SurfaceFeature& feature : film.features) {
    const bool goes_around = film::has_straight_ends(feature) && feature.arc >= 2 * std::numbers::pi * (1 - 1e-9);
    if (!goes_around) return "'" + feature.name + "', which does not go all around";
  }
  return "";
}

bool has_pressure(const film::FilmModel& film) {
  if (film::cavitation_law(film).bears_tension()) return true;
  const auto is_above = [&](double pressure) { return pressure > film.p_cav; };
  return is_above(film.edge_left.pressure) || is_above(film.edge_right.pressure) ||
         (film.supply.kind != film::SupplyKind::none && is_above(film.supply.pressure)) ||
         std::any_of(film.features.begin(), film.features.end(),
                     [&](const auto& feature) { return feature.is_fed && is_above(feature.pressure); });
}

/// In a machine the motion feels the inertia of a film that is the same all around (damper.12).
void read_inertia_in_motion(Context& context, const Value& value, Bearing& bearing) {
  if (bearing.oil_inertia == OilInertia::none || bearing.shell.body.empty()) return;
  const bool has_line = bearing.film.supply.kind != film::SupplyKind::none;
  const std::string differs = has_line ? "a supply line" : difference_around(bearing);
  bearing.moves_with_inertia = differs.empty();
  const Value& inertia = *value.find("oil_inertia");
  if (!differs.empty())
    context.model.warnings.push_back({inertia.position, inertia.path,
                                      "inertia of the oil in a bore with " + differs + ", which a motion does not feel",
                                      "a bore that is the same all around, fed by full grooves or over its edges",
                                      "add the mass that `hersey bearing` reports to the journal's body"});
}

}  // namespace

void read_squeeze_film_damper(Context& context, const Value& value, Bearing& bearing) {
  bearing.kind = bearing::squeeze_film_damper_kind();
  read_journal(context, value, bearing);
  read_inertia_in_motion(context, value, bearing);
}

void read_squeeze_film_damper_point(Context& context, const Value& bearing_value, Bearing& bearing) {
  const Value* value = bearing_value.find("operating_point");
  if (value == nullptr || value->broken) return;
  DamperPoint point;
  point.position = value->key_position;
  point.whirl_speed = number_of(*value, "whirl_speed");
  point.orbit_ratio = number_of(*value, "orbit_ratio");
  point.eccentricity_ratio = number_of(*value, "eccentricity_ratio");
  point.eccentricity_angle = number_of(*value, "eccentricity_angle");
  if (context.has_fault_in(value->path)) return;
  const bool orbits = point.orbit_ratio > 0;
  if (point.whirl_speed == 0)
    context.fault(*value->find("whirl_speed"), "a journal that neither orbits nor vibrates", "a speed other than 0");
  if (orbits && point.eccentricity_ratio > 0)
    context.fault(*value->find("eccentricity_ratio"), "an orbit about another point than the bore's axis",
                  "0 with an orbit_ratio, or orbit_ratio: 0 for small motions about this position",
                  "a simulation follows any orbit");
  if (const std::string differs = difference_around(bearing); orbits && !differs.empty())
    context.fault(*value->find("orbit_ratio"), "an orbit in a bore with " + differs + ", whose film is never steady",
                  "a bore that is the same all around, or orbit_ratio: 0 for small motions",
                  "a simulation follows any orbit");
  if (bearing.shell_surface || bearing.journal_surface)
    context.fault_at_key(*value, "an orbit between surfaces that deform",
                         "rigid surfaces: how fast they follow is part of a motion", "a simulation follows it");
  if (!std::holds_alternative<std::monostate>(bearing.heat))
    context.fault_at_key(*value, "an orbit of a film with temperatures", "`thermal: isothermal` at a given temperature",
                         "a simulation follows them");
  if (!orbits && !has_pressure(bearing.film))
    context.fault_at_key(*value, "small motions of a film without pressure, half of which cavitates at once",
                         "a pressure above that of cavitation at an edge or a feed, `cavitation: full_film`, or an "
                         "orbit_ratio");
  if (!context.has_fault_in(value->path)) bearing.operating_point = point;
}

ShortNames squeeze_film_damper_short_names(const Model& model, const Bearing& bearing) {
  const std::string path = "bearings." + bearing.name + ".", point = path + "operating_point.";
  const bool is_diametral = model.positions.contains(path + "diametral_clearance");
  return {.paths = {{"whirl_speed", point + "whirl_speed"},
                    {"orbit_ratio", point + "orbit_ratio"},
                    {"eccentricity_ratio", point + "eccentricity_ratio"},
                    {"eccentricity_angle", point + "eccentricity_angle"},
                    {"clearance", path + (is_diametral ? "diametral_clearance" : "radial_clearance")},
                    {"width", path + "width"},
                    {"diameter", path + "diameter"},
                    {"viscosity", "lubricants." + bearing.lubricant + ".viscosity"}},
          .load_or_position = {}};
}

}  // namespace hersey::model
