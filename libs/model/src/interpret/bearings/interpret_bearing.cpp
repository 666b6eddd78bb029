#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/film/film_solver.h"
#include "interpret/context/interpret.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {
namespace {

std::optional<fem::ElasticMaterial> material_of(const Value& bearing, const std::string& key) {
  const Value* materials = bearing.find("materials");
  const Value* value = materials != nullptr ? materials->find(key) : nullptr;
  if (value == nullptr || value->broken) return std::nullopt;
  fem::ElasticMaterial material{number_of(*value, "youngs_modulus"), number_of(*value, "poisson_ratio"),
                                number_of(*value, "density")};
  const bool is_usable = material.youngs_modulus > 0 && -1 < material.poisson_ratio && material.poisson_ratio < 0.5;
  return is_usable ? std::optional(material) : std::nullopt;
}

/// Radii: a housing as thick as that still is one.
constexpr double kLongestColumn = 100;

/// The film of one bearing, from the values of its mapping.
class FilmReader {
 public:
  FilmReader(Context& context, const Value& value, Bearing& bearing)
      : context_(context), value_(value), bearing_(bearing), film_(bearing.film) {}

  void read() {
    film_.R = number_of(value_, "diameter") / 2;
    film_.L = number_of(value_, "width");
    film_.c = value_.find("diametral_clearance") != nullptr ? number_of(value_, "diametral_clearance") / 2
                                                            : number_of(value_, "radial_clearance");
    check_clearance();
    read_lubricant();
    read_cavitation();
    read_edges();
    read_ambient_fill();
    read_supply();
    read_surfaces(context_, value_, bearing_);
    if (const Value* most = value_.find("permissible_pressure"); most != nullptr && !most->broken)
      bearing_.permissible_pressure = most->number;
    read_roughness();
    read_asperities();
    read_compliance();
    require_use_of_materials();
    read_thermal(context_, value_, lubricant_, bearing_);
    check_pressure_scale();
    film_.cavitated_shear = meaning_of(value_, "cavitated_shear", cavitated_shear_words);
    film_.shear_force = meaning_of(value_, "shear_force", shear_force_words);
    if (context_.has_fault_in(value_.path)) return;
    require_a_pressure();
    warn_of_starvation();
  }

 private:
  /// Between closed edges the pressure is known up to a constant only, unless something holds it.
  void require_a_pressure() {
    if (!film::is_closed(film_) || film_.supply.kind != film::SupplyKind::none) return;
    for (const film::SurfaceFeature& feature : film_.features) {
      if (feature.is_fed) return;
    }
    context_.fault_at_key(*value_.find("edge_pressure"), "closed edges and no supply: the pressure is given nowhere",
                          "a 'supply', or a hole or groove with a pressure in 'features'");
  }

