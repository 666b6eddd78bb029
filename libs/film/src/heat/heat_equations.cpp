#include "heat/heat_equations.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::film {
namespace {

// Nodes without oil keep heat as if they held so small a share of what the clearance does.
constexpr double least_fill = 1e-6;

// How far the equations are solved, as a share of what is missing at the start: of a steady film, which is taken in
// turn with its temperature, and of a step.
constexpr double steady_share = 1e-4, step_share = 1e-9;
// A body that answers heat as a whole by temperatures has small rows: little is missing in them.
constexpr double body_share = 1e-7;
// Likewise the answers to temperatures of walls, which multiply what these move in a step.
constexpr double response_share = 1e-7;

// Oil that flows across has the mean of two layers' temperatures up to so many times the flow at which conduction alone
// would still keep each between its neighbours'; flow along the film does that as well.
constexpr double trusted = 4;

double oil_share(const Node& node) { return std::clamp(node.theta, least_fill, 1.0); }

}  // namespace

HeatEquations::HeatEquations(const FilmModel& model, const ThermalModel& thermal)
    : model_(model),
      thermal_(thermal),
      at_(terminals_of(thermal)),
      across_(layering_of(static_cast<std::size_t>(thermal.layers))),
      rc_(model.lubricant.density * model.lubricant.specific_heat),
      shell_share_(friction_share(thermal.shell_surface, thermal.journal_surface)),
      system_(model.grid, thermal.layers, has_own_temperatures(thermal.shell)),
      mean_(model.grid, thermal.layers,
            {.ring = has_own_temperatures(thermal.shell),
             .shell_node = std::holds_alternative<NodeWall>(thermal.shell),
             .free_journal = std::holds_alternative<FreeJournal>(thermal.journal),
             .journal_node = std::holds_alternative<NodeWall>(thermal.journal),
             .outside = at_.outside(),
             .body = conduction_of(thermal.shell)}) {
  if (const auto* ring = std::get_if<RingWall>(&thermal_.shell))
    ring_ = conductances(model_, GridGeometry(model_), *ring);
}

Eigen::Index HeatEquations::oil_of(int supply) const {
  const int feature = supply - (has_line() ? 1 : 0);
  if (feature < 0) return at_.place_of_oil(thermal_.oil.line);
  return thermal_.oil.features.empty() ? -1
                                       : at_.place_of_oil(thermal_.oil.features[static_cast<std::size_t>(feature)]);
}

double HeatEquations::at_edges(const Eigen::VectorXd& outside) const {
  const Eigen::Index place = at_.place_of_oil(thermal_.oil.edges);
  return place < 0 ? thermal_.T_edges : outside[place];
}

double HeatEquations::at_ring(const Eigen::VectorXd& outside) const {
  return at_.ambient ? outside[at_.place_of_ambient()] : std::get<RingWall>(thermal_.shell).T_ambient;
}

// Oil of a node's temperature, of its own, or the film's (thermal.39).
double HeatEquations::fresh(int supply, const Eigen::VectorXd& outside) const {
  if (const Eigen::Index place = oil_of(supply); place >= 0) return outside[place];
  const int feature = supply - (has_line() ? 1 : 0);
  if (feature < 0) return thermal_.T_line.value_or(thermal_.T_supply);
  if (thermal_.T_features.empty()) return thermal_.T_supply;
  return thermal_.T_features[static_cast<std::size_t>(feature)];
}

// With the weights of the film's own power (film.53), so that what warms is what rubs.
double HeatEquations::asperity_power(const CarryingFilm& film, int node) const {
  const GridGeometry& geometry = film.balance.geometry();
  const double area = geometry.weight_phi[node / model_.grid.n_z] * geometry.weight_z[node % model_.grid.n_z];
  return area * film.balance.nodes()[node].asperity * film.wrench.friction_power_per_contact();
}

// Shared by the surfaces' effusivities (thermal.53).
double HeatEquations::shell_friction(const CarryingFilm& film, int node) const {
  return shell_share_ * asperity_power(film, node);
}

double HeatEquations::journal_friction(const CarryingFilm& film, int node) const {
  return (1 - shell_share_) * asperity_power(film, node);
}

