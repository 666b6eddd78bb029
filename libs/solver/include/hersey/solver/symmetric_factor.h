#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "hersey/core/outcome.h"

namespace hersey::solver {

enum class FactorStatus {
  failed,     ///< not a number, or out of memory during the factorisation
  singular,   ///< the matrix is singular along `null_unknowns`
  too_large,  ///< the factor would not fit into the available memory; it was not attempted
  factorised
};

/// Outcome of a factorisation; the message states the reason of a failure with its figures.
struct [[nodiscard]] FactorSummary : OutcomeOf<FactorStatus, FactorStatus::factorised> {
  int negative_pivots = 0;  ///< number of negative eigenvalues of A (Sylvester's law of inertia)
  /// Unknowns with vanishing pivots, ascending; they need not span the whole null space.
  std::vector<int> null_unknowns = {};
};

/// Sparse L D L^T of a sequence of large symmetric matrices that share one pattern (MUMPS, ordering by METIS).
/// The matrices may be definite or indefinite: 1 x 1 and 2 x 2 pivots are chosen by magnitude, which costs nothing for
/// a definite matrix. Use it for finite elements, and SparseLu for small unsymmetric systems. Calls of all instances
/// exclude each other, as MUMPS keeps global state.
///
/// @see Amestoy, Duff, L'Excellent, Koster (2001), SIAM J. Matrix Anal. Appl. 23, 15. @verified_by
/// symmetric_factor_test.cpp
class SymmetricFactor {
 public:
  SymmetricFactor();
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Orders the unknowns for the pattern of `A`. Only the lower triangle is read; the upper one may be stored.
  void analyse(const Eigen::SparseMatrix<double>& A);

  /// Returns the memory that factorise() needs [bytes], estimated by analyse(); an indefinite matrix may need more.
  [[nodiscard]] double memory_estimate() const;

  /// Sets the memory above which factorisation is refused [bytes]; initially nine tenths of the free memory of the
  /// machine.
  void set_memory_limit(double bytes);

  /// Factorises a matrix with the pattern given to analyse(). Unless `solved()`, there is no factor to solve with.
  [[nodiscard]] FactorSummary factorise(const Eigen::SparseMatrix<double>& A);

  /// Overwrites every column of `b` (n, columns) by the solution of A x = b. Many columns at once cost far less than
  /// one after the other.
  /// @pre the last factorise() was solved()
  void solve(Eigen::Ref<Eigen::MatrixXd> b) const;

  /// Returns the number of rows n of the pattern; 0 before analyse().
  [[nodiscard]] int size() const;
  /// True if there is a factor to solve with.
  [[nodiscard]] bool factorised() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::solver
