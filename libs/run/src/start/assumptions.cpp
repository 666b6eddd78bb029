#include "hersey/run/assumptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "hersey/bearing/clearance.h"
#include "hersey/bearing/film_coordinates.h"
#include "hersey/film/gap_shape.h"

namespace hersey::run {
namespace {

using Rows = std::vector<std::pair<std::string, std::string>>;

std::string pressure(double p) { return fmt::format("{:.4g} bar", p / 1e5); }

std::string cavitation(const film::FilmModel& film) {
  return std::string(film::cavitation_law(film).text()) + " at " + pressure(film.p_cav);
}

std::string shear_on_bodies(film::ShearForce shear) {
  if (shear == film::ShearForce::full) return "its force and its torque";
  return shear == film::ShearForce::torque_only ? "its torque only (`shear_force: torque_only`)"
                                                : "nothing (`shear_force: none`)";
}

std::string edge(const film::FilmModel& film, const film::Edge& at) {
  if (at.kind == film::EdgeKind::closed) return "closed: no oil passes";
  if (at.kind == film::EdgeKind::leaking)
    return fmt::format("a seal of leakage {:.4g}, behind which are {}", at.leakage, pressure(at.pressure));
  const double p = at.pressure, fill = at.ambient_fill;
  if (!film::cavitation_law(film).has_fill() || p > film.p_cav) return pressure(p);
  if (at.flow) return pressure(p) + fmt::format(", which {:.4g} L/min of oil reach", 6e4 * *at.flow);
  if (at.layer)
    return pressure(p) +
           fmt::format(", into which the surface that runs in brings a layer of {:.4g} um of oil", 1e6 * *at.layer);
  if (fill == 0) return pressure(p) + ", in air: oil may leave, none comes in";
  return pressure(p) + fmt::format(", in {:.3g} of oil: the film draws it in where it would be emptier", fill);
}

std::string surface(const film::SurfaceRoughness& roughness) {
  return roughness.sigma == 0 ? std::string("smooth")
                              : fmt::format("{:.4g} um rms, gamma {:.3g}", 1e6 * roughness.sigma, roughness.gamma);
}

/// Which of the readings of roughness the run took: in flow and shear, in contact, or nowhere.
std::string roughness(const film::FilmModel& film) {
  const film::Roughness& r = film.roughness;
  if (r.composite_sigma() == 0) return "the oil flows between smooth surfaces";
  const std::string both = "shell " + surface(r.shell) + ", journal " + surface(r.journal);
  if (!r.counts()) return both + "; not in the oil's flow";
  return both + fmt::format("; flow factors of Patir and Cheng on the distance of the mean planes, {:.4g} um together",
                            1e6 * r.composite_sigma());
}

std::string supply(const film::FilmModel& film) {
  switch (film.supply.kind) {
    case film::SupplyKind::none:
      return film.features.empty() ? "none: oil enters over the edges only" : "no line: oil enters through features";
    case film::SupplyKind::fixed_angle:
      return fmt::format("line along the bearing at {:.4g} deg, {}", film.supply.phi * 180 / std::numbers::pi,
                         pressure(film.supply.pressure));
    case film::SupplyKind::widest_gap:
      return "line along the bearing, always at the widest gap, " + pressure(film.supply.pressure);
  }
  return {};
}

/// Name of a feature. The code does not compile for an outline that has no description here.
struct ShapeDescription {
  bool is_fed;
  const char* operator()(const film::Rectangle& /*shape*/) const { return is_fed ? "groove" : "pocket"; }
  const char* operator()(const film::Ellipse& /*shape*/) const { return "hole"; }
};

/// What a feature's restrictor is. The code does not compile for a law that has no description here.
struct RestrictorDescription {
  film::RestrictorOil oil;
  std::string operator()(const film::Capillary& capillary) const {
    return fmt::format("a capillary of {:.4g} mm x {:.4g} mm at {:.4g} mPa.s", 1e3 * capillary.length,
                       1e3 * capillary.diameter, 1e3 * oil.mu);
  }
  std::string operator()(const film::FlowResistance& plug) const {
    return fmt::format("a resistance of {:.4g} Pa.s/m^3", plug.resistance);
  }
  std::string operator()(const film::Orifice& orifice) const {
    return fmt::format("an orifice of {:.4g} mm, discharge coefficient {:.4g}", 1e3 * orifice.diameter,
                       orifice.discharge_coefficient);
  }
  std::string operator()(const film::ConstantFlow& pump) const {
    return fmt::format("a pump of {:.4g} l/min", 60e3 * pump.rate);
  }
};

std::string feed(const film::SurfaceFeature& feature, bool is_of_circuit) {
  if (!feature.is_fed) return ", not fed";
  if (!feature.restrictor) return is_of_circuit ? ", fed by the circuit" : "";
  const film::Restrictor& restrictor = *feature.restrictor;
  const std::string text = ", fed by " + std::visit(RestrictorDescription{restrictor.oil}, restrictor.law);
  if (is_of_circuit) return text + " from the circuit";
  if (!restrictor.has_supply_pressure()) return text;
  return text + (restrictor.throttles() ? " from " : ", limited to ") +
         fmt::format("{:.4g} bar", 1e-5 * feature.pressure);
}

std::string described(const film::FilmModel& film, const film::SurfaceFeature& feature, bool is_of_circuit) {
  const std::string depth = feature.depth > 0 ? fmt::format(", {:.4g} um deep", 1e6 * feature.depth) : "";
  if (!film::is_round(film.surface))
    return fmt::format("{} in the pad at y = {:.4g} mm, z = {:.4g} mm, {:.4g} mm x {:.4g} mm{}{}",
                       std::visit(ShapeDescription{feature.is_fed}, feature.shape), 1e3 * film.R * feature.phi,
                       1e3 * feature.z, 1e3 * film.R * feature.arc, 1e3 * feature.length, depth,
                       feed(feature, is_of_circuit));
  if (bearing::is_on_annulus(film))
    return fmt::format("{} in the stator at {:.4g} deg, r = {:.4g} mm, {:.4g} deg x {:.4g} mm{}{}",
                       std::visit(ShapeDescription{feature.is_fed}, feature.shape),
                       feature.phi * 180 / std::numbers::pi, 1e3 * (film.R + feature.z),
                       feature.arc * 180 / std::numbers::pi, 1e3 * feature.length, depth, feed(feature, is_of_circuit));
  return fmt::format("{} in the {} at {:.4g} deg, z = {:.4g} mm, {:.4g} deg x {:.4g} mm{}{}",
                     std::visit(ShapeDescription{feature.is_fed}, feature.shape),
                     feature.surface == film::Surface::shell ? "shell" : "journal",
                     feature.phi * 180 / std::numbers::pi, 1e3 * feature.z, feature.arc * 180 / std::numbers::pi,
                     1e3 * feature.length, depth, feed(feature, is_of_circuit));
}

/// Text that follows the viscosity mu0 in its description. The code does not compile for a law that has no description
/// here.
struct ViscosityDescription {
  std::string operator()(const film::ConstantViscosity&) const { return ""; }
  std::string operator()(const film::Barus& law) const { return fmt::format(" exp({:.4g}/Pa p) (Barus)", law.alpha); }
  std::string operator()(const film::Roelands& law) const {
    return fmt::format(" at p_cav, Roelands with z = {:.4g}", law.z);
  }
  std::string operator()(const film::TabledPressure& law) const {
    return fmt::format(" at p_cav, a table over pressure up to {:.4g} MPa", 1e-6 * law.p.back());
  }
};

struct DensityDescription {
  std::string operator()(const film::Incompressible&) const { return "incompressible"; }
  std::string operator()(const film::DowsonHigginson& law) const {
    return fmt::format("density rises by {:.4g}/Pa p/(1 + {:.4g}/Pa p) (Dowson-Higginson)", law.rise, law.saturation);
  }
  std::string operator()(const film::ConstantBulkModulus& law) const {
    return fmt::format("bulk modulus {:.4g} GPa", 1e-9 * law.bulk_modulus);
  }
  std::string operator()(const film::BubblyOil& law) const {
    return fmt::format("a mixture with {:.3g} of gas at {:.4g} bar absolute", law.gas_fraction, 1e-5 * law.pressure);
  }
};

double celsius(double T) { return T - film::zero_celsius; }

/// Decrease of the viscosity with temperature. The code does not compile for a law that has no description here.
struct TemperatureLawDescription {
  std::string operator()(const film::FixedViscosity&) const { return "the same at every temperature"; }
  std::string operator()(const film::ExponentialViscosity& law) const {
    return fmt::format("{:.4g} mPa.s exp[-{:.4g}/K (T - {:.4g} degC)]", 1e3 * law.mu_ref, law.beta, celsius(law.T_ref));
  }
  std::string operator()(const film::VogelViscosity& law) const {
    return fmt::format("{:.4g} mPa.s exp[{:.4g} K/(T - {:.4g} K)] (Vogel)", 1e3 * law.a, law.b, law.c);
  }
  std::string operator()(const film::WaltherViscosity& law) const {
    return fmt::format("{:.4g} and {:.4g} mm^2/s at 40 and 100 degC (ASTM D341), {:.4g} kg/m^3 at 15 degC",
                       1e6 * law.kinematic(313.15).value, 1e6 * law.kinematic(373.15).value, law.rho15);
  }
  std::string operator()(const film::TabledViscosity& law) const {
    return fmt::format("a table of {} rows from {:.4g} to {:.4g} degC", law.T.size(), celsius(law.T.front()),
                       celsius(law.T.back()));
  }
};

std::string words_of_node(const film::NodeWall& wall) {
  return fmt::format("body '{}' of the thermal network", wall.name);
}

std::string words_of_body(const std::optional<double>& T_start) {
  return "in a body whose mesh conducts heat steadily" +
         (T_start ? fmt::format("; in a simulation it begins at {:.4g} degC", celsius(*T_start))
                  : std::string("; in a simulation it begins at the temperature of the supply")) +
         " and moves at the end of cycles only";
}

struct ShellDescription {
  double R;
  bool is_flat;

