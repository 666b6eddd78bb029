#include <algorithm>
#include <variant>
#include <vector>

#include "heat/heat_equations.h"

// Part of the equations of heat that concerns walls that keep their temperature over a cycle.
namespace hersey::film {
namespace {

// Fraction of their storage that rows without any flow keep in the mean of a cycle.
constexpr double least_storage = 1e-6;

}  // namespace

bool HeatEquations::has_fixed_walls(const CarryingFilm& film) const {
  return film.dt > 0 && thermal_.walls == WallMotion::fixed;
}

// The walls' rows become those of prescribed temperatures.
void HeatEquations::fix_walls(const HeatState& start) {
  if (has_own_temperatures(thermal_.shell)) {
    system_.fix_ring();
    known_.segment(system_.ring_row(0), model_.grid.n_phi) = start.shell;
    by_outside_.middleRows(system_.ring_row(0), model_.grid.n_phi).setZero();
  }
  fix_journal(start.journal);
}

// Fractions of fresh oil in the oil that each supply feeds, line first, then features; the rest is oil that the supply
// has taken from the film.
std::vector<double> HeatEquations::fresh_fractions(const CarryingFilm& film) const {
  std::vector<double> given(static_cast<std::size_t>(supplies()), 0.0), net = given;
  for (int node = 0; node < model_.grid.size(); ++node) {
    if (!film.balance.is_supplied(node)) continue;
    const auto supply = static_cast<std::size_t>(film.balance.supplied_by(node) + (has_line() ? 1 : 0));
    given[supply] += std::max(film.balance.supply(node), 0.0), net[supply] += film.balance.supply(node);
  }
  for (std::size_t s = 0; s < given.size(); ++s) net[s] = given[s] > 0 ? std::max(net[s], 0.0) / given[s] : 0;
  return net;
}

// Mean coupling of the film with the nodes that are no walls: fresh oil comes at a node's temperature, and oil that
// leaves the film does so at its own.
OutsideOfMean HeatEquations::outside_of_mean(const CarryingFilm& film, const HeatState& start,
                                             const std::vector<double>& fresh) const {
  const Eigen::Index n = at_.outside(), rows = system_.size();
  OutsideOfMean mean{Eigen::MatrixXd::Zero(rows, n), Eigen::MatrixXd::Zero(n, rows), Eigen::VectorXd::Zero(n)};
  const auto take = [&mean](Eigen::Index terminal, int row, double rate) {
    mean.from(terminal, row) += rate, mean.self[terminal] -= rate;
  };
  for (int i = 0; at_.ambient && i < model_.grid.n_phi; ++i) {
    mean.by(system_.ring_row(i), at_.index_of_ambient()) += ring_.outside[i];
    take(at_.index_of_ambient(), system_.ring_row(i), ring_.outside[i]);
  }
  const Eigen::Index drain = at_.index_of_drain(), edges = at_.index_of_oil(thermal_.oil.edges);
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double out = film.balance.outflow(node), given = film.balance.supply(node);
    const bool is_supplied = film.balance.is_supplied(node);
    const int supply = is_supplied ? film.balance.supplied_by(node) + (has_line() ? 1 : 0) : -1;
    const double fraction = is_supplied ? fresh[static_cast<std::size_t>(supply)] * std::max(given, 0.0) : 0;
    const double replaced = is_supplied ? (1 - thermal_.carry_over) * film.balance.supplied_fraction(node) : 0;
    const double drawn = out < 0 ? -out * fresh_fraction(film, start, node) : 0;
    const double lost = out > 0 ? out * lost_fraction(film, start, node) : 0;
    const Eigen::Index taker = is_supplied ? taker_of(supply) : -1;
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      if (edges >= 0) mean.by(row, edges) += rc_ * drawn * width(l);
      if (const Eigen::Index oil = is_supplied ? oil_of(supply) : -1; oil >= 0)
        mean.by(row, oil) += rc_ * (fraction * width(l) + replaced * inflow_[row]);
      if (drain >= 0 && lost > 0) take(drain, row, rc_ * lost * film.flows.leaving_fraction(node, l));
      if (taker < 0) continue;
      if (given < 0) take(taker, row, -rc_ * given * film.flows.leaving_fraction(node, l));
      take(taker, row, rc_ * replaced * inflow_[row]);
    }
  }
  return mean;
}