// By the slope of the temperature at the wall, behind which more may resist. Oil that stands in a supply is no film: it
// heats no wall.
WallFlux HeatEquations::to_wall(const CarryingFilm& film, int node, int layer, double resistance) const {
  const Node& at = film.balance.nodes()[node];
  const double k = model_.lubricant.conductivity * oil_share(at) / at.h;
  const auto [beside, next] = across_.slope_at_wall(static_cast<std::size_t>(layer));
  const double area = film.balance.balance_share(node) * film.balance.area(node);
  const double share = area / (1 + resistance * k * (beside - next));
  return {share * k * beside, share * k * next};
}

double HeatEquations::between(const CarryingFilm& film, int node, int layer) const {
  const Node& at = film.balance.nodes()[node];
  const double k = model_.lubricant.conductivity * oil_share(at);
  return k * film.balance.area(node) / (at.h * across_.to_next(static_cast<std::size_t>(layer)));
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

// With the oil of the end and the rate at which it has changed; pockets of air keep a little.
double HeatEquations::start_volume(const CarryingFilm& film, int node) const {
  const FlowBalance& b = film.balance;
  const double end = b.area(node) * b.nodes()[node].content * b.oil_gap(node);
  return std::max(end - film.dt * b.storage(node), least_fill * b.area(node) * model_.c);
}

HeatState HeatEquations::solve(const CarryingFilm& film, const HeatState& start) {
  const int rows = system_.size();
  system_.set_zero();
  known_.setZero(rows + 1 + supplies());
  by_shell_.setZero(known_.size());
  by_journal_.setZero(rows);
  by_outside_.setZero(known_.size(), at_.outside());
  outside_ = start.outside;
  by_supply_.assign(static_cast<std::size_t>(start.film.size()), 0.0);
  add_storage(film, start);
  add_flows(film);
  add_flow_upwards(film);
  add_edges(film);
  add_conduction(film);
  add_shell(film, start);
  add_journal(film);
  if (holds_walls(film)) add_equations_to_mean(film, start);
  add_supplies(film);
  renew(film);
  add_remainder(film, start);
  if (holds_walls(film)) hold_walls(start);
  prepare_sweeps(film);

  Eigen::VectorXd x(known_.size()), missing, change;
  x.head(start.film.size()) = start.film;
  if (rows > start.film.size()) x.segment(start.film.size(), model_.grid.n_phi) = start.shell;
  x[rows] = start.journal;
  x.tail(supplies()) = start.supplies;
  multiply(x, missing);
  missing = known_ - missing;
  const double steady = conduction_of(thermal_.shell) != nullptr ? body_share : steady_share;
  solve_for(missing, film.dt == 0 ? steady : step_share, change);
  x += change;

  HeatState end = start;
  end.film = x.head(start.film.size());
  if (rows > start.film.size()) end.shell = x.segment(start.film.size(), model_.grid.n_phi);
  end.journal = x[rows];
  end.supplies = x.tail(supplies());
  if (conduction_of(thermal_.shell) != nullptr && !holds_walls(film)) end.wall_heat = heat_into_shell(film, end);
  if (holds_walls(film)) add_heat_to_mean(film, start, end);
  return end;
}

void HeatEquations::solve_for(const Eigen::VectorXd& known, double share, Eigen::VectorXd& x) {
  const auto A = [this](const Eigen::VectorXd& v, Eigen::VectorXd& y) { multiply(v, y); };
  const auto M = [this](const Eigen::VectorXd& b, Eigen::VectorXd& v) { precondition(b, v); };
  const solver::GmresOptions wanted{
      .rtol = share, .max_iterations = most_iterations_, .restart = (most_iterations_ + 1) / 2};
  if (!gmres_.solve(A, M, known, wanted, x).converged) factorise_for(known, x);
}

// Where oil turns round in cells that sweeps cannot follow.
void HeatEquations::factorise_for(const Eigen::VectorXd& known, Eigen::VectorXd& x) const {
  const Eigen::SparseMatrix<double> A = matrix();
  const std::span<const double> values{A.valuePtr(), static_cast<std::size_t>(A.nonZeros())};
  solver::SparseLu lu;
  lu.analyse(A);
  HERSEY_REQUIRE(lu.factorise(values), "every layer of a film has a balance of heat");
  x = known;
  lu.solve({x.data(), static_cast<std::size_t>(x.size())});
}

Eigen::SparseMatrix<double> HeatEquations::matrix() const {
  const int rows = system_.size(), n_phi = model_.grid.n_phi;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](int row, const HeatSystem::Row& of) {
    for (const auto& [column, entry] : of) entries.emplace_back(row, column, entry);
  };
  for (int node = 0; node < model_.grid.size(); ++node) {
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      add(row, system_.entries(node, l));
      if (by_journal_[row] != 0) entries.emplace_back(row, rows, -by_journal_[row]);
      if (supply_of_[node] >= 0) entries.emplace_back(row, rows + 1 + supply_of_[node], -by_supply_[row]);
    }
  }
  for (int i = 0; rows > system_.row(model_.grid.size(), 0) && i < n_phi; ++i)
    add(system_.ring_row(i), system_.ring_entries(i));
  entries.emplace_back(rows, rows, journal_self_);
  for (int node = 0; journal_is_free_ && node < model_.grid.size(); ++node)
    for (const auto& [row, entry] : journal_entries(node)) entries.emplace_back(rows, row, entry);
  for (int s = 0; s < supplies(); ++s) entries.emplace_back(rows + 1 + s, rows + 1 + s, supply_self_[s]);
  for (const Held& held : held_) {
    for (const Held::Row& row : held.rows) {
      add(rows + 1 + held.supply, row.entries);
      entries.emplace_back(rows + 1 + held.supply, rows, -row.by_journal);
    }
  }
  for (const Renewal& renewal : renewals_) entries.emplace_back(rows + 1 + renewal.supply, renewal.row, renewal.heat);
  Eigen::SparseMatrix<double> A(known_.size(), known_.size());
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// Linear in what is known: the system stays, and no heat is made (thermal.45).
HeatState HeatEquations::response(const Eigen::VectorXd& known) {
  const int rows = system_.size(), film = model_.grid.size() * layers();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(known.size());
  if (!known.isZero(0)) solve_for(known, response_share, x);
  HeatState change;
  change.film = x.head(film);
  if (conducts(thermal_.shell)) change.shell.setZero(model_.grid.n_phi);
  if (rows > film) change.shell = x.segment(film, model_.grid.n_phi);
  change.journal = x[rows];
  change.supplies = x.tail(supplies());
  change.outside.setZero(at_.outside());
  return change;
}

