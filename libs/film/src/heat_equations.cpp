#include "heat_equations.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "hersey/core/contract.h"
#include "hersey/solver/fixed_point_iteration.h"

namespace hersey::film {
namespace {

// Nodes without oil keep heat as if they held so small a share of what the clearance does.
constexpr double least_fill = 1e-6;

// Second differences of a steady film are found to this share of the change there was, in so many iterations at most.
constexpr double steady_share = 1e-5;
constexpr int most_corrections = 30;

// Columns of the right-hand side: what is known, the journal's temperature, and from there on those of supplies.
constexpr int known = 0, by_journal = 1, by_supplies = 2;

double oil_share(const Node& node) { return std::clamp(node.theta, least_fill, 1.0); }

}  // namespace

HeatEquations::HeatEquations(const FilmModel& model, const ThermalModel& thermal)
    : model_(model),
      thermal_(thermal),
      rc_(model.lubricant.density * model.lubricant.specific_heat),
      system_(model.grid, thermal.layers, std::holds_alternative<RingWall>(thermal.shell)) {
  if (const auto* ring = std::get_if<RingWall>(&thermal_.shell)) ring_ = conductances(model_, GridGeometry(model_), *ring);
}

double HeatEquations::fresh(int supply) const {
  const int feature = supply - (has_line() ? 1 : 0);
  if (feature < 0 || thermal_.T_features.empty()) return thermal_.T_supply;
  return thermal_.T_features[static_cast<std::size_t>(feature)];
}

double HeatEquations::asperity_power(const CarryingFilm& film, int node) const {
  return film.balance.area(node) * film.balance.nodes()[node].asperity * film.wrench.friction_power_per_contact();
}

// Half a layer of oil lies between, and what else resists. Oil that stands in a supply is no film: it heats no wall.
double HeatEquations::to_wall(const CarryingFilm& film, int node, double resistance) const {
  const Node& at = film.balance.nodes()[node];
  const double k = model_.lubricant.conductivity * oil_share(at), area = film.balance.area(node);
  return k == 0 ? 0 : film.balance.balance_share(node) * area / (at.h / (2 * layers() * k) + resistance);
}

double HeatEquations::to_shell(const CarryingFilm& film, int node) const {
  return conducts(thermal_.shell) ? to_wall(film, node, ring_.inside) : 0;
}

double HeatEquations::to_journal(const CarryingFilm& film, int node) const {
  return conducts(thermal_.journal) ? to_wall(film, node, 0) : 0;
}

double HeatEquations::into_shell(const CarryingFilm& film, const HeatState& state, int node) const {
  if (!conducts(thermal_.shell)) return 0;
  return to_shell(film, node) * (state.film[node * layers()] - state.shell[node / model_.grid.n_z]);
}

double HeatEquations::into_journal(const CarryingFilm& film, const HeatState& state, int node) const {
  return to_journal(film, node) * (state.film[node * layers() + top()] - state.journal);
}

// With the oil of the end and the rate at which it has changed; pockets of air keep a little.
double HeatEquations::start_volume(const CarryingFilm& film, int node) const {
  const FlowBalance& b = film.balance;
  const double end = b.area(node) * b.nodes()[node].content * b.oil_gap(node);
  return std::max(end - film.dt * b.storage(node), least_fill * b.area(node) * model_.c);
}

HeatState HeatEquations::solve(const CarryingFilm& film, const HeatState& start) {
  system_.set_zero();
  rhs_.setZero(system_.size(), by_supplies + supplies());
  add_storage(film, start);
  add_flows(film);
  add_flow_upwards(film);
  add_edges(film);
  add_conduction(film);
  add_shell(film, start);
  add_journal(film);
  add_supplies(film);
  renew(film);
  HERSEY_REQUIRE(system_.factorise(), "every layer exchanges heat with something");
  answers_ = rhs_;
  system_.solve(answers_);

  HeatState end = with_corrections(film, start, start.film);
  if (film.dt == 0) {
    solver::FixedPointIteration mixing(solver::Acceleration::quasi_newton, 1);
    Eigen::VectorXd lagged = start.film;
    const double enough = steady_share * (end.film - lagged).norm();
    for (int k = 0; k < most_corrections && (end.film - lagged).norm() > enough; ++k) {
      lagged = mixing.next(lagged.array() - thermal_.T_supply, end.film.array() - thermal_.T_supply).array() +
               thermal_.T_supply;
      end = with_corrections(film, start, lagged);
    }
  }
  take_balance(film, start, end);
  return end;
}

// The system with second differences of `lagged`.
HeatState HeatEquations::with_corrections(const CarryingFilm& film, const HeatState& start,
                                          const Eigen::VectorXd& lagged) {
  Eigen::MatrixXd known_side = rhs_.col(known);
  known_side.col(0) += corrections(lagged);
  system_.solve(known_side);
  answers_.col(known) = known_side;
  const Remainder rest = remainder(film, start, lagged);
  const Eigen::VectorXd y = rest.A.partialPivLu().solve(rest.b);
  const Eigen::VectorXd x = answers_.col(known) + answers_.rightCols(y.size()) * y;
  HeatState end = start;
  end.film = x.head(start.film.size());
  if (x.size() > end.film.size()) end.shell = x.tail(model_.grid.n_phi);
  end.journal = y[0];
  end.supplies = y.tail(supplies());
  return end;
}

// (thermal.10): without flow a steady film would have no temperature, so that a thread of storage is left to it.
void HeatEquations::add_storage(const CarryingFilm& film, const HeatState& start) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double thread = least_fill * film.balance.largest_throughput();
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double rate = film.dt > 0 ? start_volume(film, node) / film.dt : thread * 1e-6;
      system_.diagonal(row) += rc_ * rate / layers();
      rhs_(row, known) += rc_ * rate / layers() * start.film[row] + film.flows.dissipation(node, l);
    }
  }
}

