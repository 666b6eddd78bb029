#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "balance/flow_balance.h"
#include "heat/heat_system.h"
#include "heat/heat_walls.h"
#include "heat/layer_flows.h"
#include "heat/layering.h"
#include "heat/mean_heat.h"
#include "heat/wall_flux.h"
#include "hersey/film/film_terminals.h"
#include "hersey/film/heat_state.h"
#include "hersey/film/thermal_model.h"
#include "hersey/solver/gmres.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// A solved film, which carries and generates heat.
struct CarryingFilm {
  const FlowBalance& balance;
  const FilmWrench& wrench;
  const LayerFlows& flows;
  double dt = 0;  ///< [s]; 0: steady
};

/// Energy balance of every layer, of the walls and of the oil in supplies, as one linear system (theory manual,
/// thermal.10 to thermal.15), solved by GMRES with sweeps along the flow.
class HeatEquations {
 public:
  HeatEquations(const FilmModel& model, const ThermalModel& thermal);

  /// Limits the iterations of GMRES [-]; the system is factorised where more are needed.
  void set_most_iterations(int iterations) { most_iterations_ = iterations; }

  /// Returns the temperatures at the end of a step from `start`.
  [[nodiscard]] HeatState solve(const CarryingFilm& film, const HeatState& start);

  /// Returns the derivative of the last solution's temperatures by the temperature of a wall that is prescribed [-]: of
  /// the shell everywhere, or of the journal.
  [[nodiscard]] HeatState response_to_shell();
  [[nodiscard]] HeatState response_to_journal();
  /// Returns the derivative by the temperature of one of the nodes that are no walls (FilmTerminals).
  [[nodiscard]] HeatState response_to_outside(Eigen::Index terminal);
  /// Returns the heat into these nodes [W], of temperatures or, as it is linear in them, of a change (theory manual,
  /// thermal.55, thermal.56).
  [[nodiscard]] Eigen::VectorXd into_outside(const CarryingFilm& film, const HeatState& state) const;

  /// Returns the terms of the balance, each by its own integral over a step from `start` to `end` (thermal.17).
  [[nodiscard]] HeatBalance balance(const CarryingFilm& film, const HeatState& start, const HeatState& end) const;
  /// Returns the heat that flows into the surface of a wall at a node, friction of asperities apart [W].
  [[nodiscard]] double into_shell(const CarryingFilm& film, const HeatState& state, int node) const;
  [[nodiscard]] double into_journal(const CarryingFilm& film, const HeatState& state, int node) const;
  [[nodiscard]] const RingConductances& ring() const { return ring_; }
  /// Means of the steps solved since fixed walls (WallMotion::fixed) last settled.
  [[nodiscard]] MeanHeat& mean() { return mean_; }

  /// Temperature of the oil supplied, before it mixes with the oil in the groove [K]. @param outside  of HeatState
  [[nodiscard]] double fresh(int supply, const Eigen::VectorXd& outside) const;
  /// Temperature of the oil that edges draw in, but for what ends draw beyond it [K]. @param outside  of HeatState
  [[nodiscard]] double at_edges(const Eigen::VectorXd& outside) const;
  /// Returns the flows over the ends of all patches, at these temperatures.
  [[nodiscard]] std::vector<EndFlow> end_flows(const CarryingFilm& film, const HeatState& state) const;
  /// Returns the oil at these ends as grooves between them mix it (theory manual, thermal.68).
  [[nodiscard]] std::vector<EndOil> mixed_in_grooves(const CarryingFilm& film, const HeatState& state) const;
  [[nodiscard]] int supplies() const { return static_cast<int>(model_.features.size()) + (has_line() ? 1 : 0); }

