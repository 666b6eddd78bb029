#pragma once

#include <cstddef>

namespace hersey::solver {

/// A dense matrix whose own unknowns are eliminated, those of its border not: [A11 A12; A21 A22] becomes [L\U U12; L21
/// A22 - L21 U12] with P A11 = L U. Pivots are chosen among the own rows.
///
/// Rows are padded with zeros to whole packs: A11 and A12 are side by side, A12 from column padded(own).
struct DenseFront {
  int own = 0, outside = 0;      ///< unknowns of its own and of the border
  double* upper = nullptr;       ///< A11 and A12
  double* lower = nullptr;       ///< A21
  double* complement = nullptr;  ///< A22
  int* pivots = nullptr;         ///< of each own row, the row that changed places with it, shape (own)

  [[nodiscard]] int own_columns() const;                                           ///< padded
  [[nodiscard]] int outside_columns() const;                                       ///< padded
  [[nodiscard]] int columns() const { return own_columns() + outside_columns(); }  ///< of `upper`

  /// Returns false if a pivot is zero or no number.
  [[nodiscard]] bool eliminate() const;
};

/// Right-hand sides of a front that stand side by side, `width` numbers a row, whole packs.
struct FrontSides {
  double* own = nullptr;     ///< rows of the front's own unknowns
  double* border = nullptr;  ///< rows of its border
  int width = 0;
};

/// One front's part in a solution with A, on the way down the fronts and on the way up, and with A^T.
void solve_down(const DenseFront& front, const FrontSides& sides);
void solve_up(const DenseFront& front, const FrontSides& sides);
void solve_down_transposed(const DenseFront& front, const FrontSides& sides);
void solve_up_transposed(const DenseFront& front, const FrontSides& sides);

/// One right-hand side of a front. Behind `own` and `border` finite numbers follow, up to whole packs.
struct FrontVector {
  double* own = nullptr;     ///< of the front's own unknowns
  double* border = nullptr;  ///< of its border
};

/// The same parts in a solution with A.
void solve_down(const DenseFront& front, const FrontVector& vector);
void solve_up(const DenseFront& front, const FrontVector& vector);

}  // namespace hersey::solver
