#include "hersey/solver/subtract_product.h"

#include "product_tiles.h"

namespace hersey::solver {
namespace {

HERSEY_FUSED void subtract_fused(int rows, int columns, int inner, StridedMatrix A, const double* B,
                                 std::ptrdiff_t b_row, double* C, std::ptrdiff_t c_row) {
  subtract_by_tiles(rows, columns, inner, A, B, b_row, C, c_row);
}

}  // namespace

void subtract_product(int rows, int columns, int inner, StridedMatrix A, const double* B, std::ptrdiff_t b_row,
                      double* C, std::ptrdiff_t c_row) {
  if (has_fused_instructions()) return subtract_fused(rows, columns, inner, A, B, b_row, C, c_row);
  subtract_by_tiles(rows, columns, inner, A, B, b_row, C, c_row);
}

}  // namespace hersey::solver
