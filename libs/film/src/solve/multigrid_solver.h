#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "hersey/solver/gmres.h"
#include "solve/multigrid.h"

namespace hersey::film {

/// Linear systems with the Jacobian of a film by GMRES, preconditioned by one V-cycle on that Jacobian (theory manual,
/// film.35 to film.38).
class MultigridSolver {
 public:
  /// @param column_start,row_index  five-point pattern on the grid's ring, node (i, j) at i n_z + j
  MultigridSolver(int n_phi, int n_z, std::span<const int> column_start, std::span<const int> row_index);

  /// Sets a matrix with that pattern.
  /// @param ascending  true if the flow runs towards growing phi
  /// @returns false where the multigrid operators are singular
  [[nodiscard]] bool setup(std::span<const double> values, bool ascending);

  /// Solves A x = b.
  [[nodiscard]] solver::GmresSummary solve(const Eigen::VectorXd& b, const solver::GmresOptions& options,
                                           Eigen::VectorXd& x);

 private:
  /// Centre, then the nodes before and after along phi, then along z.
  using Row = std::array<double, 5>;

  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  void precondition(const Eigen::VectorXd& b, Eigen::VectorXd& x);

  int n_phi_, n_z_;
  std::vector<int> slot_;  ///< of each value of the pattern its index in rows_, five to a node
  std::vector<Row> rows_;
  std::vector<char> active_;
  Multigrid multigrid_;
  LineVector rhs_, answer_;
  solver::Gmres gmres_;
  solver::Gmres::Operator matrix_, preconditioner_;
};

}  // namespace hersey::film
