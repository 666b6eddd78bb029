#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/bearing/squeeze_film_damper.h"
#include "hersey/film/film_solver.h"
#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/bearings/kinds/journal_arcs.h"
#include "interpret/bearings/kinds/kinds.h"
#include "schema/film_vocabulary.h"

// A journal in a bore, from the values of its mapping.
namespace hersey::model {
namespace {

/// The film of a journal bearing.
class JournalFilmReader {
 public:
  JournalFilmReader(Context& context, const Value& value, Bearing& bearing)
      : context_(context), value_(value), bearing_(bearing), film_(bearing.film), reader_(context, value, bearing) {}

  void read() {
    film_.R = number_of(value_, "diameter") / 2;
    film_.L = number_of(value_, "width");
    film_.c = value_.find("diametral_clearance") != nullptr ? number_of(value_, "diametral_clearance") / 2
                                                            : number_of(value_, "radial_clearance");
    reader_.set_surfaces({.size = film_.R});
    check_clearance();
    reader_.read_lubricant();
    reader_.read_cavitation();
    read_edges();
    read_ambient_fill();
    read_supply();
    read_arcs(context_, value_, bearing_, reader_);
    read_surfaces(context_, value_, bearing_);
    if (const Value* most = value_.find("permissible_pressure"); most != nullptr && !most->broken)
      bearing_.permissible_pressure = most->number;
    reader_.read_contact();
    read_thermal(context_, value_, reader_.lubricant(), bearing_);
    reader_.read_pressure_scale();
    reader_.read_shear();
    check_with_arcs(context_, value_, bearing_);
    if (context_.has_fault_in(value_.path)) return;
    require_a_pressure();
    if (!film::is_closed(film_) || has_open_ends()) reader_.warn_of_starvation(edges());
  }

 private:
  /// Between closed edges the pressure is known up to a constant only, unless something holds it.
  void require_a_pressure() {
    if (!film::is_closed(film_) || film_.supply.kind != film::SupplyKind::none || has_open_ends()) return;
    for (const film::SurfaceFeature& feature : film_.features) {
      if (feature.is_fed) return;
    }
    context_.fault_at_key(*value_.find("edge_pressure"), "closed edges and no supply: the pressure is given nowhere",
                          "a 'supply', or a hole or groove with a pressure in 'features'");
  }

  [[nodiscard]] bool has_open_ends() const {
    return std::any_of(film_.ends.begin(), film_.ends.end(), [](const film::PatchEnds& ends) {
      return ends.first.kind == film::EdgeKind::pressure || ends.last.kind == film::EdgeKind::pressure;
    });
  }

  /// Lubrication theory takes the gap to be thin: a clearance of the bearing's own size is a wrong unit.
  void check_clearance() {
    const Value* clearance = value_.find("radial_clearance");
    if (clearance == nullptr) clearance = value_.find("diametral_clearance");
    if (clearance == nullptr || clearance->broken || film_.R <= 0) return;
    if (film_.c < 0.1 * film_.R) return warn_of_clearance(*clearance);
    context_.fault(*clearance, "a clearance of more than a tenth of the radius",
                   "a thin gap: common are radial clearances of 0.0005 to 0.002 radii");
  }

  /// A value far from that of any bearing is most often a wrong unit, or a diametral clearance given as the radial one.
  void warn_of_clearance(const Value& clearance) {
    constexpr double kSmallest = 2e-4, kLargest = 1e-2;
    const double psi = film_.c / film_.R;
    if (psi >= kSmallest && psi <= kLargest) return;
    context_.model.warnings.push_back(
        {clearance.position, clearance.path,
         fmt::format("a radial clearance of {:.3g} um, {:.2g} of the radius, far from what is usual", 1e6 * film_.c,
                     psi),
         fmt::format("0.0005 to 0.002 of the radius, {:.3g} to {:.3g} um", 5e2 * film_.R, 2e3 * film_.R),
         "is it in the right unit?"});
  }

  [[nodiscard]] std::vector<film::Edge> edges() const {
    std::vector<film::Edge> all{film_.edge_left, film_.edge_right};
    for (const film::PatchEnds& ends : film_.ends) all.insert(all.end(), {ends.first, ends.last});
    return all;
  }

  void read_edges() {
    const Value* edges = value_.find("edge_pressure");
    if (edges == nullptr || edges->broken || edges->members.empty()) return;
    const Value& content = edges->members.front().value;
    const bool is_pair = content.has("left") && content.has("right");
    film_.edge_left = reader_.edge_of(is_pair ? *content.find("left") : content);
    film_.edge_right = is_pair ? reader_.edge_of(*content.find("right")) : film_.edge_left;
  }

