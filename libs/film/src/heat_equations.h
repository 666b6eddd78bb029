#pragma once

#include <Eigen/Dense>
#include <vector>

#include "film_wrench.h"
#include "flow_balance.h"
#include "heat_system.h"
#include "heat_walls.h"
#include "hersey/film/film_heat.h"
#include "layer_flows.h"

namespace hersey::film {

/// A solved film: what heat is carried and made by.
struct CarryingFilm {
  const FlowBalance& balance;
  const FilmWrench& wrench;
  const LayerFlows& flows;
  double dt = 0;  ///< [s]; 0: steady
};

/// The energy balance of every layer, of the walls and of the oil in supplies, as one linear system (theory manual,
/// thermal.10 to thermal.15). Layers and ring are solved for known journal and supplies, for a unit of each of these,
/// and what is left is a small system for them.
class HeatEquations {
 public:
  HeatEquations(const FilmModel& model, const ThermalModel& thermal);

  /// Temperatures at the end of a step from `start`.
  [[nodiscard]] HeatState solve(const CarryingFilm& film, const HeatState& start);

  /// Of the last solution.
  [[nodiscard]] const HeatBalance& balance() const { return balance_; }
  /// Heat that flows into the surface of a wall at a node, friction of asperities apart [W].
  [[nodiscard]] double into_shell(const CarryingFilm& film, const HeatState& state, int node) const;
  [[nodiscard]] double into_journal(const CarryingFilm& film, const HeatState& state, int node) const;
  [[nodiscard]] const RingConductances& ring() const { return ring_; }

  /// Of oil supplied, before it meets what is in the groove [K].
  [[nodiscard]] double fresh(int supply) const;
  [[nodiscard]] int supplies() const { return static_cast<int>(model_.features.size()) + (has_line() ? 1 : 0); }

 private:
  /// A node in whose rows a supply has a part, and those rows without it.
  struct Held {
    int node = 0, supply = 0;
    double chi = 0;   ///< share of the supply [-]
    double flow = 0;  ///< of oil out of it [m^3/s]
    struct Row {
      HeatSystem::Row entries;
      double known = 0, by_journal = 0, flow = 0;
    };
    std::vector<Row> rows;
  };
  /// What the temperatures of journal and supplies, y, have to obey: A y = b.
  struct Remainder {
    Eigen::MatrixXd A;
    Eigen::VectorXd b;
  };

  [[nodiscard]] bool has_line() const { return model_.supply.kind != SupplyKind::none; }
  [[nodiscard]] int layers() const { return thermal_.layers; }
  [[nodiscard]] int top() const { return thermal_.layers - 1; }
  [[nodiscard]] double asperity_power(const CarryingFilm& film, int node) const;
  /// Conductance between the film's middle of the layer beside a wall and the wall [W/K].
  [[nodiscard]] double to_wall(const CarryingFilm& film, int node, double resistance) const;
  [[nodiscard]] double to_shell(const CarryingFilm& film, int node) const;
  [[nodiscard]] double to_journal(const CarryingFilm& film, int node) const;
  [[nodiscard]] double start_volume(const CarryingFilm& film, int node) const;

  void add_storage(const CarryingFilm& film, const HeatState& start);
  void add_flows(const CarryingFilm& film);
  void add_flow(int from, int to, int layer, double q);
  void add_second_order(const CarryingFilm& film, std::size_t f, int layer, double q);
  [[nodiscard]] Eigen::VectorXd corrections(const Eigen::VectorXd& film) const;
  void add_flow_upwards(const CarryingFilm& film);
  void add_edges(const CarryingFilm& film);
  void add_conduction(const CarryingFilm& film);
  void add_shell(const CarryingFilm& film, const HeatState& start);
  void add_ring(const RingWall& ring, const CarryingFilm& film, const HeatState& start);
  void add_journal(const CarryingFilm& film);
  void add_supplies(const CarryingFilm& film);
  void renew(const CarryingFilm& film);
  [[nodiscard]] double renewed(const HeatState& state, int supply) const;
  [[nodiscard]] HeatState with_corrections(const CarryingFilm& film, const HeatState& start, const Eigen::VectorXd& lagged);
  [[nodiscard]] Remainder remainder(const CarryingFilm& film, const HeatState& start,
                                    const Eigen::VectorXd& lagged) const;
  void take_balance(const CarryingFilm& film, const HeatState& start, const HeatState& end);

  const FilmModel model_;
  const ThermalModel thermal_;
  double rc_ = 0;  ///< heat capacity of the oil per volume [J/(m^3 K)]
  RingConductances ring_;
  HeatSystem system_;
  Eigen::MatrixXd rhs_;  ///< of everything known; of the journal's temperature; of each supply's
  Eigen::MatrixXd answers_;  ///< to each of these
  /// Heat that the temperature between two nodes, beyond that of the first, carries from one to the next.
  struct Correction {
    int behind = 0, from = 0, to = 0;  ///< rows
    double share_from = 1, share_to = 1;  ///< of the row's own balance, beside supplies [-]
    int supply = -1;                   ///< that has a share of `to`
    double heat = 0;                   ///< by the rise from behind to from [W/K]
  };
  std::vector<Correction> corrections_;
  /// Oil of a layer that a supply replaces by its own.
  struct Renewal {
    int supply = 0, row = 0;
    double heat = 0;  ///< by its temperature [W/K]
  };
  std::vector<Renewal> renewals_;
  std::vector<Held> held_;
  std::vector<double> inflow_;  ///< of each node over its faces and edges [m^3/s]
  HeatBalance balance_;
};

}  // namespace hersey::film