HeatState HeatEquations::response_to_outside(Eigen::Index place) {
  HeatState change = response(by_outside_.col(place));
  change.outside[place] = 1;
  return change;
}

// Oil that leaves over the edges, into a supply that takes it away, or to be replaced by what a supply gives.
std::vector<std::pair<int, double>> HeatEquations::drained(const CarryingFilm& film) const {
  std::vector<std::pair<int, double>> oil;
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double out = film.balance.outflow(node);
    for (int l = 0; l < layers() && out > 0; ++l)
      oil.emplace_back(system_.row(node, l), rc_ * out * film.flows.leaving_share(node, l));
  }
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(supplies());
  for (const Held& held : held_) flow[held.supply] += held.flow;
  for (int s = 0; s < supplies(); ++s)
    if (flow[s] < 0) oil.emplace_back(system_.size() + 1 + s, -rc_ * flow[s]);
  for (const Renewal& renewal : renewals_) oil.emplace_back(renewal.row, renewal.heat);
  return oil;
}

// A node that oil comes from gives it at its own temperature and grows no colder; what comes back warms it
// (thermal.54).
Eigen::VectorXd HeatEquations::into_outside(const CarryingFilm& film, const HeatState& state) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(at_.outside());
  for (int i = 0; at_.ambient && i < model_.grid.n_phi; ++i)
    heat[at_.place_of_ambient()] += ring_.outside[i] * (state.shell[i] - state.outside[at_.place_of_ambient()]);
  if (!at_.drain) return heat;
  const double T = state.outside[at_.place_of_drain()];
  for (const auto& [row, rate] : drained(film)) {
    const int supply = row - system_.size() - 1;
    heat[at_.place_of_drain()] += rate * ((supply >= 0 ? state.supplies[supply] : state.film[row]) - T);
  }
  return heat;
}