  /// What comes in over an edge at the cavitation pressure. Elsewhere it has no meaning.
  void read_ambient_fill() {
    const Value* fill = value_.find("ambient_fill");
    if (fill == nullptr || fill->broken || fill->members.empty()) return;
    const Value& content = fill->members.front().value;
    const bool is_pair = content.find("left") != nullptr && content.find("right") != nullptr;
    const Value& left = is_pair ? *content.find("left") : content;
    const Value& right = is_pair ? *content.find("right") : content;
    const auto is_wall = [](const film::Edge& edge) { return edge.kind != film::EdgeKind::pressure; };
    if ((is_wall(film_.edge_left) && is_wall(film_.edge_right)) ||
        (is_pair &&
         ((is_wall(film_.edge_left) && left.number > 0) || (is_wall(film_.edge_right) && right.number > 0)))) {
      context_.fault_at_key(*fill, "oil outside edges that are closed or sealed",
                            "edge_pressure: a pressure, or no ambient_fill");
      return;
    }
    if (!is_wall(film_.edge_left)) film_.edge_left.ambient_fill = left.number;
    if (!is_wall(film_.edge_right)) film_.edge_right.ambient_fill = right.number;
    if (!film::cavitation_law(film_).has_fill()) {
      context_.fault_at_key(*fill, "a fill fraction outside a film that has none inside",
                            "cavitation: mass_conserving, or no ambient_fill");
      return;
    }
    const auto check = [&](const Value& given, double pressure) {
      if (given.broken || given.number == 1 || pressure <= film_.p_cav) return;
      context_.fault(given, fmt::format("{:g} at an edge above the cavitation pressure", given.number),
                     "1: such an edge is flooded", "or the cavitation pressure as this edge's pressure");
    };
    if (is_pair) {
      check(left, film_.edge_left.pressure);
      check(right, film_.edge_right.pressure);
    } else {
      check(content, std::max(film_.edge_left.pressure, film_.edge_right.pressure));
    }
  }

