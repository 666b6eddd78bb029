#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "hersey/core/outcome.h"

namespace hersey::solver {

enum class FactorStatus {
  failed,     ///< not a number, or out of memory on the way
  singular,   ///< some unknowns have no equation of their own: `null_unknowns`
  too_large,  ///< the factor would not fit into the memory at hand; nothing was tried
  factorised
};

/// Whether there is a factor to solve with; why not, with figures.
struct [[nodiscard]] FactorSummary : OutcomeOf<FactorStatus, FactorStatus::factorised> {
  int negative_pivots = 0;  ///< as many as A has negative eigenvalues (Sylvester's law of inertia)
  /// Where pivots vanished, ascending: some, not always all, of the null space's dimensions.
  std::vector<int> null_unknowns = {};
};

/// Sparse L D L^T of a sequence of large symmetric matrices that share one pattern (MUMPS, ordering by METIS).
///
/// Definite or not: 1 x 1 and 2 x 2 pivots are chosen by size, which a definite matrix passes at no cost. For finite
/// elements; small unsymmetric systems go to SparseLu. Not for several threads at once: calls of all instances take
/// turns, as MUMPS keeps global state.
///
/// @see Amestoy, Duff, L'Excellent, Koster (2001), SIAM J. Matrix Anal. Appl. 23, 15. @verified_by
/// symmetric_factor_test.cpp
class SymmetricFactor {
 public:
  SymmetricFactor();
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Orders the unknowns for the pattern of `A`, of which the lower triangle is read. The upper one may be stored or
  /// not.
  void analyse(const Eigen::SparseMatrix<double>& A);

  /// Memory that factorise() will take [bytes], estimated by analyse(); for an indefinite matrix it may take more.
  [[nodiscard]] double memory_estimate() const;

  /// Factorisation is refused above this; at first nine tenths of the memory that the machine has free.
  void set_memory_limit(double bytes);

  /// Factorises a matrix with the pattern that analyse() saw. After anything but `solved()` there is nothing to solve
  /// with.
  [[nodiscard]] FactorSummary factorise(const Eigen::SparseMatrix<double>& A);

  /// Overwrites every column of `b` (n, columns) by the solution of A x = b. Many columns at once take far less
  /// than one after the other.
  /// @pre the last factorise() was solved()
  void solve(Eigen::Ref<Eigen::MatrixXd> b) const;

  /// Rows n of the pattern; 0 before analyse().
  [[nodiscard]] int size() const;
  /// Whether there is a factor to solve with.
  [[nodiscard]] bool factorised() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::solver
