#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>

#include "heat/heat_equations.h"

// Rows of layers, ring, journal and supplies (thermal.10 to thermal.15).
namespace hersey::film {
namespace {

// Ratio of the flow across layers to the largest flow at which conduction alone keeps each temperature between its
// neighbours'. Up to this ratio the oil has the mean of two layers' temperatures, because flow along the film bounds
// temperatures as well.
constexpr double trusted = 4;

// Flow of fresh oil into a supply without any, over the largest flow: it determines the supply's temperature, as in a
// film without feed that is squeezed slowly, and is too small to affect the balance of heat.
constexpr double kThreadOfSupply = 1e-11;

}  // namespace

// The rows of layers come first, then those of supplies at their nodes, then the few rows of journal and supplies.
void HeatEquations::assemble(const CarryingFilm& film, const HeatState& start) {
  system_.set_zero();
  known_.setZero(system_.size() + 1 + supplies());
  by_shell_.setZero(known_.size());
  by_journal_.setZero(system_.size());
  by_outside_.setZero(known_.size(), at_.outside());
  outside_ = start.outside;
  by_supply_.assign(static_cast<std::size_t>(start.film.size()), 0.0);
  add_storage(film, start);
  add_flows(film, start);
  add_flow_upwards(film);
  add_edges(film, start);
  add_conduction(film);
  add_shell(film, start);
  add_journal(film);
  if (has_fixed_walls(film)) add_equations_to_mean(film, start);
  add_supplies(film, start);
  renew(film);
  add_remainder(film, start);
  if (has_fixed_walls(film)) fix_walls(start);
}

// Without any flow the scale is that of replacing the film's own oil once a second.
double HeatEquations::throughput(const CarryingFilm& film) const {
  const double flows = film.balance.largest_throughput();
  return flows > 0 ? flows : model_.c * model_.R * model_.L;
}

// Storage follows (thermal.10). Without flow a steady film would have no temperature, so that a small storage term is
// left to it.
void HeatEquations::add_storage(const CarryingFilm& film, const HeatState& start) {
  storage_.resize(start.film.size());
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double thread = least_fill_ * throughput(film);
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double rate = film.dt > 0 ? start_volume(film, node) / film.dt : thread * 1e-6;
      storage_[row] = rc_ * rate * width(l);
      system_.diagonal(row) += storage_[row];
      known_[row] += storage_[row] * start.film[row] + film.flows.dissipation(node, l) + made(film, node, l);
    }
  }
}

double HeatEquations::slope_across(const Eigen::VectorXd& T, int node, int layer) const {
  return across_.slope(static_cast<std::size_t>(layer),
                       [&](std::size_t l) { return T[system_.row(node, static_cast<int>(l))]; });
}

void HeatEquations::add_flows(const CarryingFilm& film, const HeatState& start) {
  inflow_.setZero(system_.size());
  for (std::size_t f = 0; f < film.balance.faces().size(); ++f) {
    std::array<std::optional<Upstream>, 2> ways;  // layers may flow in either direction
    for (int l = 0; l < layers(); ++l) {
      const double q = film.flows.over_face(f, l);
      if (q == 0) continue;
      std::optional<Upstream>& way = ways[q > 0 ? 0 : 1];
      if (!way) way = upstream(film, f, q > 0);
      add_flow(*way, l, std::abs(q));
      const Face& face = film.balance.faces()[f];
      const double most = std::abs(q) * width(l) / 6;  // limit, reached by oil that flows in one direction
      const double lead =
          rc_ * std::clamp(film.flows.lead_over_face(f, l), -most, most) * slope_across(start.film, way->from, l);
      known_[system_.row(face.a, l)] -= lead;
      known_[system_.row(face.b, l)] += lead;
    }
  }
}

// Returns the side of a node on which another one lies.
HeatSystem::Side HeatEquations::side_of(int from, int to) const {
  const int n_z = model_.grid.n_z;
  if (to / n_z == from / n_z) return to > from ? HeatSystem::left : HeatSystem::right;
  return to / n_z == model_.grid.next(from / n_z) ? HeatSystem::before : HeatSystem::after;
}