void HeatEquations::add_flows(const CarryingFilm& film) {
  corrections_.clear();
  inflow_.assign(static_cast<std::size_t>(model_.grid.size()), 0.0);
  const auto& faces = film.balance.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int l = 0; l < layers(); ++l) {
      const double q = film.flows.over_face(f, l);
      if (q > 0) add_flow(faces[f].a, faces[f].b, l, q);
      if (q < 0) add_flow(faces[f].b, faces[f].a, l, -q);
      add_second_order(film, f, l, q);
    }
  }
}

// Oil comes with the temperature of where it has been (thermal.10).
void HeatEquations::add_flow(int from, int to, int layer, double q) {
  const int n_z = model_.grid.n_z, n_phi = model_.grid.n_phi;
  const int step = to - from;
  HeatSystem::Side side = HeatSystem::left;
  if (to / n_z == from / n_z) {
    side = step > 0 ? HeatSystem::left : HeatSystem::right;
  } else {
    const bool forwards = to / n_z == (from / n_z + 1) % n_phi;
    side = forwards ? HeatSystem::before : HeatSystem::after;
  }
  system_.diagonal(system_.row(to, layer)) += rc_ * q;
  system_.beside(to, layer, side) -= rc_ * q;
  inflow_[static_cast<std::size_t>(to)] += q;
}