  std::string operator()(const film::InsulatedWall&) const { return "takes no heat"; }
  std::string operator()(const film::WallAtTemperature& wall) const {
    if (wall.around.size() == 0) return fmt::format("at {:.4g} degC", celsius(wall.T));
    return fmt::format("at {:.4g} to {:.4g} degC over the angle", celsius(wall.around.minCoeff()),
                       celsius(wall.around.maxCoeff()));
  }
  std::string operator()(const film::NodeWall& wall) const { return words_of_node(wall); }
  std::string operator()(const film::RingWall& ring) const {
    const std::string to = ring.surroundings ? words_of_node(*ring.surroundings)
                                             : fmt::format("surroundings at {:.4g} degC", celsius(ring.T_ambient));
    const std::string size = is_flat ? fmt::format("{:.4g} mm thick", 1e3 * (ring.outer_radius - R))
                                     : fmt::format("a ring to {:.4g} mm", 2e3 * ring.outer_radius);
    return fmt::format("{}, {:.4g} W/m/K, {:.4g} W/m^2/K to {}", size, ring.conductivity, ring.transfer, to);
  }
  std::string operator()(const film::BodyWall& wall) const { return words_of_body(wall.T_start); }
};

struct JournalDescription {
  std::string operator()(const film::InsulatedWall&) const { return "takes no heat"; }
  std::string operator()(const film::WallAtTemperature& wall) const {
    return fmt::format("at {:.4g} degC", celsius(wall.T));
  }
  std::string operator()(const film::FreeJournal&) const { return "at one temperature, without net heat when steady"; }
  std::string operator()(const film::BodyJournal& wall) const {
    return words_of_body(wall.T_start) + ", heat coming to it evenly around";
  }
  std::string operator()(const film::NodeWall& wall) const { return words_of_node(wall); }
};

/// Supplies that have a temperature of their own.
std::string other_supplies(const film::FilmModel& film, const film::ThermalModel& heat) {
  std::string text;
  const auto add = [&](const std::string& name, double T) {
    if (T != heat.T_supply)
      text += fmt::format("{}through {} at {:.4g} degC", text.empty() ? " (" : ", ", name, celsius(T));
  };
  if (film.supply.kind != film::SupplyKind::none && heat.T_line) add("the line", *heat.T_line);
  for (std::size_t k = 0; k < heat.T_features.size(); ++k) add(film.features[k].name, heat.T_features[k]);
  return text.empty() ? text : text + ")";
}

/// Nodes that oil comes from and goes to.
std::string nodes_of_oil(const film::FilmModel& film, const film::ThermalModel& heat) {
  std::string text;
  const auto add = [&text](const std::string& how, const std::optional<film::NetworkNode>& node) {
    if (node) text += "; " + how + " node '" + node->name + "'";
  };
  if (film.supply.kind != film::SupplyKind::none) add("through the line oil comes as warm as", heat.oil.line);
  for (std::size_t k = 0; k < heat.oil.features.size(); ++k)
    if (film.features[k].is_fed)
      add("through " + film.features[k].name + " oil comes as warm as", heat.oil.features[k]);
  add("edges draw in oil as warm as", heat.oil.edges);
  add("what leaves warms", heat.oil.drain);
  return text;
}

/// Distribution of the heat of asperity friction.
std::string rubbing(const model::Bearing& bearing, const film::ThermalModel& heat) {
  const film::FilmModel& film = bearing.film;
  if (film.asperities.model == film::AsperityModel::none) return {};
  const double shell = 100 * film::heat_partition(heat.shell_surface, heat.journal_surface);
  return fmt::format("; of the asperities' heat {:.3g} % into the {}, {:.3g} % into the {}, by effusivities", shell,
                     bearing.kind->fixed_surface(), 100 - shell, bearing.kind->moving_surface());
}

/// Source of the film's temperature; empty if nothing depends on it.
std::string heat(const model::Bearing& bearing) {
  const film::Lubricant& oil = bearing.film.lubricant;
  const std::string law = std::visit(TemperatureLawDescription{}, oil.temperature_law);
  if (const auto* film = std::get_if<film::ThermalModel>(&bearing.heat)) {
    return fmt::format(
        "film in {} layers, viscosity {}, oil supplied at {:.4g} degC{}, {:.4g} J/kg/K, {:.4g} W/m/K; {} {}; "
        "{} {}; grooves carry over {:.3g} of the film's oil{}",
        film->layers, law, celsius(film->T_supply), other_supplies(bearing.film, *film), oil.specific_heat,
        oil.conductivity, bearing.kind->fixed_surface(),
        std::visit(ShellDescription{bearing.film.R, !bearing.kind->has_axis()}, film->shell),
        bearing.kind->moving_surface(), std::visit(JournalDescription{}, film->journal), film->carry_over,
        nodes_of_oil(bearing.film, *film) + rubbing(bearing, *film));
  }
  if (const auto* one = std::get_if<bearing::GlobalHeat>(&bearing.heat)) {
    const std::string by = one->cools_by_surroundings
                               ? fmt::format("housing of {:.4g} m^2 at {:.4g} W/m^2/K to {:.4g} degC", one->area,
                                             one->transfer, celsius(one->T_ambient))
                               : fmt::format("the oil, supplied at {:.4g} degC", celsius(one->T_supply));
    return fmt::format("one effective temperature, viscosity {}; cooled by {}", law, by);
  }
  return film::depends_on_temperature(oil.temperature_law) ? "one temperature; " + law : "";
}

/// Decrease of the viscosity with the shear rate. The code does not compile for a law that has no description here.
struct ShearThinningDescription {
  std::string operator()(const film::Newtonian&) const { return ""; }
  std::string operator()(const film::Cross& law) const {
    return fmt::format("Cross with exponent {:.4g} down to {:.4g} of the viscosity at rest", law.exponent, law.limit);
  }
  std::string operator()(const film::Carreau& law) const {
    return fmt::format("Carreau with exponent {:.4g}, transition {:.4g}, down to {:.4g} of the viscosity at rest",
                       law.exponent, law.transition, law.limit);
  }
};

/// Empty where the oil does not thin by shear.
std::string law_of_shear(const film::ShearThinning& thinning) {
  if (thinning.is_newtonian()) return "";
  return fmt::format("{}, critical {}", std::visit(ShearThinningDescription{}, thinning.law),
                     thinning.critical_stress > 0 ? fmt::format("stress {:.4g} kPa", 1e-3 * thinning.critical_stress)
                                                  : fmt::format("rate {:.4g}/s", thinning.critical_rate));
}

std::string shear_thinning(const model::Bearing& bearing) {
  const film::ShearThinning& thinning = bearing.film.lubricant.shear_thinning;
  if (thinning.is_newtonian()) return "";
  const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
  const bool in_layers = heat != nullptr && heat->layers > 1;
  return fmt::format("{}; {}", law_of_shear(thinning),
                     in_layers ? "each layer by its own shear (stiffness and damping hold it)"
                               : "by the sliding over the film thickness, with the tangent viscosity against pressure");
}

/// Friction of the film beyond that of a laminar one.
std::string turbulence(const film::FilmModel& film) {
  const film::Turbulence& t = film.turbulence;
  const auto law = [&]() -> std::string {
    switch (t.model) {
      case film::TurbulenceModel::none:
        return "none: a laminar film at every Reynolds number";
      case film::TurbulenceModel::ng_pan:
        return "Reichardt's eddy viscosity across the film (Ng and Pan)";
      case film::TurbulenceModel::constantinescu:
        return "powers of the Reynolds number (Constantinescu)";
      case film::TurbulenceModel::hirs:
        return "bulk flow (Hirs)";
    }
    return {};
  };
  if (!t.counts()) return law();
  return law() + fmt::format(", laminar up to {} {:.4g}, full from {:.4g}",
                             t.number == film::TransitionNumber::taylor ? "a Taylor number of" : "Re =", t.onset,
                             t.full);
}

std::string viscosity(const model::Bearing& bearing) {
  const film::Lubricant& oil = bearing.film.lubricant;
  const bool varies = !std::holds_alternative<std::monostate>(bearing.heat);
  return fmt::format("{:.4g} mPa.s{}{}, {}{}", 1e3 * oil.mu0, varies ? " as supplied" : "",
                     std::visit(ViscosityDescription{}, oil.viscosity_law),
                     std::visit(DensityDescription{}, oil.density_law), varies ? "" : ", isothermal");
}

std::string asperities(const film::Asperities& contact) {
  if (contact.model == film::AsperityModel::none) return "none";
  const bool fit = contact.model == film::AsperityModel::greenwood_tripp_fit;
  const double delta = contact.mean_summit_height;
  return fmt::format("Greenwood-Tripp ({}), roughness {:.4g} um{}, K E = {:.4g} MPa, boundary friction {:.3g}",
                     fit ? "fit of F_5/2 to h/sigma = 4" : "exact F_5/2", 1e6 * contact.sigma,
                     delta > 0 ? fmt::format(", summits {:.4g} um above the mean plane", 1e6 * delta) : "",
                     1e-6 * contact.elastic_factor * contact.composite_modulus, contact.mu_friction);
}

/// Dependence of the clearance on the temperatures of its walls.
std::string expansion(const model::Bearing& bearing) {
  if (!bearing.expansion) return "";
  const film::ThermalExpansion& walls = bearing.expansion->material;
  std::string text = fmt::format(" at {:.4g} degC; shell {:.4g}/K, journal {:.4g}/K", celsius(walls.T_reference),
                                 walls.shell, walls.journal);
  if (bearing.growth != 0)
    text += fmt::format(": {:.4g} um hot", 1e6 * bearing::clearance(bearing.film, bearing.growth));
  return text + "; ratios are over the hot clearance";
}

std::string grid(const film::FilmModel& film) {
  const film::Grid& g = film.grid;
  if (!film::is_round(film.surface))
    return fmt::format("{} x {} nodes (along and across the sliding direction, borders included)", g.n_phi, g.n_z);
  if (bearing::is_on_annulus(film))
    return fmt::format("{} x {} nodes (around all pads and along the radius, edges included)", g.n_phi, g.n_z);
  std::string text = fmt::format("{} x {} nodes (circumferential x axial, edges included)", g.n_phi, g.n_z);
  if (g.is_uniform()) return text;
  double narrowest = g.phi(0) + 2 * std::numbers::pi - g.phi(g.n_phi - 1), lowest = 1;
  for (int i = 0; i + 1 < g.n_phi; ++i) narrowest = std::min(narrowest, g.phi(i + 1) - g.phi(i));
  for (int j = 0; j + 1 < g.n_z; ++j) lowest = std::min(lowest, g.z_over_L(j + 1) - g.z_over_L(j));
  return text + fmt::format(", graded: the smallest cells are {:.3g} deg by {:.3g} mm",
                            180 / std::numbers::pi * narrowest, 1e3 * film.L * lowest);
}

std::string compliance(const model::Bearing& bearing) {
  if (bearing.film.compliance > 0)
    return fmt::format("column, {:.4g} um/MPa, film and contact pressure", 1e12 * bearing.film.compliance);
  return bearing.shell_surface || bearing.journal_surface ? "no columns" : "rigid surfaces";
}

}  // namespace

Rows oil_assumptions(const film::Lubricant& oil) {
  Rows rows{{"viscosity", std::visit(TemperatureLawDescription{}, oil.temperature_law)}};
  if (!film::depends_on_temperature(oil.temperature_law))
    rows.front().second = fmt::format("{:.4g} mPa.s, {}", 1e3 * oil.mu0, rows.front().second);
  if (!std::holds_alternative<film::ConstantViscosity>(oil.viscosity_law))
    rows.emplace_back("pressure", "mu0" + std::visit(ViscosityDescription{}, oil.viscosity_law));
  if (!oil.shear_thinning.is_newtonian()) rows.emplace_back("shear", law_of_shear(oil.shear_thinning));
  const std::string falls = oil.expansion > 0 ? fmt::format(" at 15 degC, falling by {:.3g}/K", oil.expansion) : "";
  rows.emplace_back("density", fmt::format("{:.4g} kg/m^3{}; {}", oil.expansion > 0 ? oil.rho15 : oil.density, falls,
                                           std::visit(DensityDescription{}, oil.density_law)));
  return rows;
}

Rows bearing_assumptions(const model::Bearing& bearing) {
  Rows rows;
  const film::FilmModel& film = bearing.film;
  const auto row = [&](const char* name, std::string text) {
    rows.emplace_back(bearing.name + ": " + name, std::move(text));
  };
  row("cavitation", cavitation(film));
  row("shear", fmt::format("the cavitated film is sheared over {}; shear acts by {}",
                           film.cavitated_shear == film::CavitatedShear::full
                               ? "the whole gap (`cavitated_shear: full`)"
                               : "the oil's share of the gap (`cavitated_shear: film_share`)",
                           shear_on_bodies(film.shear_force)));
  row("pressures",
      film.pressures == film::PressureScale::absolute ? "absolute: 0 is a vacuum" : "gauge: 0 is the atmosphere");
  const film::Arcs* bore = film::arcs_of(film);
  const bool is_annulus = bearing::is_on_annulus(film);
  const bool is_skirt = std::holds_alternative<film::Skirt>(film.surface);
  // The pads of a thrust bearing lie between grooves of one condition, as do the sides of a skirt.
  const std::size_t different = bore != nullptr ? film.ends.size() : std::min<std::size_t>(film.ends.size(), 1);
  if (is_skirt) row("edge pressure sides", edge(film, film.ends.front().first));
  for (std::size_t k = 0; k < different && !is_skirt; ++k) {
    const std::string arc = bore != nullptr ? " of " + bore->arcs[k].name : "";
    const auto& [first, last] = film.ends[k];
    row(("edge pressure leading" + arc).c_str(), edge(film, bearing.kind->is_forward() ? first : last));
    row(("edge pressure trailing" + arc).c_str(), edge(film, bearing.kind->is_forward() ? last : first));
  }
  row(is_annulus ? "edge pressure inner"
      : is_skirt ? "edge pressure bottom"
                 : "edge pressure left",
      edge(film, film.edge_left));
  row(is_annulus ? "edge pressure outer"
      : is_skirt ? "edge pressure top"
                 : "edge pressure right",
      edge(film, film.edge_right));
  if (bearing.kind->has_axis()) row("supply", supply(film));
  for (std::size_t f = 0; f < film.features.size(); ++f)
    row(("feature " + film.features[f].name).c_str(),
        described(film, film.features[f], model::node_of_feature(bearing, f).has_value()));
  for (const auto& [name, text] : bearing.kind->description(film)) row(name.c_str(), text);
  if (bearing.kind->has_axis())
    row("clearance", fmt::format("{:.4g} um radial ({:.4g} um diametral){}", 1e6 * bearing::clearance(film),
                                 2e6 * bearing::clearance(film), expansion(bearing)));
  if (!film.profiles.empty()) {
    const Eigen::VectorXd opening = film::gap_opening(film);
    row("shape", fmt::format("{} profile(s): the gap differs from that of cylinders by {:.4g} to {:.4g} um",
                             film.profiles.size(), 1e6 * opening.minCoeff(), 1e6 * opening.maxCoeff()));
  }
  row("grid", grid(film));
  row("viscosity", viscosity(bearing));
  if (std::string text = shear_thinning(bearing); !text.empty()) row("shear thinning", std::move(text));
  row("turbulence", turbulence(film));
  if (std::string text = heat(bearing); !text.empty()) row("temperature", std::move(text));
  row("roughness", roughness(film));
  row("contact", asperities(film.asperities));
  row("compliance", compliance(bearing));
  return rows;
}

namespace {

std::string integration(const model::Simulation& run) {
  const std::string step = run.error_control
                               ? fmt::format(
                                     "steps of an error of {:.1e} in angles, lengths over the machine's size and "
                                     "journals over their clearance, teeth over a hundredth of their pitch (the film's "
                                     "own error is not estimated)",
                                     run.error_control->tolerance)
                               : fmt::format("step {:.4g} us", 1e6 * run.step);
  if (run.integrator == model::Integrator::dormand_prince)
    return fmt::format(
        "explicit Runge-Kutta method of order eight (Dormand and Prince), constraints satisfied at the "
        "ends of steps, {}",
        step);
  return fmt::format("generalized-alpha, spectral radius {:.3g}, {}, Newton tolerance {:.1e}", run.spectral_radius,
                     step, run.tolerance);
}

std::pair<std::string, std::string> method(const model::Simulation& run) {
  using model::Analysis;
  if (run.analysis == Analysis::kinematics)
    return {"kinematics", fmt::format("positions, velocities, accelerations and forces from joints and drives every "
                                      "{:.4g} us; nothing integrated",
                                      1e6 * run.step)};
  if (run.analysis == Analysis::equilibrium)
    return {"static equilibrium",
            "gravity and the loads at the start, drives locked at their positions then, no velocities"};
  if (run.analysis == Analysis::steady)
    return {"steady motion", "drives at their speeds at the start, everything else at rest in its coordinates"};
  if (run.analysis == Analysis::modes && run.modes_about == model::ModesAbout::start)
    return {"small motions", "linear about the state at the start"};
  if (run.analysis == Analysis::modes && run.modes_about == model::ModesAbout::equilibrium)
    return {"small motions", "linear about the static equilibrium"};
  if (run.analysis == Analysis::modes && run.modes_about == model::ModesAbout::turning)
    return {"small motions",
            "linear about the steady motion at the drives' speeds, in axes that rotate with the drives"};
  const std::string then = run.analysis == Analysis::modes ? "; then linear about the end" : "";
  return {"time integration", integration(run) + then};
}

Rows circuit_assumptions(const model::OilCircuit& circuit) {
  Rows rows;
  if (circuit.temperatures)
    rows.emplace_back(
        "circuit: oil",
        fmt::format("{}, {:.4g} kg/m^3, carries {:.4g} kJ/m^3/K along; in each element as "
                    "viscous as it flows in, by the temperatures of the step before",
                    circuit.lubricant, circuit.network.oil.density, 1e-3 * circuit.temperatures->heat_capacity));
  else
    rows.emplace_back("circuit: oil", fmt::format("{}, {:.4g} mPa.s, {:.4g} kg/m^3 everywhere", circuit.lubricant,
                                                  1e3 * circuit.network.oil.mu, circuit.network.oil.density));
  for (const circuit::Node& node : circuit.network.nodes)
    if (node.storage)
      rows.emplace_back("circuit: " + node.name,
                        fmt::format("{:.4g} cm^3, {:.3g} % bubbles at ambient pressure, dissolved by Henry's law",
                                    1e6 * node.storage->volume, 1e2 * node.storage->free_air));
  return rows;
}

std::string gear_mesh(const mbd::GearMesh::Data& mesh) {
  return fmt::format(
      "{} on {} teeth, base radii {:.4g} and {:.4g} mm, helix angle {:.3g} deg on them; {:.4g} N/um along the normal, "
      "constant; teeth touch at all times on the flanks that a {} torque on the first wheel presses",
      mesh.teeth[0], mesh.teeth[1], 1e3 * mesh.base_radius[0], 1e3 * mesh.base_radius[1],
      mesh.base_helix * 180 / std::numbers::pi, 1e-6 * mesh.stiffness, mesh.side > 0 ? "positive" : "negative");
}

}  // namespace

Rows assumptions(const model::Model& model) {
  Rows rows;
  for (const model::Force& force : model.forces)
    if (const auto* mesh = force.as<model::GearMesh>())
      rows.emplace_back(force.name + ": gear mesh", gear_mesh(mesh->data));
  for (const model::Bearing& bearing : model.bearings) {
    for (auto& row : bearing_assumptions(bearing)) rows.push_back(std::move(row));
    rows.emplace_back(bearing.name + ": coupling", bearing.coupling.scheme == model::CouplingScheme::monolithic
                                                       ? "monolithic: one Newton system, film condensed"
                                                       : "partitioned: wrench exchanged until film and bodies agree");
  }
  if (model.circuit)
    for (auto& row : circuit_assumptions(*model.circuit)) rows.push_back(std::move(row));
  for (const model::Fmu& fmu : model.fmus)
    rows.emplace_back(
        "FMU " + fmu.name,
        fmt::format("{}, FMI {}.0; signals are exchanged every {:.4g} us, and each side goes on by those of "
                    "the last exchange",
                    fmu.description.model_name, fmu.description.version, 1e6 * fmu.step));
  rows.emplace_back(method(model.simulation));
  return rows;
}

}  // namespace hersey::run
