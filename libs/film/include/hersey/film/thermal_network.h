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
  /// A node of an oil circuit: without heat capacity it has the temperature of the oil that flows into it.
  bool is_oil = false;
};

/// A conductance between two nodes.
struct ThermalPath {
  std::string name;
  std::size_t a = 0, b = 0;  ///< nodes
  double conductance = 0;    ///< [W/K], >= 0
};

/// Oil that flows from one node into another and takes its heat along, through a cooler or not (theory manual,
/// circuit.14, circuit.15). Of the rate rho c Q of its heat capacity a part comes as warm as the node it leaves, the
/// other as cold as the coolant.
struct OilStream {
  std::size_t from = 0, to = 0;  ///< nodes
  double kept = 0;               ///< part of rho c Q at the temperature of `from` [W/K], >= 0
  std::size_t coolant = 0;       ///< node; of no account to a stream without `cooled`
  double cooled = 0;             ///< part of rho c Q at the temperature of `coolant` [W/K], >= 0
  double heat = 0;               ///< dissipated on the way [W], >= 0
};

struct ThermalNetworkModel {
  std::vector<ThermalNode> nodes;
  std::vector<ThermalPath> paths;
};

/// A film's heat at its terminals.
struct FilmAtNodes {
  FilmTerminals at;
  WallHeatFlow heat_flow;
};

/// Observation of a network over a step; powers in W.
struct NetworkObservables {
  Eigen::VectorXd T;     ///< of the nodes [K]
  Eigen::VectorXd heat;  ///< from films into each node
  /// That oil between nodes brings each: of what flows in, over what it has itself; from what flows through a cooler.
  Eigen::VectorXd by_oil = {};
  double exchanged = 0;  ///< sum of what passes between films and nodes, and by oil between nodes, whichever way
  double to_fixed = 0;   ///< into surroundings
  double stored = 0;     ///< rate of the bodies' heat
  /// Imbalance of (thermal.49) over the largest of these powers [-].
  [[nodiscard]] double error() const;
};

/// True if heat of the node can reach surroundings along paths.
[[nodiscard]] bool reaches_surroundings(const ThermalNetworkModel& model, std::size_t node);

/// Lumped bodies and surroundings, connected by conductances and warmed by films (theory manual, thermal.45 to
/// thermal.49).
class ThermalNetwork {
 public:
  /// Bodies at the temperatures of their start. @throws ContractError on nodes that are not there, or bodies without
  /// capacity
  explicit ThermalNetwork(ThermalNetworkModel model);

  /// The model, as it was given.
  [[nodiscard]] const ThermalNetworkModel& model() const { return model_; }
  /// Present temperatures of the nodes [K].
  [[nodiscard]] const Eigen::VectorXd& temperatures() const { return observables_.T; }

  /// Advances the temperatures implicitly over a step of length dt [s] with the heat that all films exchange with the
  /// nodes. dt = 0 takes them to a steady balance, in which bodies without a path to a film or to surroundings keep
  /// their temperatures. @param streams  of oil between nodes, constant over the step
  void advance(double dt, const std::vector<FilmAtNodes>& films, const std::vector<OilStream>& streams = {});

  /// Returns the present temperatures at a film's terminals, in the order of WallHeatFlow [K]; those of `otherwise`
  /// where a wall is no node.
  [[nodiscard]] Eigen::VectorXd walls(const FilmTerminals& at, const Eigen::VectorXd& otherwise) const;

  /// Observation of the last step; before the first one of temperatures only.
  [[nodiscard]] const NetworkObservables& observables() const { return observables_; }

  /// Saves or restores temperatures and the observation.
  void persist(Archive& archive);

 private:
  void observe(double dt, const Eigen::VectorXd& change, const std::vector<FilmAtNodes>& films,
               const std::vector<OilStream>& streams);

  ThermalNetworkModel model_;
  NetworkObservables observables_;
};

}  // namespace hersey::film