  void read_supply() {
    const Value* supply = value_.find("supply");
    if (supply == nullptr || supply->broken) return;
    const Value* line = supply->find("line");
    if (line == nullptr || line->broken) return;
    film_.supply.kind = line->text == "widest_gap" ? film::SupplyKind::widest_gap : film::SupplyKind::fixed_angle;
    film_.supply.phi = line->number;
    film_.supply.pressure = number_of(*supply, "pressure");
    if (const Value* pressure = supply->find("pressure")) require_above_cavitation(context_, *pressure, film_);
  }

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
  FilmReader reader_;
};

/// Of the undeformed surfaces.
double smallest_gap(const film::FilmModel& film, const JournalPoint& point, double epsilon) {
  bearing::ParameterVector position = bearing::ParameterVector::Zero();
  position[bearing::kEx] = epsilon * film.c * std::cos(point.eccentricity_angle);
  position[bearing::kEy] = epsilon * film.c * std::sin(point.eccentricity_angle);
  position[bearing::kTx] = std::tan(point.tilt_x), position[bearing::kTy] = std::tan(point.tilt_y);
  position[bearing::kRotation] = point.journal_angle;
  return bearing::smallest_gap(film, position);
}

/// A tilted journal, or one beside a narrow region of the bore, may touch the shell at an edge although its middle is
/// inside the bore.
void check_room(Context& context, const std::string& bearing_path, const Value& value, const film::FilmModel& film,
                const JournalPoint& point) {
  const double epsilon = point.eccentricity_ratio.value_or(0);
  if (context.has_fault_in(bearing_path) || film.c <= 0 || film.L <= 0 || smallest_gap(film, point, epsilon) > 0)
    return;
  context.fault_at_key(value, "a journal that touches the shell", "a position and a tilt that leave a gap everywhere",
                       "reduce tilt_x, tilt_y, eccentricity_ratio or the shape");
}

std::optional<JournalPoint> operating_point_of(Context& context, const Value& bearing, const film::FilmModel& film) {
  const Value* value = bearing.find("operating_point");
  if (value == nullptr || value->broken) return std::nullopt;
  JournalPoint point;
  point.position = value->key_position;
  point.journal_speed = number_of(*value, "journal_speed");
  point.shell_speed = number_of(*value, "shell_speed");
  const Value *load = given(*value, "load"), *ratio = given(*value, "eccentricity_ratio");
  if (load != nullptr) point.load = load->number, require_bearable(context, *load, 2 * film.R * film.L);
  if (ratio != nullptr) point.eccentricity_ratio = ratio->number;
  point.load_angle = number_of(*value, "load_angle");
  point.eccentricity_angle = number_of(*value, "eccentricity_angle");
  point.radial_velocity = number_of(*value, "radial_velocity");
  point.journal_angle = number_of(*value, "journal_angle");
  point.tilt_x = number_of(*value, "tilt_x");
  point.tilt_y = number_of(*value, "tilt_y");
  if (load == nullptr && ratio == nullptr) {
    context.fault_at_key(*value, "neither 'load' nor 'eccentricity_ratio'", "exactly one of them");
  } else if (load != nullptr && ratio != nullptr) {
    context.fault_at_key(*ratio, "keys 'load' and 'eccentricity_ratio' together", "exactly one of them",
                         "with --set, give the other one as 'none'");
  }
  if (!context.has_fault_in(value->path) && load != nullptr && point.radial_velocity != 0) {
    context.fault(*value->find("radial_velocity"), "a velocity along a position that is sought",
                  "a radial_velocity with an eccentricity_ratio", "its load is found");
  }
  const bool is_smooth = film.asperities.model == film::AsperityModel::none;
  const bool rests = point.journal_speed + point.shell_speed == 0 && point.radial_velocity == 0;
  const bool is_fed = std::any_of(film.features.begin(), film.features.end(), [](const auto& f) { return f.is_fed; });
  if (!context.has_fault_in(value->path) && is_smooth && !is_fed && rests) {
    context.fault(*value->find("journal_speed"), "speeds that drag no oil into the gap (their sum is 0)",
                  "surfaces that carry oil: half the sum of both speeds does, a radial_velocity presses it out",
                  "rough surfaces bear loads at rest: asperities");
  }
  if (!film.ends.empty() && point.shell_speed != 0)
    context.fault(*value->find("shell_speed"), "a bore of arcs that turns under its load",
                  "0 rpm: the film of arcs that turn is never steady", "a simulation turns it");
  if (!context.has_fault_in(value->path)) check_room(context, bearing.path, *value, film, point);
  return point;
}

}  // namespace

namespace {

/// The added mass belongs to small motions of rigid surfaces. In a machine in motion the forces of a film that drags
/// oil are those without inertia; a damper's kind decides for itself.
void check_inertia(Context& context, const Value& value, const Bearing& bearing) {
  if (bearing.oil_inertia == OilInertia::none) return;
  const Value& inertia = *value.find("oil_inertia");
  if (bearing.shell_surface || bearing.journal_surface)
    context.fault(inertia, "inertia of the oil between surfaces that deform", "none, or rigid surfaces");
  if (!bearing.shell.body.empty() && !bearing::is_damper(*bearing.kind))
    context.model.warnings.push_back(
        {inertia.position, inertia.path, "inertia of the oil in a machine, whose motion does not feel it",
         "`hersey bearing`, which reports the added mass", "add that mass to the journal's body"});
}

}  // namespace

void read_journal(Context& context, const Value& value, Bearing& bearing) {
  read_frames(context, value, {}, bearing);
  JournalFilmReader(context, value, bearing).read();
  bearing.shell_surface = deforming_surface_of(context, value, "shell", bearing.shell, bearing.film);
  bearing.journal_surface = deforming_surface_of(context, value, "journal", bearing.journal, bearing.film);
  require_facing_surfaces(context, value, bearing);
  bearing.oil_inertia = meaning_of(value, "oil_inertia", oil_inertia_words);
  check_inertia(context, value, bearing);
  bearing.heated_shell = heated_shell_of(context, value, bearing);
  bearing.heated_journal = heated_journal_of(context, value, bearing);
}

void read_journal_point(Context& context, const Value& value, Bearing& bearing) {
  film::FilmModel hot = bearing.film;
  hot.c += bearing.growth;
  if (auto point = operating_point_of(context, value, hot)) bearing.operating_point = *point;
}

ShortNames journal_short_names(const Model& model, const Bearing& bearing) {
  const std::string path = "bearings." + bearing.name + ".", point = path + "operating_point.";
  const bool is_diametral = model.positions.contains(path + "diametral_clearance");
  return {.paths = {{"speed", point + "journal_speed"},
                    {"shell_speed", point + "shell_speed"},
                    {"load", point + "load"},
                    {"load_angle", point + "load_angle"},
                    {"eccentricity_ratio", point + "eccentricity_ratio"},
                    {"eccentricity_angle", point + "eccentricity_angle"},
                    {"radial_velocity", point + "radial_velocity"},
                    {"clearance", path + (is_diametral ? "diametral_clearance" : "radial_clearance")},
                    {"width", path + "width"},
                    {"diameter", path + "diameter"},
                    {"viscosity", "lubricants." + bearing.lubricant + ".viscosity"}},
          .load_or_position = {"load", "eccentricity_ratio"}};
}

}  // namespace hersey::model
