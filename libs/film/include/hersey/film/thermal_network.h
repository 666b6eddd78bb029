#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/film/film_terminals.h"
#include "hersey/film/heat_state.h"

namespace hersey::film {

/// A lumped body of one temperature, or surroundings that keep theirs.
struct ThermalNode {
  std::string name;
  double heat_capacity = 0;  ///< [J/K], > 0 of a body; of no account to a balance without time
  double T = 293.15;         ///< at the start [K]
  bool is_fixed = false;     ///< surroundings: T is given
};

/// What conducts heat between two nodes.
struct ThermalPath {
  std::string name;
  std::size_t a = 0, b = 0;  ///< nodes
  double conductance = 0;    ///< [W/K], >= 0
};

struct ThermalNetworkModel {
  std::vector<ThermalNode> nodes;
  std::vector<ThermalPath> paths;
};

/// A film's heat at its terminals.
struct FilmAtNodes {
  FilmTerminals at;
  WallExchange exchange;
};

/// What a network's heat has done over a step; powers in W.
struct NetworkObservables {
  Eigen::VectorXd T;     ///< of the nodes [K]
  Eigen::VectorXd heat;  ///< from films into each node
  double to_fixed = 0;   ///< into surroundings
  double stored = 0;     ///< rate of the bodies' heat
  /// What is missing in (thermal.49), over the largest of these [-].
  [[nodiscard]] double error() const;
};

/// Whether heat of the node can reach surroundings along paths.
[[nodiscard]] bool reaches_surroundings(const ThermalNetworkModel& model, std::size_t node);

/// Lumped bodies and surroundings, connected by conductances and warmed by films (theory manual, thermal.45 to
/// thermal.49).
class ThermalNetwork {
 public:
  /// Bodies at the temperatures of their start. @throws ContractError on nodes that are not there, or bodies without
  /// capacity
  explicit ThermalNetwork(ThermalNetworkModel model);

  /// As given.
  [[nodiscard]] const ThermalNetworkModel& model() const { return model_; }
  /// Now [K].
  [[nodiscard]] const Eigen::VectorXd& temperatures() const { return seen_.T; }

  /// Temperatures at the end of a step of length dt [s], implicitly, with what all films exchange with the nodes; of a
  /// balance without time where dt = 0: bodies that neither a film nor surroundings hold keep theirs.
  void advance(double dt, const std::vector<FilmAtNodes>& films);

  /// Temperatures now at a film's terminals, in the order of WallExchange [K]; those of `otherwise` where a wall is no
  /// node.
  [[nodiscard]] Eigen::VectorXd walls(const FilmTerminals& at, const Eigen::VectorXd& otherwise) const;

  /// Of the last step; before the first one of temperatures only.
  [[nodiscard]] const NetworkObservables& observables() const { return seen_; }

  /// Temperatures and what is shown.
  void persist(Archive& archive);

 private:
  void observe(double dt, const Eigen::VectorXd& change, const std::vector<FilmAtNodes>& films);

  ThermalNetworkModel model_;
  NetworkObservables seen_;
};

}  // namespace hersey::film
