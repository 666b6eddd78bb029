#pragma once

#include <Eigen/Dense>
#include <vector>

#include "balance/flow_balance.h"
#include "heat/heat_system.h"
#include "heat/heat_walls.h"
#include "heat/layer_flows.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"
#include "hersey/solver/gmres.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// A solved film: what heat is carried and made by.
struct CarryingFilm {
  const FlowBalance& balance;
  const FilmWrench& wrench;
  const LayerFlows& flows;
  double dt = 0;  ///< [s]; 0: steady
};

/// The energy balance of every layer, of the walls and of the oil in supplies, as one linear system (theory manual,
/// thermal.10 to thermal.15), solved by GMRES with sweeps along the flow.
class HeatEquations {
 public:
  HeatEquations(const FilmModel& model, const ThermalModel& thermal);

  /// Temperatures at the end of a step from `start`.
  [[nodiscard]] HeatState solve(const CarryingFilm& film, const HeatState& start);

  /// By how much temperatures of the last solution change where a wall whose temperature is held changes its own by
  /// one kelvin: the shell everywhere, or the journal.
  [[nodiscard]] HeatState response_to_shell();
  [[nodiscard]] HeatState response_to_journal();

  /// Each term by its own integral over a step from `start` to `end` (thermal.17).
  [[nodiscard]] HeatBalance balance(const CarryingFilm& film, const HeatState& start, const HeatState& end) const;
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
      HeatSystem::Row entries;  ///< its own first; what oil from the supply brings included
      double known = 0, by_shell = 0, by_journal = 0;
    };
    std::vector<Row> rows;
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
  void subtract_corrections(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  void add_flow_upwards(const CarryingFilm& film);
  void add_edges(const CarryingFilm& film);
  void add_conduction(const CarryingFilm& film);
  void add_shell(const CarryingFilm& film, const HeatState& start);
  void add_ring(const RingWall& ring, const CarryingFilm& film, const HeatState& start);
  void add_journal(const CarryingFilm& film);
  void add_supplies(const CarryingFilm& film);
  void renew(const CarryingFilm& film);
  [[nodiscard]] double renewed(const HeatState& state, int supply) const;
  void add_remainder(const CarryingFilm& film, const HeatState& start);
  /// y = A x, x = [layers; ring; journal; supplies].
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// Nearly x = A^-1 b.
  void precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  void prepare_sweeps(const CarryingFilm& film);
  /// Nearly A^-1 known; `share` of what is missing is left.
  void solve_for(const Eigen::VectorXd& known, double share, Eigen::VectorXd& x);
  [[nodiscard]] HeatState response(const Eigen::VectorXd& known);

  const FilmModel model_;
  const ThermalModel thermal_;
  double rc_ = 0;  ///< heat capacity of the oil per volume [J/(m^3 K)]
  RingConductances ring_;
  HeatSystem system_;
  Eigen::VectorXd known_;             ///< right-hand sides of all rows [W]
  Eigen::VectorXd by_shell_;          ///< of all rows, by the temperature of a shell that is held [W/K]
  Eigen::VectorXd by_journal_;        ///< of the rows of layers and ring, by the journal's temperature [W/K]
  std::vector<double> by_supply_;     ///< of the rows of layers, by that of the supply that holds the node [W/K]
  std::vector<int> supply_of_;        ///< of each node, -1 for none
  double journal_self_ = 0;           ///< entry of the journal's row by itself [W/K]
  std::vector<double> into_journal_;  ///< of a journal that is free, by the layers beside it [W/K]
  bool journal_is_free_ = false;
  std::vector<double> supply_self_;      ///< of the supplies' rows
  std::vector<double> supply_diagonal_;  ///< the same, and what of their nodes' rows follows them
  /// Heat that the temperature between two nodes, beyond that of the first, carries from one to the next.
  struct Correction {
    int behind = 0, from = 0, to = 0;     ///< rows
    double share_from = 1, share_to = 1;  ///< of the row's own balance, beside supplies [-]
    int supply = -1;                      ///< that has a share of `to`
    double heat = 0;                      ///< by the rise from behind to from [W/K]
  };
  std::vector<Correction> corrections_;
  /// Oil of a layer that a supply replaces by its own.
  struct Renewal {
    int supply = 0, row = 0;
    double heat = 0;  ///< by its temperature [W/K]
  };
  std::vector<Renewal> renewals_;
  solver::Gmres gmres_;
  std::vector<Held> held_;
  std::vector<double> inflow_;  ///< of each node over its faces and edges [m^3/s]
};

}  // namespace hersey::film
