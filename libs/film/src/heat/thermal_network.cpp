#include "hersey/film/thermal_network.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

using Eigen::Index;

/// Marks the nodes that paths lead to from those marked, and those that oil flows to from there.
std::vector<bool> reached(const ThermalNetworkModel& model, std::vector<bool> from,
                          const std::vector<OilStream>& streams = {}) {
  for (bool spreads = true; spreads;) {
    spreads = false;
    for (const ThermalPath& path : model.paths) {
      if (path.conductance == 0 || from[path.a] == from[path.b]) continue;
      from[path.a] = from[path.b] = spreads = true;
    }
    for (const OilStream& stream : streams) {
      const bool comes = (stream.kept > 0 && from[stream.from]) || (stream.cooled > 0 && from[stream.coolant]);
      if (comes && !from[stream.to]) from[stream.to] = spreads = true;
    }
  }
  return from;
}

}  // namespace

double NetworkObservables::error() const {
  const double in = heat.sum() + by_oil.sum();
  const double largest = std::max({exchanged, std::abs(to_fixed), std::abs(stored)});
  return largest > 0 ? (in - to_fixed - stored) / largest : 0;
}

bool reaches_surroundings(const ThermalNetworkModel& model, std::size_t node) {
  std::vector<bool> from(model.nodes.size(), false);
  from[node] = true;
  const std::vector<bool> all = reached(model, from);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] && model.nodes[i].is_fixed) return true;
  return false;
}

ThermalNetwork::ThermalNetwork(ThermalNetworkModel model) : model_(std::move(model)) {
  const std::size_t n = model_.nodes.size();
  for (const ThermalPath& path : model_.paths)
    HERSEY_REQUIRE(path.a < n && path.b < n && path.conductance >= 0, "a path conducts heat between two nodes");
  for (const ThermalNode& node : model_.nodes)
    HERSEY_REQUIRE(node.is_fixed || node.is_oil || node.heat_capacity > 0, "a body holds heat");
  observables_.T.resize(static_cast<Index>(n));
  observables_.heat.setZero(static_cast<Index>(n)), observables_.by_oil.setZero(static_cast<Index>(n));
  for (std::size_t i = 0; i < n; ++i) observables_.T[static_cast<Index>(i)] = model_.nodes[i].T;
}

// Solves (thermal.45) by (thermal.47), or (thermal.48): conductances, films and capacities are those at the end of the
// step, so that none of them limits it. The unknown is the change, which short steps of large bodies would lose in the
// digits of the temperature. Streams of oil (circuit.14) are rows of the same equations.
void ThermalNetwork::advance(double dt, const std::vector<FilmAtNodes>& films, const std::vector<OilStream>& streams) {
  const std::size_t n = model_.nodes.size();
  const Eigen::VectorXd& start = observables_.T;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Index>(n), static_cast<Index>(n));
  Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Index>(n));
  std::vector<bool> holds(n, false);  // true if an equation determines the temperature
  for (std::size_t k = 0; k < n; ++k) holds[k] = dt > 0 && model_.nodes[k].heat_capacity > 0;
  for (const ThermalPath& path : model_.paths) {
    const auto i = static_cast<Index>(path.a), j = static_cast<Index>(path.b);
    const double q = path.conductance * (start[i] - start[j]);
    b[i] -= q, b[j] += q;
    A(i, i) += path.conductance, A(j, j) += path.conductance;
    A(i, j) -= path.conductance, A(j, i) -= path.conductance;
  }
  for (const FilmAtNodes& film : films) {
    const WallHeatFlow& observed = film.heat_flow;
    const Eigen::VectorXd heat = observed.heat + observed.by_T * (walls(film.at, observed.T) - observed.T);
    for (const auto& [row, i] : film.at.nodes()) {
      b[i] += heat[row];
      if (observed.by_T(row, row) != 0) holds[static_cast<std::size_t>(i)] = true;
      for (const auto& [column, j] : film.at.nodes()) A(i, j) -= observed.by_T(row, column);
    }
  }
  for (const OilStream& stream : streams) {
    const auto from = static_cast<Index>(stream.from), to = static_cast<Index>(stream.to);
    b[to] += stream.kept * (start[from] - start[to]) + stream.heat;
    A(to, to) += stream.kept, A(to, from) -= stream.kept;
    if (stream.cooled == 0) continue;
    const auto coolant = static_cast<Index>(stream.coolant);
    b[to] += stream.cooled * (start[coolant] - start[to]);
    A(to, to) += stream.cooled, A(to, coolant) -= stream.cooled;
    b[coolant] += stream.cooled * (start[from] - start[coolant]);
    A(coolant, coolant) += stream.cooled, A(coolant, from) -= stream.cooled;
  }
  for (std::size_t k = 0; k < n; ++k)
    if (model_.nodes[k].is_fixed) holds[k] = true;
  holds = reached(model_, holds, streams);
  for (std::size_t k = 0; k < n; ++k) {
    const auto i = static_cast<Index>(k);
    if (model_.nodes[k].is_fixed || !holds[k]) {
      A.row(i).setZero();
      A(i, i) = 1, b[i] = 0;
    } else if (dt > 0) {
      A(i, i) += model_.nodes[k].heat_capacity / dt;
    }
  }
  const Eigen::VectorXd change = A.partialPivLu().solve(b);
  observables_.T += change;
  observe(dt, change, films, streams);
}