// On the face oil has the temperature that the last two nodes extrapolate to (thermal.11). Beside a supply, an edge or
// an empty node it has that of the last node.
void HeatEquations::add_second_order(const CarryingFilm& film, std::size_t f, int layer, double q) {
  if (q == 0) return;
  const Face& face = film.balance.faces()[f];
  const Grid& grid = model_.grid;
  const GridGeometry& geometry = film.balance.geometry();
  const int from = q > 0 ? face.a : face.b, to = q > 0 ? face.b : face.a;
  const int i = from / grid.n_z, j = from % grid.n_z;
  int behind = -1;
  double length = 0;
  if (to / grid.n_z == i) {
    const int beyond = 2 * j - to % grid.n_z;
    if (beyond < 0 || beyond >= grid.n_z) return;
    behind = grid.index(i, beyond);
    length = geometry.dz[std::min(j, beyond)];
  } else {
    const int last = (i + grid.n_phi - 1) % grid.n_phi, next = (i + 1) % grid.n_phi;
    const int beyond = to / grid.n_z == next ? last : next;
    behind = grid.index(beyond, j);
    length = geometry.dx[beyond == last ? last : i];
  }
  const FlowBalance& b = film.balance;
  if (b.is_held(from) || b.is_held(behind) || b.nodes()[behind].content < 1e-3) return;
  corrections_.push_back({.behind = system_.row(behind, layer),
                          .from = system_.row(from, layer),
                          .to = system_.row(to, layer),
                          .share_from = b.balance_share(from),
                          .share_to = b.balance_share(to),
                          .supply = b.is_held(to) ? b.feature_at(to) + (has_line() ? 1 : 0) : -1,
                          .heat = rc_ * std::abs(q) * 0.5 * face.length / length});
}

Eigen::VectorXd HeatEquations::corrections(const Eigen::VectorXd& film) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(system_.size());
  for (const Correction& c : corrections_) {
    const double carried = c.heat * (film[c.from] - film[c.behind]);
    heat[c.from] -= c.share_from * carried;
    heat[c.to] += c.share_to * carried;
  }
  return heat;
}

void HeatEquations::add_flow_upwards(const CarryingFilm& film) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    for (int l = 0; l + 1 < layers(); ++l) {
      const double q = rc_ * film.flows.upwards(node, l);
      if (q > 0) {
        system_.diagonal(system_.row(node, l + 1)) += q;
        system_.below(node, l + 1) -= q;
      } else {
        system_.diagonal(system_.row(node, l)) -= q;
        system_.above(node, l) += q;
      }
    }
  }
}

void HeatEquations::add_edges(const CarryingFilm& film) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double in = -film.balance.outflow(node);
    if (in <= 0) continue;
    inflow_[static_cast<std::size_t>(node)] += in;
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      system_.diagonal(row) += rc_ * in / layers();
      rhs_(row, known) += rc_ * in / layers() * thermal_.T_edges;
    }
  }
}

void HeatEquations::add_conduction(const CarryingFilm& film) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    const Node& at = film.balance.nodes()[node];
    const double k = model_.lubricant.conductivity * oil_share(at) * film.balance.area(node) * layers() / at.h;
    for (int l = 0; l + 1 < layers(); ++l) {
      system_.diagonal(system_.row(node, l)) += k;
      system_.above(node, l) -= k;
      system_.diagonal(system_.row(node, l + 1)) += k;
      system_.below(node, l + 1) -= k;
    }
  }
}

// Half of what asperities dissipate goes into either wall; one without heat leaves it to the oil (thermal.13).
void HeatEquations::add_shell(const CarryingFilm& film, const HeatState& start) {
  const bool is_insulated = !conducts(thermal_.shell);
  const auto* ring = std::get_if<RingWall>(&thermal_.shell);
  for (int node = 0; node < model_.grid.size(); ++node) {
    const int row = system_.row(node, 0), i = node / model_.grid.n_z, j = node % model_.grid.n_z;
    const double friction = 0.5 * asperity_power(film, node);
    if (is_insulated) {
      rhs_(row, known) += friction;
      continue;
    }
    const double G = to_shell(film, node);
    system_.diagonal(row) += G;
    if (ring == nullptr) {
      rhs_(row, known) += G * start.shell[i];
      continue;
    }
    system_.to_ring(node) -= G;
    system_.diagonal(system_.ring_row(i)) += G;
    system_.from_film(i, j) -= G;
    rhs_(system_.ring_row(i), known) += friction;
  }
  if (ring != nullptr) add_ring(*ring, film, start);
}