HeatState HeatEquations::response_to_shell() {
  HeatState change = response(by_shell_);
  change.shell.setOnes(model_.grid.n_phi);
  return change;
}

HeatState HeatEquations::response_to_journal() {
  const int journal = system_.size();
  return response(journal_self_ * Eigen::VectorXd::Unit(known_.size(), journal));
}

void HeatEquations::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  const int rows = system_.size();
  y.resize(known_.size());
  system_.multiply(x, y);
  y.head(rows) -= by_journal_ * x[rows];
  for (int node = 0; node < model_.grid.size(); ++node) {
    if (supply_of_[node] < 0) continue;
    for (int row = node * layers(); row < (node + 1) * layers(); ++row)
      y[row] -= by_supply_[row] * x[rows + 1 + supply_of_[node]];
  }
  multiply_remainder(x, y);
}

// Of the row of a free journal, by the layers beside it.
std::array<std::pair<int, double>, 2> HeatEquations::journal_entries(int node) const {
  const WallFlux& flux = into_journal_[node];
  return {{{system_.row(node, top()), -flux.beside}, {system_.row(node, next_to_top()), flux.next}}};
}

void HeatEquations::multiply_remainder(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  const int rows = system_.size();
  y[rows] = journal_self_ * x[rows];
  for (int node = 0; journal_is_free_ && node < model_.grid.size(); ++node)
    for (const auto& [row, entry] : journal_entries(node)) y[rows] += entry * x[row];
  for (int s = 0; s < supplies(); ++s) y[rows + 1 + s] = supply_self_[s] * x[rows + 1 + s];
  for (const Held& held : held_) {
    double& sum = y[rows + 1 + held.supply];
    for (const Held::Row& row : held.rows) {
      for (const auto& [column, entry] : row.entries) sum += entry * x[column];
      sum -= row.by_journal * x[rows];
    }
  }
  for (const Renewal& renewal : renewals_) y[rows + 1 + renewal.supply] += renewal.heat * x[renewal.row];
}

void HeatEquations::precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  const int rows = system_.size(), ends = 1 + supplies();
  x.resize(b.size());
  system_.sweep(b, x);
  x.tail(ends).setZero();
  Eigen::VectorXd missing(b.size());
  multiply_remainder(x, missing);
  x.tail(ends) = remainder_.solve(b.tail(ends) - missing.tail(ends));
  x.head(rows).noalias() += by_remainder_ * x.tail(ends);
}

// The sweep begins at a supply, where temperatures are known best.
void HeatEquations::prepare_sweeps(const CarryingFilm& film) {
  int first = 0;
  for (const Held& held : held_)
    if (held.chi > 0.5) first = held.node / model_.grid.n_z;
  system_.prepare(first, film.balance.speed_phi() >= 0);
  const int rows = system_.size(), ends = 1 + supplies();
  by_remainder_.setZero(rows, ends);
  Eigen::VectorXd known = Eigen::VectorXd::Zero(rows), answer(rows + ends), sums(rows + ends);
  Eigen::MatrixXd remainder(ends, ends);
  for (int k = 0; k < ends; ++k) {
    if (k == 0) known = by_journal_;
    for (int row = 0; k > 0 && row < model_.grid.size() * layers(); ++row)
      known[row] = supply_of_[row / layers()] == k - 1 ? by_supply_[row] : 0;
    answer.setZero();
    if (!known.isZero(0)) system_.sweep(known, answer);
    by_remainder_.col(k) = answer.head(rows);
    answer[rows + k] = 1;
    multiply_remainder(answer, sums);
    remainder.col(k) = sums.tail(ends);
  }
  remainder_.compute(remainder);
}

