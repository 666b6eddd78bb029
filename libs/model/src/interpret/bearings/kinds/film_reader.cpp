#include "interpret/bearings/kinds/film_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "hersey/film/film_solver.h"
#include "interpret/bearings/kinds/restrictors.h"
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

/// Taylor number at which vortices set in between a rotating journal and its bore (Taylor 1923).
constexpr double kTaylor = 41.2;

/// Mean pressure on the projected area that no solid bears, whatever the film does: the elastic modulus of diamond.
constexpr double kHardest = 1e12;

}  // namespace

FilmReader::FilmReader(Context& context, const Value& value, Bearing& bearing)
    : context_(context), value_(value), bearing_(bearing), film_(bearing.film) {}

void FilmReader::set_surfaces(SurfaceNames surfaces) {
  surfaces_ = std::move(surfaces);
  bearing_.shell_material = material_of(value_, surfaces_.fixed);
  bearing_.journal_material = material_of(value_, surfaces_.moving);
}

void FilmReader::read_lubricant() {
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

void FilmReader::read_cavitation() {
  const Value* cavitation = value_.find("cavitation");
  if (cavitation == nullptr || cavitation->broken) return;
  film_.p_cav = number_of(*cavitation, "pressure");
  film_.cavitation = meaning_of(*cavitation, cavitation_words);
  bearing_.initial_fill = number_of(value_, "initial_fill");
  if (bearing_.initial_fill < 1 && !film::cavitation_law(film_).has_fill())
    context_.fault_at_key(*value_.find("initial_fill"), "a dry start of a film that does not conserve oil",
                          "cavitation: mass_conserving, or no initial_fill");
}

film::Edge FilmReader::edge_of(const Value& outside) {
  if (outside.broken) return {.pressure = film_.p_cav};
  if (outside.type->kind == Type::Kind::any_of) return edge_of(outside.members.front().value);
  if (outside.has("leakage")) {
    const Value& behind = *outside.find("outside");
    require_above_cavitation(context_, behind, film_);
    return {.kind = film::EdgeKind::leaking, .pressure = behind.number, .leakage = number_of(outside, "leakage")};
  }
  // Nothing flows over a wall; so that its row has a pressure to start from, it is that of cavitation.
  if (outside.text == "closed") return {.kind = film::EdgeKind::closed, .pressure = film_.p_cav};
  require_above_cavitation(context_, outside, film_);
  return {.pressure = outside.number};
}

void FilmReader::read_edge_flow(const Value& flow, film::Edge& edge) {
  if (flow.broken) return;
  edge.flow = flow.number;
  if (edge.kind != film::EdgeKind::pressure || edge.pressure > film_.p_cav) {
    context_.fault(flow, "a flow to an edge that is not at the cavitation pressure",
                   "edge_pressure: that of `cavitation`, at which oil comes by itself");
  } else if (!film::cavitation_law(film_).has_fill()) {
    context_.fault(flow, "a flow to a film that does not conserve oil", "cavitation: mass_conserving, or no edge_flow");
  }
}

/// No pressure lies below a vacuum. On the absolute scale a default of 0 would be one: edges have to be given.
void FilmReader::read_pressure_scale() {
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

void FilmReader::read_shear() {
  film_.cavitated_shear = meaning_of(value_, "cavitated_shear", cavitated_shear_words);
  film_.shear_force = meaning_of(value_, "shear_force", shear_force_words);
  read_turbulence();
}

void FilmReader::read_turbulence() {
  const Value* turbulence = value_.find("turbulence");
  if (turbulence == nullptr || turbulence->broken) return;
  film::Turbulence& read = film_.turbulence;
  read.model = meaning_of(*turbulence, turbulence_words);
  if (!read.counts()) return;
  read.number = meaning_of(*turbulence, "transition", transition_words, film::TransitionNumber::reynolds);
  if (read.number == film::TransitionNumber::taylor) read.onset = kTaylor, read.full = 2 * kTaylor;
  if (turbulence->find("onset") != nullptr) read.onset = number_of(*turbulence, "onset");
  if (turbulence->find("full") != nullptr) read.full = number_of(*turbulence, "full");
  read.prandtl = number_of(*turbulence, "prandtl");
  if (!context_.has_fault_in(turbulence->path)) check_turbulence(*turbulence);
}

/// The friction is that of a Newtonian oil between smooth surfaces: the flow factors of rough ones are those of laminar
/// flow, and what shear thinning does to eddies is not known.
void FilmReader::check_turbulence(const Value& turbulence) {
  const film::Turbulence& read = film_.turbulence;
  if (read.onset >= read.full)
    context_.fault_at_key(turbulence,
                          fmt::format("turbulence that is full at {:g} and begins at {:g}", read.full, read.onset),
                          "an `onset` below `full`");
  if (read.number == film::TransitionNumber::taylor && !std::holds_alternative<film::Cylinder>(film_.surface))
    context_.fault(*turbulence.find("transition"), "a Taylor number of surfaces that are not round",
                   "transition: reynolds; Taylor's vortices are those between a journal and its bore");
  if (film_.roughness.counts())
    context_.fault_at_key(turbulence,
                          "turbulence together with flow factors of rough surfaces, which are those of a "
                          "laminar film",
                          "`flow_factors: none` in `roughness`, or `turbulence: none`");
  if (!film_.lubricant.shear_thinning.is_newtonian())
    context_.fault_at_key(turbulence, "turbulence of an oil that thins by shear, for which no law is known here",
                          "an oil without `shear_thinning`, or `turbulence: none`");
}

bool FilmReader::is_warm() const {
  const Value* thermal = value_.find("thermal");
  return thermal != nullptr && !thermal->broken && thermal->text == "film";
}

void FilmReader::read_heat() {
  read_flat_heat(context_, value_, {.fixed = surfaces_.fixed, .moving = surfaces_.moving}, lubricant_, bearing_);
}

void FilmReader::read_temperature() {
  const Value* T = value_.find("temperature");
  if (lubricant_ == nullptr || is_warm()) return;
  bearing_.validity = lubricant_->validity;
  if (T != nullptr && !T->broken) {
    warn_of_temperature(context_, *T, bearing_.validity, lubricant_->name);
    film_.lubricant = film::at_temperature(film_.lubricant, T->number);
  } else if (lubricant_->temperature) {
    film_.lubricant = film::at_temperature(film_.lubricant, *lubricant_->temperature);
  } else if (film::depends_on_temperature(film_.lubricant.temperature_law)) {
    context_.fault_at_key(
        value_, "an oil '" + lubricant_->name + "' whose viscosity falls with temperature, and no temperature",
        "a `temperature` of the lubricant or of this bearing");
  }
}

void FilmReader::require_gauge_pressures() {
  if (film_.pressures == film::PressureScale::gauge) return;
  context_.fault(*value_.find("pressures"), "absolute pressures, which would count the atmosphere below a pad as load",
                 "gauge, with `cavitation: {pressure: -1.01325 bar}` for a vacuum");
}

void FilmReader::read_feed(const Value& value, film::SurfaceFeature& feature) {
  const Value* pressure = value.find("pressure");
  const Value* node = value.find("circuit");
  feature.is_fed = pressure != nullptr || node != nullptr;
  if (!feature.is_fed && feature.depth == 0 && value.find("restrictor") == nullptr)
    context_.fault_at_key(value, "neither 'pressure' nor 'depth'", "a pressure that feeds it, a depth, or both");
  if (node != nullptr) read_port(*node, pressure, feature);
  bearing_.feature_pressures.push_back(pressure != nullptr ? function_of(context_, *pressure, "Pa")
                                                           : not_fed(value.path));
  const Function& given = bearing_.feature_pressures.back();
  if (pressure != nullptr && given.is_constant()) {
    Value constant = *pressure;
    constant.number = feature.pressure = given.value->value({});
    require_above_cavitation(context_, constant, film_);
  }
  read_restrictor(context_, value, given, feature);
}

// The pressure of the feature is the film's lowest until the circuit has one.
void FilmReader::read_port(const Value& node, const Value* pressure, film::SurfaceFeature& feature) {
  feature.pressure = film_.p_cav;
  if (pressure != nullptr) context_.fault(*pressure, "a pressure beside `circuit`, whose node has one", "one of both");
  if (const auto found = circuit_node(context_, node))
    bearing_.circuit_ports.push_back({.feature = bearing_.feature_pressures.size(), .node = *found});
  if (value_.find("coupling") != nullptr && value_.find("coupling")->text == "partitioned")
    context_.fault(*value_.find("coupling"),
                   "`partitioned` with a feed of the circuit, which is solved together with the film",
                   "coupling: monolithic");
}

Function FilmReader::not_fed(const std::string& path) const {
  return {std::make_shared<ConstantFunction>(film_.p_cav), {}, {}, {}, path};
}

/// With mass conserved, oil that nothing presses in above the cavitation pressure does not come back where the film
/// has once ruptured: the steady film is p = p_cav everywhere and bears nothing.
void FilmReader::warn_of_starvation(const std::vector<film::Edge>& edges_of_film) {
  if (!film::cavitation_law(film_).has_fill()) return;
  for (const film::Edge& edge : edges_of_film) {
    if (film::fill_outside(film_, edge) > 0) return;
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

void FilmReader::read_contact() {
  read_roughness();
  read_asperities();
  read_compliance();
  read_wear();
  require_use_of_materials();
}

void FilmReader::read_roughness() {
  const Value* roughness = value_.find("roughness");
  if (roughness == nullptr || roughness->broken) return;
  film_.roughness.flow_factors = meaning_of(*roughness, "flow_factors", flow_factor_words);
  const auto surface = [&](const std::string& key, film::SurfaceRoughness& target) {
    const Value* given = roughness->find(key);
    if (given != nullptr && !given->broken) target = {number_of(*given, "sigma"), number_of(*given, "gamma")};
  };
  surface(surfaces_.fixed, film_.roughness.shell);
  surface(surfaces_.moving, film_.roughness.journal);
  if (context_.has_fault_in(roughness->path)) return;
  if (film_.roughness.composite_sigma() == 0) {
    context_.fault_at_key(*roughness, "neither '" + surfaces_.fixed + "' nor '" + surfaces_.moving + "'",
                          "at least one of them, with its sigma");
  } else if (film_.c > 0 && 3 * film_.roughness.composite_sigma() > film_.c) {
    context_.fault_at_key(*roughness,
                          fmt::format("a roughness of {:.3g} um in a clearance of {:.3g} um",
                                      1e6 * film_.roughness.composite_sigma(), 1e6 * film_.c),
                          "at most a third of the clearance: else the surfaces touch all around");
  }
}

void FilmReader::read_asperities() {
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
  FilmReader::read_summits(*asperities);
  film_.asperities.elastic_factor = number_of(*asperities, "elastic_factor");
  film_.asperities.mu_friction = number_of(*asperities, "friction");
  film_.asperities.composite_modulus = composite_modulus_of(*asperities).value_or(0);
}

void FilmReader::read_summits(const Value& asperities) {
  film::Asperities& rough = film_.asperities;
  rough.mean_summit_height = number_of(asperities, "mean_summit_height");
  if (context_.has_fault_in(asperities.path) || rough.mean_summit_height <= 4 * rough.sigma) return;
  context_.fault(*asperities.find("mean_summit_height"),
                 fmt::format("{:.4g} um, {:.3g} times the summits' roughness", 1e6 * rough.mean_summit_height,
                             rough.mean_summit_height / rough.sigma),
                 "at most 4 times: higher ones would press on each other far apart");
}

void FilmReader::read_compliance() {
  const Value* compliance = value_.find("compliance");
  if (compliance == nullptr || compliance->broken || compliance->text == "rigid") return;
  const std::optional<double> modulus = composite_modulus_of(*compliance);
  const Value* length = compliance->find("length");
  if (length != nullptr && !length->broken && surfaces_.size > 0 && length->number > kLongestColumn * surfaces_.size)
    context_.fault(*length,
                   fmt::format("{:.3g} m, {:.3g} times the {}", length->number, length->number / surfaces_.size,
                               (surfaces_.fixed == "shell"    ? "bearing's radius"
                                : surfaces_.fixed == "skirt"  ? "skirt's radius"
                                : surfaces_.fixed == "stator" ? "annulus' width"
                                                              : "pad's length")),
                   fmt::format("at most {:g} times that: columns represent a lining or a housing", kLongestColumn));
  if (modulus) film_.compliance = (length != nullptr ? length->number : surfaces_.size) / *modulus;
}

/// Moduli of `materials` count only where no composite modulus is given: both would contradict each other, or hide a
/// slip.
void FilmReader::require_use_of_materials() {
  const Value* materials = value_.find("materials");
  if (materials == nullptr || materials->broken || takes_materials_) return;
  const auto shares_heat = [&](const std::string& surface) {
    const Value* material = materials->find(surface);
    return material != nullptr && !material->broken && material->has("conductivity");
  };
  const bool serves_heat = shares_heat(surfaces_.fixed) || shares_heat(surfaces_.moving);
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
std::optional<double> FilmReader::composite_modulus_of(const Value& parent) {
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

void require_bearable(Context& context, const Value& load, double area) {
  if (load.broken || !(area > 0) || load.number <= kHardest * area) return;
  context.fault(load,
                fmt::format("{:.3g} N, {:.3g} Pa on the bearing's projected area", load.number, load.number / area),
                fmt::format("a load of at most {:.3g} N here: no solid bears 1e12 Pa", kHardest * area));
}

void read_frames(Context& context, const Value& value, const SurfaceNames& surfaces, Bearing& bearing) {
  if (const Value* fixed = value.find(surfaces.fixed)) bearing.shell = frame_of(context, *fixed);
  const Value* moving = value.find(surfaces.moving);
  if (moving == nullptr) return;
  bearing.journal = frame_of(context, *moving);
  if (bearing.journal.body.empty() || bearing.journal.body != bearing.shell.body) return;
  context.fault(*moving, fmt::format("{} and {} on body '{}'", surfaces.fixed, surfaces.moving, bearing.shell.body),
                "frames of two bodies");
}

}  // namespace hersey::model
