#pragma once

#include <cstddef>

#include "hersey/solver/strided_matrix.h"

namespace hersey::solver {

/// Subtracts the product A B of small dense matrices from C. Use it where many such products are too small for BLAS,
/// which spends more on each call than on the numbers.
///
/// Rows of B and C are contiguous. The instructions are chosen at run time (AVX2 with FMA where the processor has
/// them), so that sums differ by round-off from one kind of processor to another; on one machine they are always the
/// same.
/// @param rows, columns, inner  C has the shape (rows, columns), A (rows, inner), B (inner, columns)
/// @param b_row, c_row  distance between rows of B and of C
/// @pre C overlaps neither A nor B
void subtract_product(int rows, int columns, int inner, StridedMatrix A, const double* B, std::ptrdiff_t b_row,
                      double* C, std::ptrdiff_t c_row);

}  // namespace hersey::solver