// On the face oil has the temperature extrapolated from the last two nodes (thermal.11). Beside a supply, an edge or an
// empty node it has that of the last node.
HeatEquations::Upstream HeatEquations::upstream(const CarryingFilm& film, std::size_t f, bool is_forwards) const {
  const Face& face = film.balance.faces()[f];
  const Grid& grid = model_.grid;
  const GridGeometry& geometry = film.balance.geometry();
  const int from = is_forwards ? face.a : face.b, to = is_forwards ? face.b : face.a;
  Upstream way{.from = from, .to = to, .side = side_of(from, to)};
  const int i = from / grid.n_z, j = from % grid.n_z;
  int behind = -1;
  double length = 0;
  if (to / grid.n_z == i) {
    const int beyond = 2 * j - to % grid.n_z;
    if (beyond < 0 || beyond >= grid.n_z) return way;
    behind = grid.index(i, beyond);
    length = geometry.dz[std::min(j, beyond)];
  } else {
    const int last = grid.before(i), next = grid.next(i);
    const int beyond = to / grid.n_z == next ? last : next;
    if (beyond < 0) return way;
    behind = grid.index(beyond, j);
    length = geometry.step(beyond == last ? last : i, j);
  }
  const FlowBalance& b = film.balance;
  if (b.nodes()[behind].content < 1e-3) return way;
  // The extrapolation counts by the fraction of oil at both nodes that a line does not mix, so that nothing jumps as
  // the line passes over a node. Beside a feature it does not count at all.
  const auto own = [&b](int node) {
    const double mixed_fraction = b.supplied_fraction(node);
    return mixed_fraction > 0 && b.supplied_by(node) >= 0 ? 0.0 : 1 - mixed_fraction;
  };
  way.slope_fraction = own(from) * own(behind) * 0.5 * face.length / length;
  return way;
}

// Oil has the temperature of the node upstream (thermal.10) plus its rise from there to the face.
void HeatEquations::add_flow(const Upstream& way, int layer, double q) {
  const double heat = rc_ * q, extrapolated = heat * way.slope_fraction;
  system_.diagonal(system_.row(way.to, layer)) += heat;
  system_.beside(way.to, layer, way.side) -= heat + extrapolated;
  inflow_[system_.row(way.to, layer)] += q;
  if (extrapolated == 0) return;
  system_.diagonal(system_.row(way.from, layer)) += extrapolated;
  system_.beside(way.from, layer, way.side) -= extrapolated;
  system_.beyond(way.to, layer, way.side) += extrapolated;
}

// The flow has the mean temperature of both layers, of second order, where conduction between them is comparable with
// it; beyond that it tends to the temperature upstream (thermal.52).
void HeatEquations::add_flow_upwards(const CarryingFilm& film) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    for (int l = 0; l + 1 < layers(); ++l) {
      const double q = rc_ * film.flows.upwards(node, l), conduction = between(film, node, l);
      const double upstream = std::max(0.5 * std::abs(q) - trusted * conduction, 0.0);
      const double up = 0.5 * q + upstream, down = 0.5 * q - upstream;
      system_.diagonal(system_.row(node, l + 1)) += up;
      system_.below(node, l + 1) -= up;
      system_.diagonal(system_.row(node, l)) -= down;
      system_.above(node, l) += down;
    }
  }
}

void HeatEquations::add_edges(const CarryingFilm& film, const HeatState& start) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double in = -film.balance.outflow(node);
    if (in <= 0) continue;
    const double T = coming(film, start, node);
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      inflow_[row] += in * width(l);
      system_.diagonal(row) += rc_ * in * width(l);
      known_[row] += rc_ * in * width(l) * T;
      if (const Eigen::Index terminal = at_.index_of_oil(thermal_.oil.edges); terminal >= 0)
        by_outside_(row, terminal) += rc_ * in * width(l);
    }
  }
}

void HeatEquations::add_conduction(const CarryingFilm& film) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    for (int l = 0; l + 1 < layers(); ++l) {
      const double k = between(film, node, l);
      system_.diagonal(system_.row(node, l)) += k;
      system_.above(node, l) -= k;
      system_.diagonal(system_.row(node, l + 1)) += k;
      system_.below(node, l + 1) -= k;
    }
  }
}

