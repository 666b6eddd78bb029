#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "heat/wall_answer.h"
#include "hersey/core/archive.h"
#include "hersey/film/grid.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Linear system of a film's layers and of a ring around it, row by row: each layer is coupled to those below and above
/// it, to the same layer of the four neighbouring nodes and of those beyond, and the lowest layer to the ring. Rows:
/// layers node by node, then the ring's angles.
///
/// Oil flows one way. A sweep over the nodes in that direction, each column of layers solved as a whole, solves most of
/// the system and serves as a preconditioner.
class HeatSystem {
 public:
  /// Neighbours of a node: before and after it around the bearing and along the axis.
  enum Side { before, after, left, right };

  HeatSystem(const Grid& grid, int layers, bool has_ring);

  [[nodiscard]] int size() const { return film_rows() + ring_rows(); }
  [[nodiscard]] int row(int node, int layer) const { return node * layers_ + layer; }
  [[nodiscard]] int ring_row(int i) const { return film_rows() + i; }

  void set_zero();
  /// Sets the ring's rows, written as balances of heat, for a wall whose temperatures respond to heat (thermal.37): row
  /// i becomes scale (T_i + sum_j rise_ij (balance of j)). Null: a ring. It applies until the next call.
  void set_answer(const Eigen::MatrixXd* rise, double scale) { answer_.set(rise, scale); }
  [[nodiscard]] double& diagonal(int row) {
    return row < film_rows() ? layer_[row].self : ring_[row - film_rows()].self;
  }
  [[nodiscard]] double& below(int node, int layer) { return layer_[row(node, layer)].below; }
  [[nodiscard]] double& above(int node, int layer) { return layer_[row(node, layer)].above; }
  [[nodiscard]] double& beside(int node, int layer, Side side) { return from_slot(8 * node + side, layer); }
  /// Entry by the node two steps away on that side.
  [[nodiscard]] double& beyond(int node, int layer, Side side) { return from_slot(8 * node + 4 + side, layer); }
  [[nodiscard]] double& to_ring(int node) { return layer_[row(node, 0)].ring; }
  /// Entry of the ring's row by one of the two layers beside it.
  [[nodiscard]] double& from_film(int node, int layer) { return from_film_[2 * node + layer]; }
  [[nodiscard]] double& ring_before(int i) { return ring_[i].before; }
  [[nodiscard]] double& ring_after(int i) { return ring_[i].after; }

  /// Columns and entries of one row.
  using Row = std::vector<std::pair<int, double>>;
  [[nodiscard]] Row entries(int node, int layer) const;
  /// Columns and entries of one row of the ring.
  [[nodiscard]] Row ring_entries(int i) const;
  /// Multiplies a row of the film.
  void scale(int row, double factor);

  /// Adds `weight` times another system of the same film.
  void add(double weight, const HeatSystem& other);
  /// Fixes the ring's temperatures: its rows become those of the unit matrix.
  void fix_ring();

  /// Prepares products, and sweeps that begin at angle `first` and run towards growing or falling angles.
  void prepare(int first, bool forwards);
  /// Computes the first size() entries of y = A x; further entries of x and y are left alone.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// Solves A x = b without the coupling against the sweep and from the ring back to the film, for the first size()
  /// entries.
  void sweep(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

  /// Saves or restores the entries.
  void persist(Archive& archive);

 private:
  struct Layer {
    double self = 0, below = 0, above = 0, ring = 0;
    [[nodiscard]] std::array<double*, 4> entries() { return {&self, &below, &above, &ring}; }
  };
  struct Ring {
    double self = 0, before = 0, after = 0;
    [[nodiscard]] std::array<double*, 3> entries() { return {&self, &before, &after}; }
  };
  /// Couplings of one column with others; from `later` on with columns that follow in the sweep.
  struct Links {
    int begin = 0, later = 0, end = 0;
  };
  /// 1/pivot, and the entries below and above over it.
  struct Pivot {
    double inverse = 0, below = 0, above = 0;
  };
  [[nodiscard]] int film_rows() const { return static_cast<int>(layer_.size()); }
  [[nodiscard]] int ring_rows() const { return static_cast<int>(ring_.size()); }
  [[nodiscard]] int lowest() const { return layers_ > 1 ? 2 : 1; }
  [[nodiscard]] double from_film(int node, const Eigen::VectorXd& x) const;
  [[nodiscard]] int neighbour(int node, int side) const { return neighbours_[node][side]; }
  [[nodiscard]] int next_but_one(int node, int side) const { return neighbour(neighbour(node, side), side); }
  /// Neighbour in `slot` % 8 of a node: four beside it, four beyond these.
  [[nodiscard]] int node_at(int slot) const {
    const int node = slot / 8, side = slot % 4;
    return slot % 8 < 4 ? neighbour(node, side) : next_but_one(node, side);
  }
  [[nodiscard]] double& from_slot(int slot, int layer) {
    is_linked_[slot] = true;
    return from_slots_[slot * layers_ + layer];
  }
  void find_links();
  template <class Action>
  void for_layers(Action&& action) const;
  template <int N>
  void subtract(int begin, int end, const double* x, std::span<double> sums) const;
  template <int N>
  void multiply_layers(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  template <int N>
  void sweep_layers(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  [[nodiscard]] Row answer_entries(int i) const;
  void prepare_ring();
  void solve_ring(Eigen::VectorXd& x) const;

  Grid grid_;
  int layers_;
  std::vector<Layer> layer_;
  std::vector<double> from_slots_;  ///< entries by the eight nodes around each, of all layers side by side
  std::vector<char> is_linked_;     ///< true if some of the entries are not zero
  std::vector<Ring> ring_;
  std::vector<double> from_film_;               ///< entries of the ring's rows by the two lowest layers of each node
  std::vector<std::array<int, 4>> neighbours_;  ///< itself where there is none
  std::vector<int> order_;                      ///< nodes in the order of a sweep
  std::vector<Pivot> pivots_;                   ///< of every layer in its column
  std::vector<Links> links_;                    ///< of each node
  std::vector<std::pair<int, int>> linked_;     ///< slot of each coupling, and the first row of the other column
  std::vector<std::pair<double, double>> ring_pivots_;
  Eigen::VectorXd closing_;  ///< solution of the open ring for the entries that close it
  double closing_fraction_ = 0;
  WallAnswer answer_;
};

}  // namespace hersey::film
