#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <span>

#include "hersey/core/archive.h"

namespace hersey::solver {

/// Sparse LU of a sequence of square matrices that share one pattern (SuiteSparse KLU, compressed columns).
///
/// The pattern is ordered once; the first matrix is factorised with pivoting, later ones reuse that pivot order, which
/// is two to three times cheaper. The pivot growth of every reuse is checked, and if it is too large the matrix is
/// factorised with new pivoting. No allocation after the first factorisation unless the pivot order changes.
///
/// @see Davis & Palamadai Natarajan (2010), Algorithm 907: KLU, ACM TOMS 37(3).
class SparseLu {
 public:
  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Analyses the pattern: `column_start` of length n + 1, `row_index` ascending within each column.
  /// @throws ContractError if the pattern is not square.
  void analyse(int n, std::span<const int> column_start, std::span<const int> row_index);

  /// Analyses the pattern of a compressed `A`; its values are passed to `factorise` as {A.valuePtr(), A.nonZeros()}.
  void analyse(const Eigen::SparseMatrix<double>& A);

  /// Factorises the matrix with these values, in the order of the pattern. Returns false if it is singular to working
  /// precision (by its pattern, or with a reciprocal condition estimate below 1e-15, or not a number); then there is no
  /// factor to solve with.
  [[nodiscard]] bool factorise(std::span<const double> values);

  /// Overwrites `columns` right-hand sides, stored one after the other, by the solutions of A x = b.
  /// @pre the last factorise() returned true
  void solve(std::span<double> b, int columns = 1) const;

  /// Overwrites right-hand sides by the solutions of A^T x = b.
  void solve_transposed(std::span<double> b, int columns = 1) const;

  /// Returns the number of rows n of the pattern; 0 before analyse().
  [[nodiscard]] int size() const;
  /// True if there is a factor to solve with.
  [[nodiscard]] bool factorised() const;

  /// Returns the cheap estimate min|U_ii| / max|U_ii| of the reciprocal condition of the last factorisation.
  [[nodiscard]] double reciprocal_condition() const;

  /// Returns the number of factorisations with new pivoting since analyse().
  [[nodiscard]] int pivotings() const;

  /// Saves or restores the pattern and the matrix whose pivot order is being reused, since the order determines the
  /// round-off of every later solution. Restoring factorises this matrix again.
  void persist(Archive& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::solver