// (thermal.10): without flow a steady film would have no temperature, so that a thread of storage is left to it.
void HeatEquations::add_storage(const CarryingFilm& film, const HeatState& start) {
  storage_.resize(start.film.size());
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double thread = least_fill * film.balance.largest_throughput();
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double rate = film.dt > 0 ? start_volume(film, node) / film.dt : thread * 1e-6;
      storage_[row] = rc_ * rate * width(l);
      system_.diagonal(row) += storage_[row];
      known_[row] += storage_[row] * start.film[row] + film.flows.dissipation(node, l);
    }
  }
}

void HeatEquations::add_flows(const CarryingFilm& film) {
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

// On which side of a node the other lies.
HeatSystem::Side HeatEquations::side_of(int from, int to) const {
  const int n_z = model_.grid.n_z, n_phi = model_.grid.n_phi;
  if (to / n_z == from / n_z) return to > from ? HeatSystem::left : HeatSystem::right;
  return to / n_z == (from / n_z + 1) % n_phi ? HeatSystem::before : HeatSystem::after;
}

// Oil comes with the temperature of where it has been (thermal.10).
void HeatEquations::add_flow(int from, int to, int layer, double q) {
  system_.diagonal(system_.row(to, layer)) += rc_ * q;
  system_.beside(to, layer, side_of(from, to)) -= rc_ * q;
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
  const double heat = rc_ * std::abs(q) * 0.5 * face.length / length;
  const HeatSystem::Side side = side_of(from, to);
  system_.diagonal(system_.row(from, layer)) += heat;
  system_.beside(from, layer, side) -= heat;
  system_.beside(to, layer, side) -= heat;
  system_.beyond(to, layer, side) += heat;
}

// With the mean temperature of both layers, second order, where conduction between them is not next to nothing beside
// what flows; beyond, towards that upstream (thermal.51).
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

void HeatEquations::add_edges(const CarryingFilm& film) {
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double in = -film.balance.outflow(node);
    if (in <= 0) continue;
    inflow_[static_cast<std::size_t>(node)] += in;
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      system_.diagonal(row) += rc_ * in * width(l);
      known_[row] += rc_ * in * width(l) * at_edges(outside_);
      if (const Eigen::Index place = at_.place_of_oil(thermal_.oil.edges); place >= 0)
        by_outside_(row, place) += rc_ * in * width(l);
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

// A wall without heat leaves its share of what asperities dissipate to the oil (thermal.53).
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

// A steady body answers all of the heat at once (thermal.36); over a step it keeps its temperatures. Where these are
// held for a cycle the rows are first balances of heat, of which the mean is taken.
void HeatEquations::add_body(const WallConduction& body, const CarryingFilm& film, const HeatState& start) {
  const int n = model_.grid.n_phi, first = system_.ring_row(0);
  if (film.dt > 0) {
    system_.set_answer(nullptr, 1);
    if (holds_walls(film)) return;
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

Eigen::VectorXd HeatEquations::heat_into_shell(const CarryingFilm& film, const HeatState& state) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(model_.grid.n_phi);
  for (int node = 0; node < model_.grid.size(); ++node)
    heat[node / model_.grid.n_z] += into_shell(film, state, node) + shell_friction(film, node);
  return heat;
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
    if (at_.ambient) by_outside_(row, at_.place_of_ambient()) += ring_.outside[i];
    if (film.dt == 0 || holds_walls(film)) continue;
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

// Oil comes out of a supply with the temperature there; of what passes a node, the supply's share takes it on
// (thermal.14).
void HeatEquations::add_supplies(const CarryingFilm& film) {
  held_.clear();
  supply_of_.assign(static_cast<std::size_t>(model_.grid.size()), -1);
  for (int node = 0; node < model_.grid.size(); ++node) {
    if (!film.balance.is_held(node)) continue;
    Held held{.node = node,
              .supply = film.balance.feature_at(node) + (has_line() ? 1 : 0),
              .chi = 1 - film.balance.balance_share(node),
              .flow = film.balance.supply(node)};
    supply_of_[node] = held.supply;
    const double passing = std::max(inflow_[static_cast<std::size_t>(node)] + std::max(held.flow, 0.0),
                                    least_fill * film.balance.largest_throughput());
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double share = held.flow > 0 ? width(l) : film.flows.leaving_share(node, l);
      held.rows.push_back(
          {system_.entries(node, l), known_[row], by_shell_[row], by_journal_[row], by_outside_.row(row)});
      held.rows.back().entries.front().second += rc_ * held.flow * share;
      const double in = rc_ * std::max(held.flow, 0.0) * share, taken_on = held.chi * rc_ * passing * width(l);
      system_.diagonal(row) += in;
      system_.scale(row, 1 - held.chi);
      known_[row] *= 1 - held.chi, by_shell_[row] *= 1 - held.chi, by_journal_[row] *= 1 - held.chi;
      by_outside_.row(row) *= 1 - held.chi;
      system_.diagonal(row) += taken_on;
      by_supply_[row] = (1 - held.chi) * in + taken_on;
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
      renewals_.push_back({held->supply, system_.row(from, l), (1 - thermal_.carry_over) * taken * rc_ * std::abs(q)});
    }
  }
}

double HeatEquations::renewed(const HeatState& state, int supply) const {
  double heat = 0;
  for (const Renewal& renewal : renewals_)
    if (renewal.supply == supply) heat += renewal.heat * (state.film[renewal.row] - fresh(supply, state.outside));
  return heat;
}

// The journal's balance (thermal.13) and those of the supplies (thermal.15).
void HeatEquations::add_remainder(const CarryingFilm& film, const HeatState& start) {
  const int journal = system_.size();
  const auto* free = std::get_if<FreeJournal>(&thermal_.journal);
  journal_is_free_ = free != nullptr;
  journal_self_ = 0;
  into_journal_.assign(static_cast<std::size_t>(model_.grid.size()), {});
  if (journal_is_free_) {
    for (int node = 0; node < model_.grid.size(); ++node) {
      into_journal_[node] = to_journal(film, node);
      journal_self_ += into_journal_[node].wall();
      known_[journal] += journal_friction(film, node);
    }
    if (film.dt > 0 && !holds_walls(film)) {
      journal_self_ += free->heat_capacity / film.dt;
      known_[journal] += free->heat_capacity / film.dt * start.journal;
    }
  }
  if (journal_self_ == 0) hold_journal(start);
  const double thread = rc_ * 1e-9 * film.balance.largest_throughput();
  std::vector<double> flow(static_cast<std::size_t>(supplies()), 0.0);
  for (const Held& held : held_) {
    flow[held.supply] += held.flow;
    for (const Held::Row& row : held.rows) {
      known_[journal + 1 + held.supply] += row.known;
      by_shell_[journal + 1 + held.supply] += row.by_shell;
      by_outside_.row(journal + 1 + held.supply) += row.by_outside;
    }
  }
  const auto give = [&](int supply, double heat) {  // oil at the temperature of fresh oil
    known_[journal + 1 + supply] += heat * fresh(supply, outside_);
    if (const Eigen::Index place = oil_of(supply); place >= 0) by_outside_(journal + 1 + supply, place) += heat;
  };
  for (const Renewal& renewal : renewals_) give(renewal.supply, renewal.heat);
  supply_self_.assign(flow.size(), 0.0);
  for (int s = 0; s < supplies(); ++s) {
    supply_self_[s] = rc_ * std::max(-flow[s], 0.0) + thread;
    give(s, rc_ * std::max(flow[s], 0.0) + thread);
  }
}

// Each term by its own integral; temperatures count from that of the supply, so that a missing drop of oil brings no
// heat (thermal.17).
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
      sum.to_oil +=
          rc_ * (out > 0 ? out * film.flows.leaving_share(node, l) * T : out * width(l) * (at_edges(end.outside) - T0));
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
  for (const Held& held : held_) flow[held.supply] += held.flow;
  for (int k = 0; k < supplies(); ++k)
    sum.to_oil += renewed(end, k) - rc_ * flow[k] * ((flow[k] > 0 ? fresh(k, end.outside) : end.supplies[k]) - T0);
  return sum;
}

}  // namespace hersey::film