// A wall without heat leaves its part of the asperities' dissipation to the oil (thermal.54).
void HeatEquations::add_shell(const CarryingFilm& film, const HeatState& start) {
  const bool is_insulated = !conducts(thermal_.shell);
  const bool has_rows = has_own_temperatures(thermal_.shell);
  for (int node = 0; node < model_.grid.size(); ++node) {
    const int row = system_.row(node, 0), i = node / model_.grid.n_z;
    const double friction = shell_friction(film, node);
    if (is_insulated) {
      known_[row] += friction;
      continue;
    }
    const WallFlux flux = to_shell(film, node);
    system_.diagonal(row) += flux.beside;
    if (layers() > 1) system_.above(node, 0) -= flux.next;
    if (!has_rows) {
      known_[row] += flux.wall() * start.shell[i];
      by_shell_[row] += flux.wall();
      continue;
    }
    system_.to_ring(node) -= flux.wall();
    system_.diagonal(system_.ring_row(i)) += flux.wall();
    system_.from_film(node, 0) -= flux.beside;
    system_.from_film(node, 1) += flux.next;
    known_[system_.ring_row(i)] += friction;
  }
  if (std::holds_alternative<RingWall>(thermal_.shell)) add_ring(film, start);
  if (const WallConduction* body = conduction_of(thermal_.shell)) add_body(*body, film, start);
}

// In a steady film a body is in balance with all of the heat (thermal.37); over a step it keeps its temperatures. If
// these are fixed for a cycle, the rows are at first balances of heat, of which the mean is taken.
void HeatEquations::add_body(const WallConduction& body, const CarryingFilm& film, const HeatState& start) {
  const int n = model_.grid.n_phi, first = system_.ring_row(0);
  if (film.dt > 0) {
    system_.set_answer(nullptr, 1);
    if (has_fixed_walls(film)) return;
    for (int node = 0; node < model_.grid.size(); ++node) system_.from_film(node, 0) = system_.from_film(node, 1) = 0;
    for (int i = 0; i < n; ++i) {
      system_.diagonal(first + i) = 1;
      known_[first + i] = start.shell[i];
    }
    return;
  }
  double scale = 0;
  for (int i = 0; i < n; ++i) scale += system_.diagonal(first + i) / n;
  if (scale == 0) scale = 1;
  system_.set_answer(&body.rise, scale);
  const Eigen::VectorXd friction = known_.segment(first, n);
  known_.segment(first, n) = scale * body.temperatures(friction);
}

void HeatEquations::add_ring(const CarryingFilm& film, const HeatState& start) {
  const int n = model_.grid.n_phi;
  for (int i = 0; i < n; ++i) {
    const int row = system_.ring_row(i), next = (i + 1) % n;
    system_.diagonal(row) += ring_.around[i];
    system_.ring_after(i) -= ring_.around[i];
    system_.diagonal(system_.ring_row(next)) += ring_.around[i];
    system_.ring_before(next) -= ring_.around[i];
    system_.diagonal(row) += ring_.outside[i];
    known_[row] += ring_.outside[i] * at_ring(outside_);
    if (at_.ambient) by_outside_(row, at_.index_of_ambient()) += ring_.outside[i];
    if (film.dt == 0 || has_fixed_walls(film)) continue;
    system_.diagonal(row) += ring_.capacity[i] / film.dt;
    known_[row] += ring_.capacity[i] / film.dt * start.shell[i];
  }
}

void HeatEquations::add_journal(const CarryingFilm& film) {
  const bool is_insulated = !conducts(thermal_.journal);
  for (int node = 0; node < model_.grid.size(); ++node) {
    const int row = system_.row(node, top());
    if (is_insulated) {
      known_[row] += journal_friction(film, node);
      continue;
    }
    const WallFlux flux = to_journal(film, node);
    system_.diagonal(row) += flux.beside;
    if (layers() > 1) system_.below(node, top()) -= flux.next;
    by_journal_[row] += flux.wall();
  }
}

// The film's heat into its walls is already that of the node's fraction of the area and must not be scaled again.
void HeatEquations::add_walls_of_film(const CarryingFilm& film, const HeatState& start, int node, double chi) {
  if (conducts(thermal_.shell)) {
    const WallFlux flux = to_shell(film, node);
    const int row = system_.row(node, 0);
    system_.diagonal(row) += chi * flux.beside;
    if (layers() > 1) system_.above(node, 0) -= chi * flux.next;
    if (has_own_temperatures(thermal_.shell)) {
      system_.to_ring(node) -= chi * flux.wall();
    } else {
      known_[row] += chi * flux.wall() * start.shell[node / model_.grid.n_z];
      by_shell_[row] += chi * flux.wall();
    }
  }
  if (!conducts(thermal_.journal)) return;
  const WallFlux flux = to_journal(film, node);
  const int row = system_.row(node, top());
  system_.diagonal(row) += chi * flux.beside;
  if (layers() > 1) system_.below(node, top()) -= chi * flux.next;
  by_journal_[row] += chi * flux.wall();
}

