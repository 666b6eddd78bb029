#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/film/film_solver.h"
#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/bearings/kinds/kinds.h"
#include "interpret/bearings/kinds/restrictors.h"
#include "schema/bearing_keys.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {

void interpret_bearings(Context& context) {
  const std::vector<KindReader> kinds = bearing_kinds();
  for (const auto& [name, value] : section(context.root, "bearings")) {
    const std::string& tag = value.text;
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&tag](const KindReader& k) { return k.kind == tag; });
    if (kind == kinds.end()) continue;  // an unknown kind has been reported
    Bearing bearing;
    bearing.name = name;
    bearing.position = value.key_position;
    kind->read(context, value, bearing);
    bearing.solver = meaning_of(value, "solver", film_solver_words, {}).value_or(film::usual_solver(bearing.film.grid));
    complete_restrictors(context, value, bearing);
    bearing.coupling = coupling_of(value);
    kind->read_point(context, value, bearing);
    context.model.bearings.push_back(std::move(bearing));
  }
  check_worn_groups(context);
}

namespace {

/// Kind of the films of a bearing of several, whose short names it has.
std::string kind_of_films(const std::string& kind) {
  if (kind == "tilting_pad" || kind == "floating_ring") return "journal";
  return kind == "tilting_pad_thrust" ? "thrust" : kind;
}

/// Short names of a bearing of several films: those of the films' kind that it has, and its own.
ShortNames names_of_composite(ShortNames names, const std::string& kind, const std::string& bearing) {
  const std::string path = "bearings." + bearing + ".", point = path + "operating_point.";
  std::erase_if(names.paths, [&](const auto& name) {
    const bool is_of_a_film =
        kind == "floating_ring" && name.second.starts_with(path) && !name.second.starts_with(point);
    return is_of_a_film || name.first == "shell_speed" || name.first == "radial_velocity" ||
           name.first == "approach_speed";
  });
  names.paths.emplace_back("whirl_ratio", point + "whirl_ratio");
  if (kind == "tilting_pad") names.paths.emplace_back("preload", path + "pads.preload");
  if (kind == "tilting_pad_thrust") names.paths.emplace_back("offset", path + "pads.offset");
  if (kind != "floating_ring") return names;
  for (const std::string film : {"inner", "outer"}) {
    names.paths.emplace_back(film + "_clearance", path + film + ".radial_clearance");
    names.paths.emplace_back(film + "_width", path + film + ".width");
  }
  return names;
}

const KindReader& reader_of(const std::string& kind) {
  static const std::vector<KindReader> kinds = bearing_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const KindReader& k) { return k.kind == kind; });
  HERSEY_REQUIRE(found != kinds.end(), "every kind of bearing has a reader");
  return *found;
}

}  // namespace

ShortNames short_names(const Model& model, const Bearing& bearing) {
  const ShortNames names = reader_of(bearing.kind->name()).short_names(model, bearing);
  for (const Composite& composite : model.composites)
    if (&composite.bearing == &bearing) return names_of_composite(names, composite.kind, bearing.name);
  return names;
}

std::optional<BearingKindNames> names_of_kind(const std::string& kind, const std::string& bearing,
                                              const std::string& lubricant) {
  const std::vector<BearingKindFormat>& formats = bearing_kind_formats();
  const std::string& tag = kind.empty() ? formats.front().tag : kind;
  const auto format = std::find_if(formats.begin(), formats.end(), [&](const auto& each) { return each.tag == tag; });
  if (format == formats.end()) return std::nullopt;
  const KindReader& reader = reader_of(kind_of_films(tag));
  BearingKindNames names{.kind = tag, .title = format->title, .point_keys = {}, .short_names = {}};
  if (const Key* point = find_key(format->keys, "operating_point"))
    for (const Key* key : all_keys(*point->type)) names.point_keys.push_back(key->name);
  Bearing stand_in;
  stand_in.name = bearing;
  stand_in.lubricant = lubricant;
  names.short_names = reader.short_names(Model{}, stand_in);
  if (reader.kind != tag) names.short_names = names_of_composite(std::move(names.short_names), tag, bearing);
  return names;
}

}  // namespace hersey::model
