#pragma once

#include <array>
#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/fem/elastic_body.h"
#include "hersey/solver/symmetric_factor.h"

namespace hersey::fem {

/// Degrees of freedom of `nodes` along the axes asked for.
[[nodiscard]] std::vector<int> dofs_of(const std::vector<int>& nodes,
                                       const std::array<bool, 3>& axes = {true, true, true});

/// M = m (x) I3 written out, (3 n, 3 n).
[[nodiscard]] Eigen::SparseMatrix<double> mass_matrix(const Eigen::SparseMatrix<double>& m);

/// K - shift M of a body whose `held` degrees of freedom do not move and whose others obey linear constraints C u = d,
/// factorised:
///     [K - shift M   C^T] [u     ]   [f]
///     [C             0  ] [lambda] = [d].                                                         (elastic.11)
class ConstrainedStiffness {
 public:
  /// @param held places of degrees of freedom, any order, repetitions allowed
  /// @param C (constraints, 3 n), independent of each other on the free degrees of freedom; no rows: none
  ConstrainedStiffness(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& m,
                       const std::vector<int>& held, const Eigen::SparseMatrix<double>& C = {});

  /// Takes another K of the same pattern.
  void replace(const Eigen::SparseMatrix<double>& K);

  /// Analyses where this is the first time. `singular` means that the body, or a part of it, is not held.
  [[nodiscard]] solver::FactorSummary factorise(double shift = 0);

  /// u (3 n, columns) with (K - shift M) u = f where the body is free, u = 0 where it is held and C u = 0.
  /// @pre the last factorise() was solved()
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& f) const;

  /// The same with C u = d, d (constraints, columns).
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& f, const Eigen::MatrixXd& d) const;

  /// Degrees of freedom, held ones included.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(place_.size()); }

  /// Dimension of the displacements that supports and constraints leave.
  [[nodiscard]] Eigen::Index freedom() const { return static_cast<Eigen::Index>(free_.size()) - constraints_; }

  /// Memory that factorise() takes [bytes].
  [[nodiscard]] double memory_estimate();

 private:
  void analyse();
  [[nodiscard]] Eigen::SparseMatrix<double> shifted(double shift) const;

  std::vector<int> place_;  ///< of each degree of freedom among the free ones; -1: held
  std::vector<int> free_;
  Eigen::Index constraints_ = 0;
  /// Lower triangles on the free degrees of freedom and the multipliers.
  Eigen::SparseMatrix<double> K_free_, M_free_, C_free_;
  solver::SymmetricFactor factor_;
  bool analysed_ = false;
};

/// What became of a static solution.
struct [[nodiscard]] StaticSolution : Outcome {
  bool held = true;          ///< false: some motion meets no resistance
  Eigen::MatrixXd u;         ///< displacements (3 n, loads) [m]
  Eigen::MatrixXd reaction;  ///< forces of the supports (3 n, loads) [N], zero where the body is free
};

/// Displacement prescribed along one degree of freedom.
struct Support {
  int dof = 0;
  double displacement = 0;  ///< [m]
};

/// K u = f + reaction, for each column of `f` (3 n, loads); a body that is not held is told so, (elastic.10).
[[nodiscard]] StaticSolution solve_static(const ElasticBody& body, const std::vector<Support>& supports,
                                          const Eigen::MatrixXd& f);

}  // namespace hersey::fem