// A line has no width: the dissipation at its nodes warms only the film's oil at the line, not all of the oil that the
// line mixes. It is distributed over all layers, which the line mixes, too.
void HeatEquations::add_film_on_line(const CarryingFilm& film, const SuppliedNode& supplied,
                                     const Eigen::VectorXd& taken_on) {
  double heat = 0;
  for (int l = 0; l < layers(); ++l) heat += supplied.chi * film.flows.dissipation(supplied.node, l);
  const double all = taken_on.sum();
  for (int l = 0; l < layers() && all > 0; ++l) known_[system_.row(supplied.node, l)] += heat * taken_on[l] / all;
}

// Oil leaves a supply at its temperature. Of the oil that passes a node, the supply's part takes that temperature
// (thermal.14).
void HeatEquations::add_supplies(const CarryingFilm& film, const HeatState& start) {
  supplied_nodes_.clear();
  supply_of_.assign(static_cast<std::size_t>(model_.grid.size()), -1);
  for (int node = 0; node < model_.grid.size(); ++node) {
    if (!film.balance.is_supplied(node)) continue;
    SuppliedNode supplied{.node = node,
                          .supply = film.balance.supplied_by(node) + (has_line() ? 1 : 0),
                          .chi = film.balance.supplied_fraction(node),
                          .flow = film.balance.supply(node)};
    supply_of_[node] = supplied.supply;
    const double thread = least_fill_ * throughput(film);
    Eigen::VectorXd taken_on(layers());
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double fraction = supplied.flow > 0 ? width(l) : film.flows.leaving_fraction(node, l);
      const double in = rc_ * std::max(supplied.flow, 0.0) * fraction, passing = rc_ * inflow_[row];
      supplied.rows.push_back(
          {system_.entries(node, l), known_[row], by_shell_[row], by_journal_[row], by_outside_.row(row)});
      supplied.rows.back().entries.front().second += rc_ * supplied.flow * fraction;
      taken_on[l] = supplied.chi * std::max(passing + in, rc_ * thread * width(l));
      system_.diagonal(row) += in;
      system_.scale(row, 1 - supplied.chi);
      known_[row] *= 1 - supplied.chi, by_shell_[row] *= 1 - supplied.chi, by_journal_[row] *= 1 - supplied.chi;
      by_outside_.row(row) *= 1 - supplied.chi;
      system_.diagonal(row) += taken_on[l];
      by_supply_[row] = (1 - supplied.chi) * in + taken_on[l];
    }
    add_walls_of_film(film, start, node, supplied.chi);
    if (is_line(supplied.supply)) add_film_on_line(film, supplied, taken_on);
    supplied_nodes_.push_back(std::move(supplied));
  }
}

// The supply has mixed its own inflow into a node, its fraction of the oil that passes, and oil that it had mixed
// before. Beside nodes wholly in the supply two passes find all of it.
void HeatEquations::find_mixed_fractions(const CarryingFilm& film) {
  const auto& faces = film.balance.faces();
  mixed_fraction_.setZero(system_.size());
  Eigen::VectorXd came(system_.size());
  for (int pass = 0; pass < 2; ++pass) {
    came.setZero();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      for (int l = 0; l < layers(); ++l) {
        const double q = film.flows.over_face(f, l);
        const int from = q > 0 ? faces[f].a : faces[f].b, to = q > 0 ? faces[f].b : faces[f].a;
        if (supply_of_[to] == supply_of_[from])
          came[system_.row(to, l)] += std::abs(q) * mixed_fraction_[system_.row(from, l)];
      }
    }
    for (const SuppliedNode& supplied : supplied_nodes_) {
      for (int l = 0; l < layers(); ++l) {
        const int row = system_.row(supplied.node, l);
        const double given = std::max(supplied.flow, 0.0) * width(l), passing = inflow_[row];
        const double own = given + supplied.chi * passing + (1 - supplied.chi) * came[row];
        mixed_fraction_[row] = passing + given > 0 ? std::min(1.0, own / (passing + given)) : 1;
      }
    }
  }
}