void ThermalNetwork::observe(double dt, const Eigen::VectorXd& change, const std::vector<FilmAtNodes>& films,
                             const std::vector<OilStream>& streams) {
  observables_.heat.setZero(), observables_.by_oil.setZero();
  observables_.exchanged = observables_.to_fixed = observables_.stored = 0;
  for (const FilmAtNodes& film : films) {
    const WallHeatFlow& observed = film.heat_flow;
    const Eigen::VectorXd heat = observed.heat + observed.by_T * (walls(film.at, observed.T) - observed.T);
    for (const auto& [row, i] : film.at.nodes())
      observables_.heat[i] += heat[row], observables_.exchanged += std::abs(heat[row]);
  }
  const Eigen::VectorXd& T = observables_.T;
  const auto give = [this](std::size_t node, double heat) {
    observables_.by_oil[static_cast<Index>(node)] += heat, observables_.exchanged += std::abs(heat);
  };
  for (const OilStream& stream : streams) {
    const double at = T[static_cast<Index>(stream.from)], to = T[static_cast<Index>(stream.to)];
    give(stream.to, stream.kept * (at - to) + stream.heat);
    if (stream.cooled == 0) continue;
    const double coolant = T[static_cast<Index>(stream.coolant)];
    give(stream.to, stream.cooled * (coolant - to));
    give(stream.coolant, stream.cooled * (at - coolant));
  }
  for (std::size_t k = 0; k < model_.nodes.size(); ++k) {
    const auto i = static_cast<Index>(k);
    if (model_.nodes[k].is_fixed) {
      observables_.to_fixed += observables_.heat[i] + observables_.by_oil[i];
    } else if (dt > 0) {
      observables_.stored += model_.nodes[k].heat_capacity / dt * change[i];
    }
  }
  for (const ThermalPath& path : model_.paths) {
    const double q =
        path.conductance * (observables_.T[static_cast<Index>(path.a)] - observables_.T[static_cast<Index>(path.b)]);
    if (model_.nodes[path.b].is_fixed) observables_.to_fixed += q;
    if (model_.nodes[path.a].is_fixed) observables_.to_fixed -= q;
  }
}

Eigen::VectorXd ThermalNetwork::walls(const FilmTerminals& at, const Eigen::VectorXd& otherwise) const {
  Eigen::VectorXd T = otherwise;
  for (const auto& [row, i] : at.nodes()) T[row] = observables_.T[i];
  return T;
}

void ThermalNetwork::persist(Archive& archive) {
  archive.io("T", observables_.T), archive.io("heat", observables_.heat);
  const bool has_oil = std::ranges::any_of(model_.nodes, [](const ThermalNode& node) { return node.is_oil; });
  if (has_oil) archive.io("by_oil", observables_.by_oil);
  archive.io("exchanged", observables_.exchanged);
  archive.io("to_fixed", observables_.to_fixed), archive.io("stored", observables_.stored);
}

}  // namespace hersey::film