void HeatEquations::add_ring(const RingWall& ring, const CarryingFilm& film, const HeatState& start) {
  const int n = model_.grid.n_phi;
  for (int i = 0; i < n; ++i) {
    const int row = system_.ring_row(i), next = (i + 1) % n;
    system_.diagonal(row) += ring_.around[i];
    system_.ring_after(i) -= ring_.around[i];
    system_.diagonal(system_.ring_row(next)) += ring_.around[i];
    system_.ring_before(next) -= ring_.around[i];
    system_.diagonal(row) += ring_.outside[i];
    rhs_(row, known) += ring_.outside[i] * ring.T_ambient;
    if (film.dt == 0) continue;
    system_.diagonal(row) += ring_.capacity[i] / film.dt;
    rhs_(row, known) += ring_.capacity[i] / film.dt * start.shell[i];
  }
}

void HeatEquations::add_journal(const CarryingFilm& film) {
  const bool is_insulated = !conducts(thermal_.journal);
  for (int node = 0; node < model_.grid.size(); ++node) {
    const int row = system_.row(node, top());
    if (is_insulated) {
      rhs_(row, known) += 0.5 * asperity_power(film, node);
      continue;
    }
    const double G = to_journal(film, node);
    system_.diagonal(row) += G;
    rhs_(row, by_journal) += G;
  }
}

// Oil comes out of a supply with the temperature there; of what passes a node, the supply's share takes it on
// (thermal.14).
void HeatEquations::add_supplies(const CarryingFilm& film) {
  held_.clear();
  for (int node = 0; node < model_.grid.size(); ++node) {
    if (!film.balance.is_held(node)) continue;
    Held held{.node = node,
              .supply = film.balance.feature_at(node) + (has_line() ? 1 : 0),
              .chi = 1 - film.balance.balance_share(node),
              .flow = film.balance.supply(node)};
    const int column = by_supplies + held.supply;
    const double passing = std::max(inflow_[static_cast<std::size_t>(node)] + std::max(held.flow, 0.0),
                                    least_fill * film.balance.largest_throughput());
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double share = held.flow > 0 ? 1.0 / layers() : film.flows.leaving_share(node, l);
      held.rows.push_back({system_.entries(row), rhs_(row, known), rhs_(row, by_journal), rc_ * held.flow * share});
      const double in = rc_ * std::max(held.flow, 0.0) * share, taken_on = held.chi * rc_ * passing / layers();
      system_.diagonal(row) += in;
      rhs_(row, column) += in;
      system_.scale(row, 1 - held.chi);
      rhs_.row(row) *= 1 - held.chi;
      system_.diagonal(row) += taken_on;
      rhs_(row, column) += taken_on;
    }
    held_.push_back(std::move(held));
  }
}

// Of the film's oil that comes to a supply, a share is not carried over but replaced.
void HeatEquations::renew(const CarryingFilm& film) {
  renewals_.clear();
  if (thermal_.carry_over == 1) return;
  std::vector<const Held*> held_at(static_cast<std::size_t>(model_.grid.size()), nullptr);
  for (const Held& held : held_) held_at[static_cast<std::size_t>(held.node)] = &held;
  const auto& faces = film.balance.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int l = 0; l < layers(); ++l) {
      const double q = film.flows.over_face(f, l);
      const int from = q > 0 ? faces[f].a : faces[f].b;
      const Held* held = held_at[static_cast<std::size_t>(q > 0 ? faces[f].b : faces[f].a)];
      if (held == nullptr || q == 0) continue;
      const double taken = held->chi * film.balance.balance_share(from);
      renewals_.push_back(
          {held->supply, system_.row(from, l), (1 - thermal_.carry_over) * taken * rc_ * std::abs(q)});
    }
  }
}

double HeatEquations::renewed(const HeatState& state, int supply) const {
  double heat = 0;
  for (const Renewal& renewal : renewals_)
    if (renewal.supply == supply) heat += renewal.heat * (state.film[renewal.row] - fresh(supply));
  return heat;
}

