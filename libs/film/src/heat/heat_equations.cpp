#include "heat/heat_equations.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "heat/eddy_mixing.h"

// Conductances to walls and between layers, and the balance of all terms. The rows are assembled in heat_assembly.cpp
// and solved in heat_solution.cpp.
namespace hersey::film {

// What is sheared over the whole gap fills it: conduction by streamers alone would warm them without bound as they
// thin.
double HeatEquations::conducting_fraction(const Node& node) const {
  return model_.cavitated_shear == CavitatedShear::full ? 1 : std::clamp(node.theta, least_fill_, 1.0);
}

HeatEquations::HeatEquations(const FilmModel& model, const ThermalModel& thermal)
    : model_(model),
      thermal_(thermal),
      at_(terminals_of(thermal)),
      across_(layering_of(static_cast<std::size_t>(thermal.layers))),
      rc_(model.lubricant.density * model.lubricant.specific_heat),
      heat_partition_(heat_partition(thermal.shell_surface, thermal.journal_surface)),
      system_(model.grid, thermal.layers, has_own_temperatures(thermal.shell)),
      mean_(model.grid, thermal.layers,
            {.ring = has_own_temperatures(thermal.shell),
             .shell_node = std::holds_alternative<NodeWall>(thermal.shell),
             .own_journal = has_own_temperature(thermal.journal),
             .journal_node = std::holds_alternative<NodeWall>(thermal.journal),
             .outside = at_.outside(),
             .body = conduction_of(thermal.shell),
             .journal_body = conduction_of(thermal.journal)}) {
  end_of_line_.assign(static_cast<std::size_t>(model.grid.n_phi), -1);
  for (int i = 0; !model.grid.closes() && i < model.grid.n_phi; ++i)
    if (model.grid.is_end(i)) end_of_line_[i] = 2 * model.grid.patch_of(i) + (model.grid.begins_patch(i) ? 0 : 1);
  if (const auto* ring = std::get_if<RingWall>(&thermal_.shell))
    ring_ = conductances(model_, GridGeometry(model_), *ring);
}

Eigen::Index HeatEquations::oil_of(int supply) const {
  const int feature = supply - (has_line() ? 1 : 0);
  if (feature < 0) return at_.index_of_oil(thermal_.oil.line);
  return thermal_.oil.features.empty() ? -1
                                       : at_.index_of_oil(thermal_.oil.features[static_cast<std::size_t>(feature)]);
}

double HeatEquations::at_edges(const Eigen::VectorXd& outside) const {
  const Eigen::Index terminal = at_.index_of_oil(thermal_.oil.edges);
  return terminal < 0 ? thermal_.T_edges : outside[terminal];
}

double HeatEquations::at_ring(const Eigen::VectorXd& outside) const {
  return at_.ambient ? outside[at_.index_of_ambient()] : std::get<RingWall>(thermal_.shell).T_ambient;
}

// Temperature of the oil supplied: that of a node, its own, or the film's (thermal.40).
double HeatEquations::fresh(int supply, const Eigen::VectorXd& outside) const {
  if (const Eigen::Index terminal = oil_of(supply); terminal >= 0) return outside[terminal];
  const int feature = supply - (has_line() ? 1 : 0);
  if (feature < 0) return thermal_.T_line.value_or(thermal_.T_supply);
  if (thermal_.T_features.empty()) return thermal_.T_supply;
  return thermal_.T_features[static_cast<std::size_t>(feature)];
}

// The weights are those of the film's own power (film.53), so that heat equals friction.
double HeatEquations::asperity_power(const CarryingFilm& film, int node) const {
  const GridGeometry& geometry = film.balance.geometry();
  const double area = geometry.weight(node / model_.grid.n_z, node % model_.grid.n_z);
  return area * film.balance.nodes()[node].asperity * film.wrench.friction_power_per_contact(node % model_.grid.n_z);
}

// The surfaces share it by their effusivities (thermal.54).
double HeatEquations::shell_friction(const CarryingFilm& film, int node) const {
  return heat_partition_ * asperity_power(film, node);
}

double HeatEquations::journal_friction(const CarryingFilm& film, int node) const {
  return (1 - heat_partition_) * asperity_power(film, node);
}

// The flux follows from the slope of the temperature at the wall, behind which the wall may have a resistance of its
// own. Oil in a supply is no film and heats no wall.
WallFlux HeatEquations::to_wall(const CarryingFilm& film, int node, int layer, double resistance) const {
  const Node& at = film.balance.nodes()[node];
  auto [beside, next] = across_.slope_at_wall(static_cast<std::size_t>(layer));
  double k = model_.lubricant.conductivity * conducting_fraction(at) / at.h;
  if (const EddyMixing mixing(model_, at); mixing.mixes() && k > 0) {
    // A laminar film has the slope of a parabola; where eddies carry the heat its correction of the slope over half of
    // the layer, 2/width, fades with the resistance (turbulence.14).
    const double turbulent = mixing.resistance_to_wall(width(layer));
    const double laminar = 0.5 * width(layer) / mixing.conductivity(0), fading = turbulent / laminar;
    const double half = 2 / width(layer);
    beside = half / fading + (beside - half) * fading, next *= fading;
  }
  const double area = (1 - film.balance.supplied_fraction(node)) * film.balance.area(node);
  const double fraction = area / (1 + resistance * k * (beside - next));
  return {fraction * k * beside, fraction * k * next};
}

double HeatEquations::between(const CarryingFilm& film, int node, int layer) const {
  const Node& at = film.balance.nodes()[node];
  const double area = film.balance.area(node);
  if (const EddyMixing mixing(model_, at); mixing.mixes()) {
    const double from = across_.middle(static_cast<std::size_t>(layer));
    const double to = from + across_.to_next(static_cast<std::size_t>(layer));
    return conducting_fraction(at) * area / (at.h * mixing.resistance(from, to));
  }
  const double k = model_.lubricant.conductivity * conducting_fraction(at);
  return k * area / (at.h * across_.to_next(static_cast<std::size_t>(layer)));
}

WallFlux HeatEquations::to_shell(const CarryingFilm& film, int node) const {
  return conducts(thermal_.shell) ? to_wall(film, node, 0, ring_.inside) : WallFlux{};
}

WallFlux HeatEquations::to_journal(const CarryingFilm& film, int node) const {
  return conducts(thermal_.journal) ? to_wall(film, node, top(), 0) : WallFlux{};
}

double HeatEquations::into_shell(const CarryingFilm& film, const HeatState& state, int node) const {
  if (!conducts(thermal_.shell)) return 0;
  const WallFlux flux = to_shell(film, node);
  const double T = state.shell[node / model_.grid.n_z];
  const double* layer = state.film.data() + static_cast<Eigen::Index>(node) * layers();
  return flux.beside * (layer[0] - T) - flux.next * (layer[next_to_bottom()] - T);
}

double HeatEquations::into_journal(const CarryingFilm& film, const HeatState& state, int node) const {
  const WallFlux flux = to_journal(film, node);
  const double* layer = state.film.data() + static_cast<Eigen::Index>(node) * layers();
  return flux.beside * (layer[top()] - state.journal) - flux.next * (layer[next_to_top()] - state.journal);
}

double HeatEquations::made(const CarryingFilm& film, int node, int layer) const {
  if (thermal_.source.size() == 0) return 0;
  const FlowBalance& b = film.balance;
  return thermal_.source[system_.row(node, layer)] * b.area(node) * b.nodes()[node].theta * b.oil_gap(node) *
         width(layer);
}

// The storage is that of the oil at the end and the rate at which it has changed; air pockets keep a little.
double HeatEquations::start_volume(const CarryingFilm& film, int node) const {
  const FlowBalance& b = film.balance;
  const double end = b.area(node) * b.nodes()[node].content * b.oil_gap(node);
  return std::max(end - film.dt * b.storage(node), least_fill_ * b.area(node) * model_.c);
}

Eigen::VectorXd HeatEquations::heat_into_shell(const CarryingFilm& film, const HeatState& state) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(model_.grid.n_phi);
  for (int node = 0; node < model_.grid.size(); ++node)
    heat[node / model_.grid.n_z] += into_shell(film, state, node) + shell_friction(film, node);
  return heat;
}

