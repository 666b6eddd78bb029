#include "balance/node.h"

#include <algorithm>
#include <cmath>

#include "hersey/film/greenwood_tripp.h"

namespace hersey::film {
namespace {

// Pressure of the atmosphere, in which clearances are measured, on the model's scale [Pa].
double pressure_at_rest(const FilmModel& model) { return model.pressures == PressureScale::absolute ? 101325.0 : 0.0; }

// Sliding speed that counts as rest [m/s].
constexpr double standing = 1e-4;

}  // namespace

double fill_scale(const FilmModel& model) {
  const double slope = model.R / model.c;
  return 6 * model.lubricant.mu0 * model.fill_speed * slope * slope * mean_step(model.grid);
}

Sliding sliding_of(double slip_phi, double slip_z) {
  const double around = slip_phi * slip_phi + standing * standing, square = around + slip_z * slip_z;
  return {std::sqrt(square), around / square};
}

NodeViscosity node_viscosity(const LayeredViscosity& viscosity, int node) {
  const double shear = 1 / viscosity.shear_fluidity[node];
  if (viscosity.at_rest.size() == 0) return {1 / viscosity.fluidity[node], shear, 1, shear};
  return {1 / viscosity.fluidity[node], shear, viscosity.axial_fluidity[node] / viscosity.fluidity[node],
          viscosity.at_rest[node], true};
}

SlidingChange change_of_sliding(const Eigen::Vector2d& slip, const Eigen::Vector2d& change) {
  const double around = slip.x() * slip.x() + standing * standing, square = around + slip.y() * slip.y();
  const double by_log = slip.dot(change) / square;
  return {by_log, 2 * (slip.x() * change.x() - around * by_log) / square};
}

CavitationScales cavitation_scales(const FilmModel& model) {
  const double dphi = mean_step(model.grid);
  const double slenderness = model.R * dphi * (model.grid.n_z - 1) / model.L;
  const double fill = fill_scale(model);
  return {.fill = fill, .slack = fill * dphi / (1 + slenderness * slenderness)};
}

bool open_edge(const FilmModel& model, int node) {
  const Edge* edge = edge_of_node(model, node);
  return edge != nullptr && edge->kind == EdgeKind::pressure && edge->pressure == model.p_cav &&
         cavitation_law(model).has_fill();
}

double ambient_fill(const FilmModel& model, int node) {
  if (!open_edge(model, node)) return 0;
  const Edge& edge = *edge_of_node(model, node);
  return edge.gives_oil() ? 0 : edge.ambient_fill;
}

NodeLaw::NodeLaw(const FilmModel& model)
    : model_(model),
      cavitation_(cavitation_law(model)),
      scales_(cavitation_scales(model)),
      contact_scale_(model.asperities.elastic_factor * model.asperities.composite_modulus),
      uniform_{model.lubricant.mu0, model.lubricant.mu0, 1, model.lubricant.mu0},
      is_open_(static_cast<std::size_t>(model.grid.size()), 0) {
  for (int node = 0; node < model.grid.size(); ++node)
    is_open_[static_cast<std::size_t>(node)] = open_edge(model, node) ? 1 : 0;
}

void NodeLaw::evaluate(double g, double u, int at, const Sliding& sliding, double roughness,
                       const NodeViscosity& viscosity, Node& node) const {
  node = {};
  pressure_and_fill(u, at, node);
  film_thickness(g, roughness, node);
  rheology(viscosity, sliding, node);
}

void NodeLaw::pressure_and_fill(double u, int at, Node& node) const {
  FilmPhase phase = cavitation_.phase(u, scales_);
  const bool open = is_open_[static_cast<std::size_t>(at)] != 0;
  node.wall = model_.p_cav;
  if (open) {
    phase.p = {};
    const double least = ambient_fill(model_, at);
    if (least > 0 && phase.theta.value < least) phase.theta = {least, 0};
  } else if (u >= 0 || cavitation_.bears_tension()) {
    node.wall += u, node.wall_u = 1;
  }
  node.p = phase.p.value, node.p_u = phase.p.slope;
  node.theta = phase.theta.value, node.theta_u = phase.theta.slope;
  const bool is_whole = cavitation_.has_fill() || cavitation_.bears_tension() || u >= 0;
  const ValueAndSlope fraction = is_whole ? phase.theta : ValueAndSlope{0};
  if (model_.cavitated_shear == CavitatedShear::full)
    node.other_sheared_fraction = fraction.value;
  else
    node.sheared_fraction = fraction.value, node.sheared_fraction_u = fraction.slope;
}

void NodeLaw::rheology(const NodeViscosity& viscosity, const Sliding& sliding, Node& node) const {
  const Lubricant& oil = model_.lubricant;
  const ValueAndSlope ratio = log_viscosity_ratio(oil, node.p, viscosity.at_rest), density = density_ratio(oil, node.p);
  const double fluidity = (ratio.value == 0 ? 1 : std::exp(-ratio.value)) / viscosity.flow,
               slope = ratio.slope * node.p_u;
  node.flow[0] = {.value = fluidity, .u = -slope * fluidity};
  node.flow[1] = {.value = viscosity.axial * fluidity, .u = viscosity.axial * node.flow[0].u};
  node.mu = viscosity.shear / viscosity.flow / fluidity;
  node.mu_u = slope * node.mu;
  if (!oil.shear_thinning.is_newtonian() && !viscosity.is_sheared) thin(sliding, slope, node);
  node.density = density.value;
  node.density_u = density.slope * node.p_u;
  node.content = node.density * node.theta;
  node.content_u = node.density_u * node.theta + node.density * node.theta_u;
  node.mu_laminar = node.mu;
  node.reynolds = reynolds_number(model_, node, sliding.speed);
  if (model_.turbulence.counts()) add_turbulence(sliding, slope, node);
}

// Fluidities along and across the sliding give those along phi and along z, between which the sliding lies.
void NodeLaw::set_flow(const Sliding& sliding, const Fluidity& along, const Fluidity& across, Node& node) {
  for (const int axis : {0, 1}) {
    const double fraction = axis == 0 ? sliding.fraction_along_phi : 1 - sliding.fraction_along_phi,
                 rest = 1 - fraction;
    const double rotation = along.value - across.value;
    node.flow[axis] = {.value = fraction * along.value + rest * across.value,
                       .u = fraction * along.u + rest * across.u,
                       .h = fraction * along.h + rest * across.h,
                       .rate = fraction * along.rate + rest * across.rate,
                       .rotation = axis == 0 ? rotation : -rotation};
  }
}

// Turbulent friction of a viscosity that grows with u by `log_slope` (turbulence.2). The logarithm of the Reynolds
// number grows with those of film thickness and sliding speed, and with u by density and viscosity (turbulence.11).
void NodeLaw::add_turbulence(const Sliding& sliding, double log_slope, Node& node) const {
  const TurbulentFriction friction = turbulent_friction(model_.turbulence, node.reynolds, node.h, model_.R);
  node.turbulent_fraction = friction.fraction;
  if (friction.fraction == 0) return;
  const double by_u = node.density_u / node.density - log_slope;
  const auto slowed = [&](const FrictionFactor& factor) {
    const double fluidity = node.flow[0].value / factor.value, by_log = -fluidity / factor.value;
    return Fluidity{.value = fluidity,
                    .u = -log_slope * fluidity + by_log * factor.by_reynolds * by_u,
                    .h = by_log * (factor.by_reynolds + factor.by_thickness) / node.h,
                    .rate = by_log * factor.by_reynolds};
  };
  const Fluidity along = slowed(friction.along), across = slowed(friction.across);
  set_flow(sliding, along, across, node);
  const FrictionFactor& factor = friction.sliding;
  node.mu = node.mu_laminar * factor.value;
  node.mu_u = node.mu_laminar * (log_slope * factor.value + factor.by_reynolds * by_u);
  node.mu_rate = node.mu_laminar * factor.by_reynolds;
  node.mu_h = node.mu_laminar * (factor.by_reynolds + factor.by_thickness) / node.h;
}

// A viscosity that grows with u by `log_slope` after shear thinning by sliding (thermal.24): more pressure drives a
// flow along the sliding against the tangent of the stress, and one across it against the stress itself.
void NodeLaw::thin(const Sliding& sliding, double log_slope, Node& node) const {
  const ShearThinning& thinning = model_.lubricant.shear_thinning;
  const double mu_n = node.mu, fluidity = node.flow[0].value, k = thinning.by_viscosity();
  const ShearRatio R = thinning.ratio(sliding.speed / node.h, mu_n);
  const auto thinned = [&](const ValueAndSlope& left) {
    const double by_rate = -fluidity * left.slope / (left.value * left.value);
    return Fluidity{.value = fluidity / left.value,
                    .u = -log_slope * (fluidity / left.value - k * by_rate),
                    .h = -by_rate / node.h,
                    .rate = by_rate};
  };
  set_flow(sliding, thinned(R.tangent()), thinned({R.value, R.slope}), node);
  node.mu = mu_n * R.value;
  node.mu_u = log_slope * mu_n * (R.value + k * R.slope);
  node.mu_rate = mu_n * R.slope;
  node.mu_h = -node.mu_rate / node.h;
}

void NodeLaw::film_thickness(double g, double roughness, Node& node) const {
  const double C = model_.compliance, pressed = node.wall - pressure_at_rest(model_);
  // h - g - C (p + p_a(h)) = 0 is increasing and concave in h: Newton's method from the left side rises to the root. A
  // root above zero is not sought below zero, where asperities would be compressed beyond their height.
  node.h = g + C * pressed;
  if (node.h < 0 && C > 0) {
    contact(0, roughness, node);
    if (node.h + C * node.asperity > 0) node.h = 0;
  }
  contact(node.h, roughness, node);
  double slope = 1 - C * node.asperity_h;
  if (C > 0 && node.asperity > 0) {
    for (int i = 0; i < 50; ++i) {
      const double excess = node.h - g - C * (pressed + node.asperity);
      const double step = -excess / slope;
      node.h += step;
      contact(node.h, roughness, node);
      slope = 1 - C * node.asperity_h;
      if (std::abs(step) <= 1e-15 * model_.c) break;
    }
  }
  node.h_g = 1 / slope;
  node.h_u = C * node.wall_u / slope;
  node.w = C * (pressed + node.asperity);
}

// Summits that run in keep their number per area and the product of number, radius and height: K goes with the height
// (wear.6).
void NodeLaw::contact(double h, double roughness, Node& node) const {
  const Asperities& a = model_.asperities;
  if (a.model == AsperityModel::none) return;
  // A film of h <= 0 is closed and has no pressure; the caller decides what follows.
  const double sigma = roughness * a.sigma, scale = roughness * contact_scale_;
  const double H = (std::max(h, 0.0) - roughness * a.mean_summit_height) / sigma;
  const ValueAndSlope F =
      a.model == AsperityModel::greenwood_tripp_fit ? greenwood_tripp_fit(H) : greenwood_tripp_exact(H);
  node.asperity = scale * F.value;
  node.asperity_h = scale * F.slope / sigma;
}

}  // namespace hersey::film
