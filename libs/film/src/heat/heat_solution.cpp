#include <span>

#include "heat/heat_equations.h"
#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

// Linear system of all temperatures: products, sweeps as a preconditioner, GMRES, and a factorisation where GMRES does
// not converge.
namespace hersey::film {
namespace {

// Tolerances of the equations over the initial residual: of a steady film, which is iterated with its temperature, and
// of a step. With 1e-4 up to twice as many iterations are needed: their acceleration takes the remaining residual for a
// response of the film.
constexpr double steady_rtol = 1e-5, step_rtol = 1e-9;
// The rows of a body that responds to heat as a whole are small, and so are their residuals.
constexpr double body_rtol = 1e-7;
// Tolerance of the responses to temperatures of walls, which are multiplied by the change of these in a step.
constexpr double response_rtol = 1e-7;

}  // namespace

HeatState HeatEquations::solve(const CarryingFilm& film, const HeatState& start) {
  const int rows = system_.size();
  assemble(film, start);
  prepare_sweeps(film);

  Eigen::VectorXd x(known_.size()), missing, change;
  x.head(start.film.size()) = start.film;
  if (rows > start.film.size()) x.segment(start.film.size(), model_.grid.n_phi) = start.shell;
  x[rows] = start.journal;
  x.tail(supplies()) = start.supplies;
  multiply(x, missing);
  missing = known_ - missing;
  const double steady =
      conduction_of(thermal_.shell) != nullptr || conduction_of(thermal_.journal) != nullptr ? body_rtol : steady_rtol;
  solve_for(missing, film.dt == 0 ? steady : step_rtol, change);
  x += change;

  HeatState end = start;
  end.film = x.head(start.film.size());
  if (rows > start.film.size()) end.shell = x.segment(start.film.size(), model_.grid.n_phi);
  end.journal = x[rows];
  end.supplies = x.tail(supplies());
  if (conduction_of(thermal_.shell) != nullptr && !has_fixed_walls(film)) end.wall_heat = heat_into_shell(film, end);
  if (conduction_of(thermal_.journal) != nullptr && !has_fixed_walls(film))
    end.journal_heat = heat_into_journal(film, end);
  if (has_fixed_walls(film)) add_heat_to_mean(film, start, end);
  return end;
}

void HeatEquations::solve_for(const Eigen::VectorXd& known, double rtol, Eigen::VectorXd& x) {
  const auto A = [this](const Eigen::VectorXd& v, Eigen::VectorXd& y) { multiply(v, y); };
  const auto M = [this](const Eigen::VectorXd& b, Eigen::VectorXd& v) { precondition(b, v); };
  const solver::GmresOptions wanted{
      .rtol = rtol, .max_iterations = most_iterations_, .restart = (most_iterations_ + 1) / 2};
  if (!gmres_.solve(A, M, known, wanted, x).solved()) factorise_for(known, x);
}

// Factorises where oil recirculates in cells that sweeps cannot follow.
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
  for (int node = 0; journal_moves_ && node < model_.grid.size(); ++node)
    for (const auto& [row, entry] : journal_entries(node)) entries.emplace_back(rows, row, entry);
  for (int s = 0; s < supplies(); ++s) entries.emplace_back(rows + 1 + s, rows + 1 + s, supply_self_[s]);
  for (const SuppliedNode& supplied : supplied_nodes_) {
    for (const SuppliedNode::Row& row : supplied.rows) {
      add(rows + 1 + supplied.supply, row.entries);
      entries.emplace_back(rows + 1 + supplied.supply, rows, -row.by_journal);
    }
  }
  for (const Renewal& renewal : renewals_) {
    const int row = rows + 1 + renewal.supply;
    entries.emplace_back(row, renewal.row, renewal.heat);
    entries.emplace_back(row, row, -renewal.heat * renewal.mixed_fraction);
  }
  Eigen::SparseMatrix<double> A(known_.size(), known_.size());
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

// The response is linear in the known terms: the system stays, and no heat is generated (thermal.46).
HeatState HeatEquations::response(const Eigen::VectorXd& known) {
  const int rows = system_.size(), film = model_.grid.size() * layers();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(known.size());
  if (!known.isZero(0)) solve_for(known, response_rtol, x);
  HeatState change;
  change.film = x.head(film);
  if (conducts(thermal_.shell)) change.shell.setZero(model_.grid.n_phi);
  if (rows > film) change.shell = x.segment(film, model_.grid.n_phi);
  change.journal = x[rows];
  change.supplies = x.tail(supplies());
  change.outside.setZero(at_.outside());
  return change;
}

HeatState HeatEquations::response_to_outside(Eigen::Index terminal) {
  HeatState change = response(by_outside_.col(terminal));
  change.outside[terminal] = 1;
  return change;
}

Eigen::Index HeatEquations::taker_of(int supply) const {
  const int feature = supply - (has_line() ? 1 : 0);
  if (feature < 0 || thermal_.oil.features.empty()) return at_.index_of_drain();
  const auto& node = thermal_.oil.features[static_cast<std::size_t>(feature)];
  return node && node->takes_back ? oil_of(supply) : at_.index_of_drain();
}

// Oil leaves over the edges, into a supply that removes it, or to be replaced by a supply.
std::vector<HeatEquations::Drained> HeatEquations::drained(const CarryingFilm& film, const HeatState& state) const {
  std::vector<Drained> oil;
  const Eigen::Index drain = at_.index_of_drain();
  for (int node = 0; node < model_.grid.size() && drain >= 0; ++node) {
    const double out = film.balance.outflow(node);
    const double lost = out > 0 ? rc_ * out * lost_fraction(film, state, node) : 0;
    for (int l = 0; l < layers() && lost > 0; ++l)
      oil.push_back({drain, system_.row(node, l), lost * film.flows.leaving_fraction(node, l)});
  }
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(supplies());
  for (const SuppliedNode& supplied : supplied_nodes_) flow[supplied.supply] += supplied.flow;
  for (int s = 0; s < supplies(); ++s)
    if (flow[s] < 0 && taker_of(s) >= 0) oil.push_back({taker_of(s), system_.size() + 1 + s, -rc_ * flow[s]});
  for (const Renewal& renewal : renewals_) {
    const Eigen::Index into = taker_of(renewal.supply);
    if (into < 0) continue;
    oil.push_back({into, renewal.row, renewal.heat});
    oil.push_back({into, system_.size() + 1 + renewal.supply, -renewal.heat * renewal.mixed_fraction});
  }
  return oil;
}

// A node from which oil comes gives it at its own temperature and grows no colder; oil that comes back warms it
// (thermal.55).
Eigen::VectorXd HeatEquations::into_outside(const CarryingFilm& film, const HeatState& state) const {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(at_.outside());
  for (int i = 0; at_.ambient && i < model_.grid.n_phi; ++i)
    heat[at_.index_of_ambient()] += ring_.outside[i] * (state.shell[i] - state.outside[at_.index_of_ambient()]);
  for (const Drained& oil : drained(film, state)) {
    const int supply = oil.row - system_.size() - 1;
    const double T = supply >= 0 ? state.supplies[supply] : state.film[oil.row];
    heat[oil.into] += oil.rate * (T - state.outside[oil.into]);
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

// Contribution of the layers beside it to the row of a journal with a temperature of its own.
std::array<std::pair<int, double>, 2> HeatEquations::journal_entries(int node) const {
  const WallFlux& flux = into_journal_[node];
  return {{{system_.row(node, top()), -flux.beside}, {system_.row(node, next_to_top()), flux.next}}};
}

void HeatEquations::multiply_remainder(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  const int rows = system_.size();
  y[rows] = journal_self_ * x[rows];
  for (int node = 0; journal_moves_ && node < model_.grid.size(); ++node)
    for (const auto& [row, entry] : journal_entries(node)) y[rows] += entry * x[row];
  for (int s = 0; s < supplies(); ++s) y[rows + 1 + s] = supply_self_[s] * x[rows + 1 + s];
  for (const SuppliedNode& supplied : supplied_nodes_) {
    double& sum = y[rows + 1 + supplied.supply];
    for (const SuppliedNode::Row& row : supplied.rows) {
      for (const auto& [column, entry] : row.entries) sum += entry * x[column];
      sum -= row.by_journal * x[rows];
    }
  }
  for (const Renewal& renewal : renewals_) {
    const int row = rows + 1 + renewal.supply;
    y[row] += renewal.heat * (x[renewal.row] - renewal.mixed_fraction * x[row]);
  }
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
  for (const SuppliedNode& supplied : supplied_nodes_)
    if (supplied.chi > 0.5) first = supplied.node / model_.grid.n_z;
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

}  // namespace hersey::film