// The mean is taken as if nothing were mixed: a supply may rotate with the journal, and the mean of its mixing has no
// meaning. Storage is left out, fresh oil comes at its temperature, and where oil is warmer less heat is generated: at
// a given speed in proportion to its viscosity.
void HeatEquations::add_equations_to_mean(const CarryingFilm& film, const HeatState& start) {
  const std::vector<double> fresh = fresh_fractions(film);
  Eigen::VectorXd added = -(1 - least_storage) * storage_;
  std::vector<WallFlux> into_shell(static_cast<std::size_t>(model_.grid.size())), into_journal = into_shell;
  for (int node = 0; node < model_.grid.size(); ++node) {
    into_shell[static_cast<std::size_t>(node)] = to_shell(film, node);
    into_journal[static_cast<std::size_t>(node)] = to_journal(film, node);
    double fresh_oil = 0, replaced = 0;
    if (film.balance.is_supplied(node)) {
      const auto supply = static_cast<std::size_t>(film.balance.supplied_by(node) + (has_line() ? 1 : 0));
      fresh_oil = fresh[supply] * std::max(film.balance.supply(node), 0.0);
      replaced = (1 - thermal_.carry_over) * film.balance.supplied_fraction(node);
    }
    for (int l = 0; l < layers(); ++l) {
      const int row = system_.row(node, l);
      const double T = start.film[row];
      const double thinning =
          -std::visit([T](const auto& law) { return law.log_viscosity(T).slope; }, model_.lubricant.temperature_law);
      added[row] += film.flows.dissipation(node, l) * thinning + rc_ * (fresh_oil * width(l) + replaced * inflow_[row]);
    }
  }
  mean_.add_equations(film.dt, {.system = system_,
                                .added = added,
                                .by_journal = by_journal_,
                                .by_shell = by_shell_.head(system_.size()),
                                .to_shell = into_shell,
                                .to_journal = into_journal,
                                .capacity = film.dt * storage_,
                                .outside = at_.outside() > 0 ? outside_of_mean(film, start, fresh) : OutsideOfMean{}});
}

void HeatEquations::fix_journal(double T) {
  journal_self_ = 1, journal_moves_ = false;
  known_[system_.size()] = T;
}

// Adds the heat that walls would have to give off to keep their temperatures (thermal.18).
void HeatEquations::add_heat_to_mean(const CarryingFilm& film, const HeatState& start, const HeatState& end) {
  const int rows = system_.size(), n = model_.grid.n_phi;
  Eigen::VectorXd into = Eigen::VectorXd::Zero(rows + 1);
  double shell = 0, journal = 0;
  const auto ring_row = [this](int i) -> int { return system_.ring_row(i % model_.grid.n_phi); };
  const auto* ring = std::get_if<RingWall>(&thermal_.shell);
  for (int node = 0; node < model_.grid.size(); ++node) {
    const double to_shell = into_shell(film, end, node) + shell_friction(film, node);
    if (has_own_temperatures(thermal_.shell)) into[ring_row(node / model_.grid.n_z)] += to_shell;
    shell += to_shell, journal += into_journal(film, end, node) + journal_friction(film, node);
  }
  for (int i = 0; ring != nullptr && i < n; ++i) {
    const double around = ring_.around[i] * (end.shell[(i + 1) % n] - end.shell[i]);
    into[ring_row(i)] += around + ring_.outside[i] * (at_ring(outside_) - end.shell[i]);
    into[ring_row(i + 1)] -= around;
  }
  if (has_own_temperature(thermal_.journal)) into[rows] = journal;
  Eigen::VectorXd into_nodes(2 + at_.outside());
  into_nodes << shell, journal, into_outside(film, end);
  mean_.add_heat(film.dt, into, into_nodes, start.film, end.film);
}

}  // namespace hersey::film