 private:
  /// A node in whose rows a supply has a part, and those rows without it.
  struct SuppliedNode {
    int node = 0, supply = 0;
    double chi = 0;   ///< weight of the supply [-]
    double flow = 0;  ///< flow of oil out of the supply [m^3/s]
    struct Row {
      HeatSystem::Row entries;  ///< entries, its own first; the oil from the supply is included
      double known = 0, by_shell = 0, by_journal = 0;
      Eigen::RowVectorXd by_outside = {};
    };
    std::vector<Row> rows;
  };
  /// Nodes without oil have the heat capacity of so small a fraction of the oil in the clearance.
  static constexpr double least_fill_ = 1e-6;
  /// Fraction of a node's width that conducts heat: the one that is sheared, and so makes it.
  [[nodiscard]] double conducting_fraction(const Node& node) const;
  [[nodiscard]] bool has_line() const { return model_.supply.kind != SupplyKind::none; }
  [[nodiscard]] bool is_line(int supply) const { return has_line() && supply == 0; }
  [[nodiscard]] double throughput(const CarryingFilm& film) const;  ///< largest of a control volume [m^3/s], > 0
  [[nodiscard]] int layers() const { return thermal_.layers; }
  /// Width of a layer over the film's thickness [-].
  [[nodiscard]] double width(int layer) const { return across_.width(static_cast<std::size_t>(layer)); }
  /// Layer next to the one beside a wall.
  [[nodiscard]] int next_to_top() const { return std::max(top() - 1, 0); }
  [[nodiscard]] int next_to_bottom() const { return std::min(1, top()); }
  [[nodiscard]] int top() const { return thermal_.layers - 1; }
  [[nodiscard]] double asperity_power(const CarryingFilm& film, int node) const;
  /// Friction heat of asperities that goes into either wall [W].
  [[nodiscard]] double shell_friction(const CarryingFilm& film, int node) const;
  [[nodiscard]] double journal_friction(const CarryingFilm& film, int node) const;
  /// Heat flux from the layer beside a wall, 0 or the last. @param resistance  of the wall itself, per area [m^2 K/W]
  [[nodiscard]] WallFlux to_wall(const CarryingFilm& film, int node, int layer, double resistance) const;
  /// Conductance between a layer and the next [W/K].
  [[nodiscard]] double between(const CarryingFilm& film, int node, int layer) const;
  [[nodiscard]] WallFlux to_shell(const CarryingFilm& film, int node) const;
  [[nodiscard]] WallFlux to_journal(const CarryingFilm& film, int node) const;
  [[nodiscard]] double start_volume(const CarryingFilm& film, int node) const;
  /// Heat of ThermalModel::source in a layer [W].
  [[nodiscard]] double made(const CarryingFilm& film, int node, int layer) const;
  /// Index of the node from which a supply, or edges, draw oil, among the nodes that are no walls; -1: none.
  [[nodiscard]] Eigen::Index oil_of(int supply) const;
  /// Oil at the end of a patch on which a node lies; null: it lies on none.
  [[nodiscard]] const EndOil* end_oil(const HeatState& state, int node) const;
  /// Temperature of the oil that comes in over the edge at a node [K].
  [[nodiscard]] double coming(const CarryingFilm& film, const HeatState& state, int node) const;
  /// Of the oil that comes in over the edge at a node, the fraction that is at_edges().
  [[nodiscard]] double fresh_fraction(const CarryingFilm& film, const HeatState& state, int node) const;
  /// Of the oil that leaves over the edge at a node, the fraction that no film draws in again.
  [[nodiscard]] double lost_fraction(const CarryingFilm& film, const HeatState& state, int node) const;
  [[nodiscard]] double at_ring(const Eigen::VectorXd& outside) const;
  /// Index of the node that takes what a supply removes from the film, among the nodes that are no walls; -1: none.
  [[nodiscard]] Eigen::Index taker_of(int supply) const;
  /// Oil that leaves the film for good into a node that is no wall.
  struct Drained {
    Eigen::Index into;
    int row;      ///< of the layer or supply that it comes from
    double rate;  ///< its heat per kelvin [W/K]
  };
  [[nodiscard]] std::vector<Drained> drained(const CarryingFilm& film, const HeatState& state) const;