double HeatEquations::heat_into_journal(const CarryingFilm& film, const HeatState& state) const {
  double heat = 0;
  for (int node = 0; node < model_.grid.size(); ++node)
    heat += into_journal(film, state, node) + journal_friction(film, node);
  return heat;
}

double HeatEquations::renewed(const HeatState& state, int supply) const {
  double heat = 0;
  for (const Renewal& renewal : renewals_) {
    if (renewal.supply != supply) continue;
    const double T = fresh(supply, state.outside), above = state.film[renewal.row] - T;
    heat += renewal.heat * (above - renewal.mixed_fraction * (state.supplies[supply] - T));
  }
  return heat;
}

// Each term has its own integral. Temperatures count from that of the supply, so that an error in the mass of oil
// brings no heat (thermal.17).
HeatBalance HeatEquations::balance(const CarryingFilm& film, const HeatState& start, const HeatState& end) const {
  const double T0 = thermal_.T_supply;
  HeatBalance sum;
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double out = film.balance.outflow(node);
    sum.power += asperity_power(film, node);
    sum.to_shell += into_shell(film, end, node) + (conducts(thermal_.shell) ? shell_friction(film, node) : 0);
    sum.to_journal += into_journal(film, end, node) + (conducts(thermal_.journal) ? journal_friction(film, node) : 0);
    const double from = film.dt > 0 ? start_volume(film, node) : 0;
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double T = end.film[row] - T0;
      sum.power += film.flows.dissipation(node, l);
      sum.source += made(film, node, l);
      sum.to_oil += rc_ * (out > 0 ? out * film.flows.leaving_fraction(node, l) * T
                                   : out * width(l) * (coming(film, end, node) - T0));
      sum.to_oil += rc_ * film.flows.lost(node) * width(l) * T;
      if (film.dt == 0) {
        sum.stored += rc_ * film.balance.storage(node) * width(l) * T;
        continue;
      }
      const double to = from + film.dt * film.balance.storage(node);
      sum.stored += rc_ * (to * T - from * (start.film[row] - T0)) * width(l) / film.dt;
    }
  }
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(supplies());
  for (const SuppliedNode& supplied : supplied_nodes_) flow[supplied.supply] += supplied.flow;
  for (int k = 0; k < supplies(); ++k)
    sum.to_oil += renewed(end, k) - rc_ * flow[k] * ((flow[k] > 0 ? fresh(k, end.outside) : end.supplies[k]) - T0);
  return sum;
}

}  // namespace hersey::film
