#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "hersey/core/outcome.h"
#include "solve/multigrid.h"

namespace hersey::film {

/// How far a system is solved.
struct MultigridOptions {
  double rtol = 1e-10;      ///< what is left of the right-hand side's Euclidean norm
  int max_iterations = 80;  ///< V-cycles
};

/// Outcome of a solution of one right-hand side, or of several.
struct [[nodiscard]] MultigridSummary : Outcome {
  int iterations = 0;  ///< V-cycles, each counted once for every right-hand side it serves
};

/// Linear systems with the Jacobian of a film by flexible GMRES, preconditioned by one V-cycle on that Jacobian (theory
/// manual, film.35 to film.38). Vectors of GMRES are in single precision, which halves the traffic and the memory;
/// solution and residual are in double precision, and a restart after a few vectors refines the one by the other.
/// Right-hand sides are taken kAbreast at a time, each with a Krylov space of its own.
/// @see Saad (1993), A flexible inner-outer preconditioned GMRES algorithm, SIAM J. Sci. Comput. 14, 461-469.
/// @verified_by multigrid_test.cpp
class MultigridSolver {
 public:
  /// @param column_start,row_index  five-point pattern on the grid's ring, node (i, j) at i n_z + j
  MultigridSolver(int n_phi, int n_z, std::span<const int> column_start, std::span<const int> row_index);

  /// Sets a matrix with that pattern.
  /// @param ascending  true if the flow runs towards growing phi
  /// @returns false where the multigrid operators are singular
  [[nodiscard]] bool setup(std::span<const double> values, bool ascending);

  /// Solves A x = b.
  [[nodiscard]] MultigridSummary solve(const Eigen::VectorXd& b, const MultigridOptions& options, Eigen::VectorXd& x);

  /// Replaces each column b by the solution of A x = b, or, where that is not found, by the best approximation.
  [[nodiscard]] MultigridSummary solve(Eigen::Ref<Eigen::MatrixXd> columns, const MultigridOptions& options);

 private:
  /// Centre, then the nodes before and after along phi, then along z.
  using Row = std::array<double, 5>;

  /// Vectors of GMRES for one right-hand side or several, allocated by the first solution that needs them.
  template <class Value>
  struct Krylov {
    using Wide = WideOf<Value>;
    std::vector<LineVectorOf<Value>> basis, preconditioned;
    std::vector<Wide> x, residual;
  };
  template <class Value>
  [[nodiscard]] Krylov<Value>& krylov_of();
  template <class Value>
  void find_residual(const Eigen::Ref<const Eigen::MatrixXd>& b, Krylov<Value>& krylov) const;
  template <class Value>
  void multiply(const LineVectorOf<Value>& x, LineVectorOf<Value>& y) const;
  template <class Value, class Projections>
  void add_combination(const Projections& projections, int count, Krylov<Value>& krylov) const;
  template <class Value>
  [[nodiscard]] MultigridSummary solve_abreast(Eigen::Ref<Eigen::MatrixXd> columns, const MultigridOptions& options);

  int n_phi_, n_z_;
  std::vector<int> slot_;  ///< of each value of the pattern its index in rows_, five to a node
  std::vector<Row> rows_;
  std::vector<char> active_;
  Multigrid multigrid_;
  Krylov<Real> single_;
  Krylov<Pack> abreast_;
  double unit_ = 1;  ///< largest entry of the matrix on its diagonal
};

}  // namespace hersey::film