  void assemble(const CarryingFilm& film, const HeatState& start);
  void add_storage(const CarryingFilm& film, const HeatState& start);
  /// Difference of the temperature across a layer of a node [K].
  [[nodiscard]] double slope_across(const Eigen::VectorXd& T, int node, int layer) const;
  void add_flows(const CarryingFilm& film, const HeatState& start);
  /// Origin of the oil that flows over a face.
  struct Upstream {
    int from = 0, to = 0;
    HeatSystem::Side side = HeatSystem::before;  ///< side of `to` on which `from` lies
    double slope_fraction =
        0;  ///< by which the face is warmer than `from`, of what that is warmer than the node behind it
  };
  [[nodiscard]] Upstream upstream(const CarryingFilm& film, std::size_t f, bool is_forwards) const;
  void add_flow(const Upstream& way, int layer, double q);
  [[nodiscard]] HeatSystem::Side side_of(int from, int to) const;
  void add_flow_upwards(const CarryingFilm& film);
  void add_edges(const CarryingFilm& film, const HeatState& start);
  void add_conduction(const CarryingFilm& film);
  void add_shell(const CarryingFilm& film, const HeatState& start);
  void add_ring(const CarryingFilm& film, const HeatState& start);
  void add_body(const WallConduction& body, const CarryingFilm& film, const HeatState& start);
  [[nodiscard]] Eigen::VectorXd heat_into_shell(const CarryingFilm& film, const HeatState& state) const;
  [[nodiscard]] double heat_into_journal(const CarryingFilm& film, const HeatState& state) const;
  void add_journal(const CarryingFilm& film);
  void add_walls_of_film(const CarryingFilm& film, const HeatState& start, int node, double chi);
  void add_film_on_line(const CarryingFilm& film, const SuppliedNode& supplied, const Eigen::VectorXd& taken_on);
  void add_supplies(const CarryingFilm& film, const HeatState& start);
  void find_mixed_fractions(const CarryingFilm& film);
  void renew(const CarryingFilm& film);
  [[nodiscard]] double renewed(const HeatState& state, int supply) const;
  void add_journal_row(const CarryingFilm& film, const HeatState& start);
  void add_remainder(const CarryingFilm& film, const HeatState& start);
  [[nodiscard]] bool has_fixed_walls(const CarryingFilm& film) const;
  void fix_walls(const HeatState& start);
  void fix_journal(double T);
  [[nodiscard]] std::vector<double> fresh_fractions(const CarryingFilm& film) const;
  void add_equations_to_mean(const CarryingFilm& film, const HeatState& start);
  [[nodiscard]] OutsideOfMean outside_of_mean(const CarryingFilm& film, const HeatState& start,
                                              const std::vector<double>& fresh) const;
  void add_heat_to_mean(const CarryingFilm& film, const HeatState& start, const HeatState& end);
  /// Computes y = A x, x = [layers; ring; journal; supplies].
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// Rows of journal and supplies in that product.
  [[nodiscard]] std::array<std::pair<int, double>, 2> journal_entries(int node) const;
  void multiply_remainder(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// Computes x close to A^-1 b: layers and ring by sweeps, journal and supplies eliminated.
  void precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  void prepare_sweeps(const CarryingFilm& film);
  /// Solves A x = known to `rtol` times the size of known.
  void solve_for(const Eigen::VectorXd& known, double fraction, Eigen::VectorXd& x);
  /// Solves A x = known by factorising A.
  void factorise_for(const Eigen::VectorXd& known, Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const;
  [[nodiscard]] HeatState response(const Eigen::VectorXd& known);

  const FilmModel model_;
  const ThermalModel thermal_;
  const FilmTerminals at_;
  const Layering& across_;
  std::vector<Eigen::Index> end_of_line_;  ///< index of the end of a patch that each line is, -1 for none
  double rc_ = 0;                          ///< heat capacity of the oil per volume [J/(m^3 K)]
  double heat_partition_ = 0.5;            ///< shell's fraction of the heat that asperities generate [-]
  RingConductances ring_;
  HeatSystem system_;
  Eigen::VectorXd known_;       ///< right-hand sides of all rows [W]
  Eigen::VectorXd by_shell_;    ///< of all rows, by a prescribed temperature of the shell [W/K]
  Eigen::MatrixXd by_outside_;  ///< of all rows, by those of the nodes that are no walls [W/K]
  Eigen::VectorXd outside_;     ///< temperatures of these in the step [K]
  Eigen::VectorXd by_journal_;  ///< of the rows of layers and ring, by the journal's temperature [W/K]
  std::vector<double>
      by_supply_;               ///< of the rows of layers, by the temperature of the supply that feeds the node [W/K]
  std::vector<int> supply_of_;  ///< of each node, -1 for none
  double journal_self_ = 0;     ///< entry of the journal's row by itself [W/K]
  std::vector<WallFlux> into_journal_;  ///< of a journal with a temperature of its own, by the layers beside it
  bool journal_moves_ = false;
  std::vector<double> supply_self_;  ///< of the supplies' rows
  Eigen::MatrixXd by_remainder_;  ///< what a sweep makes of layers and ring by journal and supplies, column by column
  Eigen::PartialPivLU<Eigen::MatrixXd> remainder_;  ///< journal and supplies, layers and ring following them
  /// Oil of a layer that a supply replaces by its own. In a node with a part of the supply only the rest counts.
  struct Renewal {
    int supply = 0, row = 0;
    double heat = 0;            ///< by its temperature [W/K]
    double mixed_fraction = 0;  ///< fraction that is the supply's own oil already [-]
  };
  std::vector<Renewal> renewals_;
  MeanHeat mean_;
  Eigen::VectorXd storage_;  ///< of the layers, in their diagonals beside supplies [W/K]
  solver::Gmres gmres_;
  int most_iterations_ = 120;
  std::vector<SuppliedNode> supplied_nodes_;
  Eigen::VectorXd inflow_;          ///< of each layer over its faces and edges [m^3/s]
  Eigen::VectorXd mixed_fraction_;  ///< fraction of each layer's oil that the supply of its node has mixed [-]
};

}  // namespace hersey::film