// A fraction of the film's oil that reaches a supply is not carried over but replaced: of the oil that reaches a node,
// the part that the supply mixes there and takes away. A part of a node's oil may already be the supply's own; the
// film's heat is counted above it.
void HeatEquations::renew(const CarryingFilm& film) {
  renewals_.clear();
  if (thermal_.carry_over == 1) return;
  find_mixed_fractions(film);
  std::vector<const SuppliedNode*> supplied_at(static_cast<std::size_t>(model_.grid.size()), nullptr);
  for (const SuppliedNode& supplied : supplied_nodes_) supplied_at[static_cast<std::size_t>(supplied.node)] = &supplied;
  const double replaced = (1 - thermal_.carry_over) * rc_;
  const auto& faces = film.balance.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int l = 0; l < layers(); ++l) {
      const double q = film.flows.over_face(f, l);
      const int from = q > 0 ? faces[f].a : faces[f].b;
      const SuppliedNode* supplied = supplied_at[static_cast<std::size_t>(q > 0 ? faces[f].b : faces[f].a)];
      if (supplied == nullptr || q == 0) continue;
      const int to = system_.row(supplied->node, l);
      const double taken =
          std::min(1.0, std::max(-supplied->flow, 0.0) * film.flows.leaving_fraction(supplied->node, l) / inflow_[to]);
      const double heat = replaced * (supplied->chi + (1 - supplied->chi) * taken) * std::abs(q);
      const double mixed_fraction = mixed_fraction_[system_.row(from, l)];
      // oil that another supply has mixed is part of that supply's balance
      const bool is_same = supply_of_[from] == supplied->supply;
      renewals_.push_back({supplied->supply, system_.row(from, l), is_same ? heat : (1 - mixed_fraction) * heat,
                           is_same ? mixed_fraction : 0});
    }
  }
}

// Balance of a free journal (thermal.13). A journal in a body passes all of its heat through the body's resistance,
// (thermal.60) over that: as to a lumped body of the temperature T_0 with the conductance 1/g.
void HeatEquations::add_journal_row(const CarryingFilm& film, const HeatState& start) {
  const int journal = system_.size();
  const auto* free = std::get_if<FreeJournal>(&thermal_.journal);
  const JournalConduction* body = conduction_of(thermal_.journal);
  const double heat_capacity = free != nullptr ? free->heat_capacity : 0;
  journal_moves_ = free != nullptr || (body != nullptr && body->rise > 0 && film.dt == 0);
  journal_self_ = 0;
  into_journal_.assign(static_cast<std::size_t>(model_.grid.size()), {});
  if (journal_moves_) {
    for (int node = 0; node < model_.grid.size(); ++node) {
      into_journal_[node] = to_journal(film, node);
      journal_self_ += into_journal_[node].wall();
      known_[journal] += journal_friction(film, node);
    }
    if (body != nullptr) {
      journal_self_ += 1 / body->rise;
      known_[journal] += body->T0 / body->rise;
    } else if (film.dt > 0 && !has_fixed_walls(film)) {
      journal_self_ += heat_capacity / film.dt;
      known_[journal] += heat_capacity / film.dt * start.journal;
    }
  }
  if (journal_self_ == 0) fix_journal(body != nullptr && film.dt == 0 ? body->T0 : start.journal);
}

// Adds the row of the journal and those of the supplies (thermal.15).
void HeatEquations::add_remainder(const CarryingFilm& film, const HeatState& start) {
  const int journal = system_.size();
  add_journal_row(film, start);
  const double thread = rc_ * kThreadOfSupply * throughput(film);
  std::vector<double> flow(static_cast<std::size_t>(supplies()), 0.0);
  for (const SuppliedNode& supplied : supplied_nodes_) {
    flow[supplied.supply] += supplied.flow;
    for (const SuppliedNode::Row& row : supplied.rows) {
      known_[journal + 1 + supplied.supply] += row.known;
      by_shell_[journal + 1 + supplied.supply] += row.by_shell;
      by_outside_.row(journal + 1 + supplied.supply) += row.by_outside;
    }
  }
  const auto give = [&](int supply, double heat) {  // oil at the temperature of fresh oil
    known_[journal + 1 + supply] += heat * fresh(supply, outside_);
    if (const Eigen::Index terminal = oil_of(supply); terminal >= 0)
      by_outside_(journal + 1 + supply, terminal) += heat;
  };
  for (const Renewal& renewal : renewals_) give(renewal.supply, renewal.heat * (1 - renewal.mixed_fraction));
  supply_self_.assign(flow.size(), 0.0);
  for (int s = 0; s < supplies(); ++s) {
    supply_self_[s] = rc_ * std::max(-flow[s], 0.0) + thread;
    give(s, rc_ * std::max(flow[s], 0.0) + thread);
  }
}

}  // namespace hersey::film