  /// With mass conserved, oil that nothing presses in above the cavitation pressure does not come back where the film
  /// has once ruptured: the steady film is p = p_cav everywhere and bears nothing.
  void warn_of_starvation() {
    if (!film::cavitation_law(film_).has_fill() || film::is_closed(film_)) return;
    for (const film::Edge& edge : {film_.edge_left, film_.edge_right}) {
      if (edge.kind == film::EdgeKind::pressure && edge.pressure > film_.p_cav) return;
    }
    if (film_.supply.kind != film::SupplyKind::none) return;
    for (std::size_t f = 0; f < film_.features.size(); ++f) {
      const bool varies = !bearing_.feature_pressures[f].is_constant();
      if (film_.features[f].is_fed && (varies || film_.features[f].pressure >= film_.p_cav)) return;
    }
    const Value* edges = value_.find("edge_pressure");
    context_.model.warnings.push_back(
        {edges != nullptr && edges->given ? edges->position : value_.key_position, value_.path,
         "a film that starves: its edges are at the cavitation pressure and nothing feeds it, so that oil lost over "
         "the "
         "edges never comes back",
         "a 'supply', a hole or groove in 'features', or an edge_pressure above cavitation.pressure",
         "with gauge pressures, cavitation is often near -1 bar"});
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

  void read_lubricant() {
    const Value* name = value_.find("lubricant");
    if (name == nullptr) return;
    bearing_.lubricant = name->text;
    require_name(context_, *name, "lubricants", "lubricant");
    for (const Lubricant& lubricant : context_.model.lubricants) {
      if (lubricant.name != name->text) continue;
      lubricant_ = &lubricant;
      film_.lubricant = lubricant.data;
    }
  }

  void read_cavitation() {
    const Value* cavitation = value_.find("cavitation");
    if (cavitation == nullptr || cavitation->broken) return;
    film_.p_cav = number_of(*cavitation, "pressure");
    film_.cavitation = meaning_of(*cavitation, cavitation_words);
  }

  void read_edges() {
    const Value* edges = value_.find("edge_pressure");
    if (edges == nullptr || edges->broken || edges->members.empty()) return;
    const Value& content = edges->members.front().value;
    const bool is_pair = content.find("left") != nullptr && content.find("right") != nullptr;
    film_.edge_left = edge_of(is_pair ? *content.find("left") : content);
    film_.edge_right = is_pair ? edge_of(*content.find("right")) : film_.edge_left;
  }

  [[nodiscard]] film::Edge edge_of(const Value& outside) {
    // Nothing flows over a wall; so that its row has a pressure to start from, it is that of cavitation.
    if (outside.text == "closed") return {.kind = film::EdgeKind::closed, .pressure = film_.p_cav};
    require_above_cavitation(context_, outside, film_);
    return {.pressure = outside.number};
  }

  /// What comes in over an edge at the cavitation pressure. Elsewhere it has no meaning.
  void read_ambient_fill() {
    const Value* fill = value_.find("ambient_fill");
    if (fill == nullptr || fill->broken || fill->members.empty()) return;
    const Value& content = fill->members.front().value;
    const bool is_pair = content.find("left") != nullptr && content.find("right") != nullptr;
    const Value& left = is_pair ? *content.find("left") : content;
    const Value& right = is_pair ? *content.find("right") : content;
    const auto is_wall = [](const film::Edge& edge) { return edge.kind == film::EdgeKind::closed; };
    if (film::is_closed(film_) || (is_pair && ((is_wall(film_.edge_left) && left.number > 0) ||
                                               (is_wall(film_.edge_right) && right.number > 0)))) {
      context_.fault_at_key(*fill, "oil outside edges that are closed",
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

  /// No pressure lies below a vacuum. On the absolute scale a default of 0 would be one: edges have to be given.
  void check_pressure_scale() {
    film_.pressures = meaning_of(value_, "pressures", pressure_scale_words);
    const bool absolute = film_.pressures == film::PressureScale::absolute;
    const double vacuum = absolute ? 0 : -101325;
    const Value* edges = value_.find("edge_pressure");
    if (absolute && edges != nullptr && !edges->given) {
      context_.fault_at_key(*value_.find("pressures"), "absolute pressures without 'edge_pressure'",
                            "the pressure outside both edges", "edge_pressure: 1.013 bar is the atmosphere");
    }
    const Value* cavitation = value_.find("cavitation");
    const Value* pressure = cavitation != nullptr && !cavitation->broken ? cavitation->find("pressure") : nullptr;
    // All others are known to lie above it.
    if (pressure == nullptr || pressure->broken || pressure->number >= vacuum) return;
    context_.fault(*pressure, fmt::format("{:g} bar, below a vacuum", 1e-5 * pressure->number),
                   absolute ? "an absolute pressure of at least 0" : "a gauge pressure of at least -1.01325 bar",
                   absolute ? "pressures: gauge counts from the atmosphere" : "");
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

  void read_roughness() {
    const Value* roughness = value_.find("roughness");
    if (roughness == nullptr || roughness->broken) return;
    film_.roughness.flow_factors = meaning_of(*roughness, "flow_factors", flow_factor_words);
    const auto surface = [&](const char* key, film::SurfaceRoughness& target) {
      const Value* given = roughness->find(key);
      if (given != nullptr && !given->broken) target = {number_of(*given, "sigma"), number_of(*given, "gamma")};
    };
    surface("shell", film_.roughness.shell);
    surface("journal", film_.roughness.journal);
    if (context_.has_fault_in(roughness->path)) return;
    if (film_.roughness.composite_sigma() == 0) {
      context_.fault_at_key(*roughness, "neither 'shell' nor 'journal'", "at least one of them, with its sigma");
    } else if (film_.c > 0 && 3 * film_.roughness.composite_sigma() > film_.c) {
      context_.fault_at_key(*roughness,
                            fmt::format("a roughness of {:.3g} um in a clearance of {:.3g} um",
                                        1e6 * film_.roughness.composite_sigma(), 1e6 * film_.c),
                            "at most a third of the clearance: else the surfaces touch all around");
    }
  }

  void read_asperities() {
    const Value* asperities = value_.find("asperities");
    if (asperities == nullptr || asperities->broken) return;
    film_.asperities.model = meaning_of(*asperities, asperity_words);
    if (film_.asperities.model == film::AsperityModel::none) return;
    if (asperities->find("roughness") != nullptr) {
      film_.asperities.sigma = number_of(*asperities, "roughness");
    } else if (value_.find("roughness") != nullptr) {
      film_.asperities.sigma = film_.roughness.composite_sigma();
    } else {
      context_.fault_at_key(*asperities, "missing key 'roughness'", "a length > 0, such as 1 um",
                            "or give the bearing's roughness, surface by surface");
    }
    read_summits(*asperities);
    film_.asperities.elastic_factor = number_of(*asperities, "elastic_factor");
    film_.asperities.mu_friction = number_of(*asperities, "friction");
    film_.asperities.composite_modulus = composite_modulus_of(*asperities).value_or(0);
  }

  void read_summits(const Value& asperities) {
    film::Asperities& rough = film_.asperities;
    rough.mean_summit_height = number_of(asperities, "mean_summit_height");
    if (context_.has_fault_in(asperities.path) || rough.mean_summit_height <= 4 * rough.sigma) return;
    context_.fault(*asperities.find("mean_summit_height"),
                   fmt::format("{:.4g} um, {:.3g} times the summits' roughness", 1e6 * rough.mean_summit_height,
                               rough.mean_summit_height / rough.sigma),
                   "at most 4 times: higher ones would press on each other far apart");
  }

  void read_compliance() {
    const Value* compliance = value_.find("compliance");
    if (compliance == nullptr || compliance->broken || compliance->text == "rigid") return;
    const std::optional<double> modulus = composite_modulus_of(*compliance);
    const Value* length = compliance->find("length");
    if (length != nullptr && !length->broken && film_.R > 0 && length->number > kLongestColumn * film_.R)
      context_.fault(
          *length, fmt::format("{:.3g} m, {:.3g} times the bearing's radius", length->number, length->number / film_.R),
          fmt::format("at most {:g} times the radius: columns represent a lining or a housing", kLongestColumn));
    if (modulus) film_.compliance = (length != nullptr ? length->number : film_.R) / *modulus;
  }

  /// Moduli of `materials` count only where no composite modulus is given: both would contradict each other, or hide a
  /// slip.
  void require_use_of_materials() {
    const Value* materials = value_.find("materials");
    if (materials == nullptr || materials->broken || takes_materials_) return;
    const auto shares_heat = [&](const char* surface) {
      const Value* material = materials->find(surface);
      return material != nullptr && !material->broken && material->has("conductivity");
    };
    const bool serves_heat = shares_heat("shell") || shares_heat("journal");
    const auto warn = [&](const char* found, const char* expected) {
      context_.model.warnings.push_back({materials->key_position, materials->path, found, expected, ""});
    };
    if (given_modulus_ == nullptr) {
      if (!serves_heat)
        warn("materials that nothing takes: there are neither `asperities` nor a `compliance`",
             "one of these, or no materials");
    } else if (serves_heat) {
      warn("moduli that nothing takes: the `composite_modulus` that is given counts, and the materials share heat only",
           "no `composite_modulus` where that of the materials is meant");
    } else {
      context_.fault(*given_modulus_, "a composite modulus beside `materials`, whose moduli then would not count",
                     "one of both", "leave out `materials`, or `composite_modulus` where theirs is meant");
    }
  }

  /// The modulus given itself, or that of the two materials.
  std::optional<double> composite_modulus_of(const Value& parent) {
    if (const Value* modulus = parent.find("composite_modulus")) {
      given_modulus_ = modulus;
      return modulus->broken ? std::nullopt : std::optional(modulus->number);
    }
    takes_materials_ = true;
    if (bearing_.shell_material && bearing_.journal_material) {
      return fem::composite_modulus(*bearing_.shell_material, *bearing_.journal_material);
    }
    if (value_.find("materials") == nullptr) {
      context_.fault_at_key(parent, "missing key 'composite_modulus'", "an elastic modulus > 0, such as 57 GPa",
                            "or give the bearing's materials");
    }
    return std::nullopt;
  }

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
  const Lubricant* lubricant_ = nullptr;
  const Value* given_modulus_ = nullptr;  ///< a `composite_modulus`; null: none is given
  bool takes_materials_ = false;          ///< some modulus is to come from `materials`
};

Coupling coupling_of(const Value& bearing) {
  Coupling coupling;
  const Value* value = bearing.find("coupling");
  if (value == nullptr || value->text != "partitioned") return coupling;
  coupling.scheme = CouplingScheme::partitioned;
  coupling.relaxation = number_of(*value, "relaxation");
  coupling.acceleration = meaning_of(*value, "acceleration", acceleration_words);
  coupling.max_iterations = integer_of(*value, "max_iterations");
  return coupling;
}

/// A member that is there and not the word "none".
const Value* given(const Value& parent, const std::string& key) {
  const Value* value = parent.find(key);
  return value != nullptr && (value->broken || value->text != "none") ? value : nullptr;
}

/// Of the undeformed surfaces.
double smallest_gap(const film::FilmModel& film, const OperatingPoint& point, double epsilon) {
  bearing::ParameterVector position = bearing::ParameterVector::Zero();
  position[bearing::kEx] = epsilon * film.c * std::cos(point.eccentricity_angle);
  position[bearing::kEy] = epsilon * film.c * std::sin(point.eccentricity_angle);
  position[bearing::kTx] = std::tan(point.tilt_x), position[bearing::kTy] = std::tan(point.tilt_y);
  position[bearing::kRotation] = point.journal_angle;
  return bearing::smallest_gap(film, position);
}

/// Mean pressure on the projected area that no solid bears, whatever the film does: the elastic modulus of diamond.
constexpr double kHardest = 1e12;

/// A load beyond what any material bears is a slip of units, and looking for its position would take long.
void require_bearable(Context& context, const Value& load, const film::FilmModel& film) {
  const double area = 2 * film.R * film.L;
  if (load.broken || !(area > 0) || load.number <= kHardest * area) return;
  context.fault(load,
                fmt::format("{:.3g} N, {:.3g} Pa on the bearing's projected area", load.number, load.number / area),
                fmt::format("a load of at most {:.3g} N here: no solid bears 1e12 Pa", kHardest * area));
}

/// A tilted journal, or one beside a narrow region of the bore, may touch the shell at an edge although its middle is
/// inside the bore.
void check_room(Context& context, const std::string& bearing_path, const Value& value, const film::FilmModel& film,
                const OperatingPoint& point) {
  const double epsilon = point.eccentricity_ratio.value_or(0);
  if (context.has_fault_in(bearing_path) || film.c <= 0 || film.L <= 0 || smallest_gap(film, point, epsilon) > 0)
    return;
  context.fault_at_key(value, "a journal that touches the shell", "a position and a tilt that leave a gap everywhere",
                       "reduce tilt_x, tilt_y, eccentricity_ratio or the shape");
}

std::optional<OperatingPoint> operating_point_of(Context& context, const Value& bearing, const film::FilmModel& film) {
  const Value* value = bearing.find("operating_point");
  if (value == nullptr || value->broken) return std::nullopt;
  OperatingPoint point;
  point.position = value->key_position;
  point.journal_speed = number_of(*value, "journal_speed");
  point.shell_speed = number_of(*value, "shell_speed");
  const Value *load = given(*value, "load"), *ratio = given(*value, "eccentricity_ratio");
  if (load != nullptr) point.load = load->number, require_bearable(context, *load, film);
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
  if (!context.has_fault_in(value->path) && is_smooth && rests) {
    context.fault(*value->find("journal_speed"), "speeds that drag no oil into the gap (their sum is 0)",
                  "surfaces that carry oil: half the sum of both speeds does, a radial_velocity presses it out",
                  "rough surfaces bear loads at rest: asperities");
  }
  if (!context.has_fault_in(value->path)) check_room(context, bearing.path, *value, film, point);
  return point;
}

}  // namespace

void interpret_bearings(Context& context) {
  for (const auto& [name, value] : section(context.root, "bearings")) {
    Bearing bearing;
    bearing.name = name;
    bearing.position = value.key_position;
    if (const Value* shell = value.find("shell")) bearing.shell = frame_of(context, *shell);
    if (const Value* journal = value.find("journal")) {
      bearing.journal = frame_of(context, *journal);
      if (!bearing.journal.body.empty() && bearing.journal.body == bearing.shell.body) {
        context.fault(*journal, "shell and journal on body '" + bearing.shell.body + "'", "frames of two bodies");
      }
    }
    bearing.shell_material = material_of(value, "shell");
    bearing.journal_material = material_of(value, "journal");
    FilmReader(context, value, bearing).read();
    bearing.shell_surface = deforming_surface_of(context, value, "shell", bearing.shell, bearing.film);
    bearing.journal_surface = deforming_surface_of(context, value, "journal", bearing.journal, bearing.film);
    require_facing_surfaces(context, value, bearing);
    bearing.heated_shell = heated_shell_of(context, value, bearing);
    bearing.heated_journal = heated_journal_of(context, value, bearing);
    bearing.solver = value.find("solver") != nullptr ? meaning_of(value, "solver", film_solver_words)
                                                     : film::usual_solver(bearing.film.grid);
    bearing.coupling = coupling_of(value);
    film::FilmModel hot = bearing.film;
    hot.c += bearing.growth;
    bearing.operating_point = operating_point_of(context, value, hot);
    context.model.bearings.push_back(std::move(bearing));
  }
}

}  // namespace hersey::model