// The journal's balance (thermal.13) and those of the supplies (thermal.15), once the film's answers to them are known.
HeatEquations::Remainder HeatEquations::remainder(const CarryingFilm& film, const HeatState& start,
                                                  const Eigen::VectorXd& lagged) const {
  const int n = 1 + supplies();
  Remainder rest{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  if (const auto* free = std::get_if<FreeJournal>(&thermal_.journal)) {
    for (int node = 0; node < model_.grid.size(); ++node) {
      const double G = to_journal(film, node);
      const int row = system_.row(node, top());
      rest.A(0, 0) += G;
      rest.A.row(0) -= G * answers_.row(row).tail(n);
      rest.b[0] += G * answers_(row, known) + 0.5 * asperity_power(film, node);
    }
    if (film.dt > 0) {
      rest.A(0, 0) += free->heat_capacity / film.dt;
      rest.b[0] += free->heat_capacity / film.dt * start.journal;
    }
    if (rest.A(0, 0) == 0) rest.A(0, 0) = 1, rest.b[0] = start.journal;
  } else {
    rest.A(0, 0) = 1, rest.b[0] = start.journal;
  }
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(supplies());
  for (const Held& held : held_) {
    const int s = 1 + held.supply;
    flow[held.supply] += held.flow;
    for (int l = 0; l < layers(); ++l) {
      const Held::Row& row = held.rows[static_cast<std::size_t>(l)];
      const auto add = [&](int column, double entry) {
        rest.A.row(s) += entry * answers_.row(column).tail(n);
        rest.b[s] -= entry * answers_(column, known);
      };
      for (const auto& [column, entry] : row.entries) add(column, entry);
      add(system_.row(held.node, l), row.flow);
      rest.A(s, 0) -= row.by_journal;
      rest.b[s] += row.known;
    }
  }
  for (const Correction& c : corrections_)
    if (c.supply >= 0) rest.b[1 + c.supply] += c.heat * (lagged[c.from] - lagged[c.behind]);
  for (const Renewal& renewal : renewals_) {
    const int s = 1 + renewal.supply;
    rest.A.row(s) += renewal.heat * answers_.row(renewal.row).tail(n);
    rest.b[s] += renewal.heat * (fresh(renewal.supply) - answers_(renewal.row, known));
  }
  const double thread = rc_ * 1e-9 * film.balance.largest_throughput();
  for (int k = 0; k < supplies(); ++k) {
    const int s = 1 + k;
    rest.A(s, s) += rc_ * std::max(-flow[k], 0.0) + thread;
    rest.b[s] += (rc_ * std::max(flow[k], 0.0) + thread) * fresh(k);
  }
  return rest;
}

// Each term by its own integral; temperatures count from that of the supply, so that a missing drop of oil brings no
// heat (thermal.17).
void HeatEquations::take_balance(const CarryingFilm& film, const HeatState& start, const HeatState& end) {
  const double T0 = thermal_.T_supply;
  balance_ = {};
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double friction = asperity_power(film, node), out = film.balance.outflow(node);
    balance_.power += friction;
    balance_.to_shell += into_shell(film, end, node) + (conducts(thermal_.shell) ? 0.5 * friction : 0);
    balance_.to_journal += into_journal(film, end, node) + (conducts(thermal_.journal) ? 0.5 * friction : 0);
    const double from = film.dt > 0 ? start_volume(film, node) : 0;
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double T = end.film[row] - T0;
      balance_.power += film.flows.dissipation(node, l);
      balance_.to_oil += rc_ * (out > 0 ? out * film.flows.leaving_share(node, l) * T : out / layers() * (thermal_.T_edges - T0));
      balance_.to_oil += rc_ * film.flows.lost(node) / layers() * T;
      if (film.dt == 0) {
        balance_.stored += rc_ * film.balance.storage(node) / layers() * T;
        continue;
      }
      const double to = from + film.dt * film.balance.storage(node);
      balance_.stored += rc_ * (to * T - from * (start.film[row] - T0)) / (layers() * film.dt);
    }
  }
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(supplies());
  for (const Held& held : held_) flow[held.supply] += held.flow;
  for (int k = 0; k < supplies(); ++k)
    balance_.to_oil += renewed(end, k) - rc_ * flow[k] * ((flow[k] > 0 ? fresh(k) : end.supplies[k]) - T0);
}

}  // namespace hersey::film
