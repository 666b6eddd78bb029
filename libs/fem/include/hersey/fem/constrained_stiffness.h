#pragma once

#include <array>
#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/solver/symmetric_factor.h"

namespace hersey::fem {

/// Returns the degrees of freedom of `nodes` along the chosen axes.
[[nodiscard]] std::vector<int> dofs_of(const std::vector<int>& nodes,
                                       const std::array<bool, 3>& axes = {true, true, true});

/// Returns the full mass matrix M = m (x) I3, (3 n, 3 n).
[[nodiscard]] Eigen::SparseMatrix<double> mass_matrix(const Eigen::SparseMatrix<double>& m);

/// Factorised matrix K - shift M of a body whose `fixed_dofs` do not move and whose other degrees of freedom obey
/// linear constraints C u = d:
///     [K - shift M   C^T] [u     ]   [f]
///     [C             0  ] [lambda] = [d].                                                         (elastic.11)
class ConstrainedStiffness {
 public:
  /// @param fixed_dofs indices of degrees of freedom, any order, repetitions allowed
  /// @param C (constraints, 3 n), independent of each other on the free degrees of freedom; no rows: none
  ConstrainedStiffness(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& m,
                       const std::vector<int>& fixed_dofs, const Eigen::SparseMatrix<double>& C = {});

  /// Replaces K by another matrix of the same pattern.
  void replace(const Eigen::SparseMatrix<double>& K);

  /// Factorises for a shift; the first call also analyses the pattern. `singular` means that the body, or a part of it,
  /// is not supported.
  [[nodiscard]] solver::FactorSummary factorise(double shift = 0);

  /// Returns u (3 n, columns) with (K - shift M) u = f on the free degrees of freedom, u = 0 on the fixed ones, and C u
  /// = 0.
  /// @pre the last factorise() was solved()
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& f) const;

  /// Returns the solution with C u = d, d (constraints, columns).
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& d) const;

  /// Number of degrees of freedom, fixed ones included.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(free_index_.size()); }

  /// Dimension of the space of displacements that supports and constraints allow.
  [[nodiscard]] Eigen::Index freedom() const { return static_cast<Eigen::Index>(free_.size()) - constraints_; }

  /// Estimates the memory that factorise() needs [bytes].
  [[nodiscard]] double memory_estimate();

 private:
  void analyse();
  [[nodiscard]] Eigen::SparseMatrix<double> shifted(double shift) const;

  std::vector<int> free_index_;  ///< index of each degree of freedom among the free ones; -1: fixed
  std::vector<int> free_;
  Eigen::Index constraints_ = 0;
  /// Lower triangles on the free degrees of freedom and the multipliers.
  Eigen::SparseMatrix<double> K_free_, M_free_, C_free_;
  solver::SymmetricFactor factor_;
  bool analysed_ = false;
};

/// Result of a static solution.
struct [[nodiscard]] StaticSolution : Outcome {
  bool is_supported = true;  ///< false: some rigid or mechanism motion meets no resistance
  Eigen::MatrixXd u;         ///< displacements (3 n, loads) [m]
  Eigen::MatrixXd reaction;  ///< forces of the supports (3 n, loads) [N], zero where the body is free
};

/// Support: a displacement prescribed along one degree of freedom.
struct Support {
  int dof = 0;
  double displacement = 0;  ///< [m]
};

/// Solves K u = f + reaction for each column of `f` (3 n, loads). Where the body is not supported the message says so,
/// (elastic.10).
[[nodiscard]] StaticSolution solve_static(const ElasticBody& body, const std::vector<Support>& supports,
                                          const Eigen::MatrixXd& f);

}  // namespace hersey::fem
