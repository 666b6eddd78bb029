#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "hersey/solver/gmres.h"
#include "multigrid.h"

namespace hersey::film {

/// What a node is to the linear solver.
enum class NodeRole : char {
  pressure,   ///< its unknown is a pressure that its neighbours feel
  transport,  ///< its unknown is a fill fraction (or a slack) that at most its downstream neighbours feel
  given,      ///< its row holds nothing but its own unknown
};

/// Where the flow carries things, by the sign of its speeds.
struct FlowDirection {
  bool ascending_phi = true;
  bool ascending_z = true;
};

/// Linear systems with the Jacobian of a film by GMRES, preconditioned by multigrid (theory manual, film.30 to
/// film.32).
///
/// Cavitated nodes only pass oil on: given the pressures, one sweep with the flow solves their rows exactly. They are
/// eliminated from those of the pressures (where oil returns to a full node, exactly so for one node upstream), and
/// multigrid solves what is left. All of it follows from the matrix, the shape of the grid and which nodes are full.
class MultigridSolver {
 public:
  /// @param column_start,row_index  five-point pattern on the grid's ring, node (i, j) at i n_z + j
  MultigridSolver(int n_phi, int n_z, std::span<const int> column_start, std::span<const int> row_index);

  /// Takes a matrix with that pattern. Entries towards cavitated nodes downstream are expected to be zero.
  /// @param has_pressure  per node: neighbours feel its unknown as a pressure
  /// @returns false where the multigrid operators are singular
  [[nodiscard]] bool setup(std::span<const double> values, std::span<const char> has_pressure, FlowDirection flow);

  /// x from A x = b.
  [[nodiscard]] solver::GmresSummary solve(const Eigen::VectorXd& b, const solver::GmresOptions& options,
                                           Eigen::VectorXd& x);

 private:
  /// centre, then the nodes before and after along phi, then along z
  using Row = std::array<double, 5>;
  static constexpr int centre = 0, west = 1, east = 2, south = 3, north = 4;

  [[nodiscard]] int neighbour(int node, int place) const { return around_[node][place]; }
  void find_roles(std::span<const char> has_pressure);
  void eliminate_transport();
  void eliminate(int node, int place);
  void order_transport(FlowDirection flow);
  void sweep_transport(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  void precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x);
  [[nodiscard]] double coupled(int node, const Eigen::VectorXd& x) const;

  int n_phi_, n_z_;
  std::vector<std::array<int, 5>> around_;  ///< each node's neighbours; itself where there is none, with a zero entry
  std::vector<int> slot_row_, slot_place_;  ///< of each value of the pattern
  std::vector<Row> rows_;
  std::vector<NodeRole> roles_;
  std::vector<char> active_;
  std::vector<int> transport_, given_;  ///< nodes in the order of their solution
  bool rings_ = false;                  ///< transport may go around: the order is not exact after one sweep
  Multigrid multigrid_;
  LineVector rhs_, pressure_;
  solver::Gmres gmres_;
  solver::Gmres::Operator matrix_, preconditioner_;
};

}  // namespace hersey::film
