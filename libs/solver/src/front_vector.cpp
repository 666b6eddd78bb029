// One right-hand side by itself: sums run along the rows of a front, four rows at once.
#include "dense_front.h"
#include "product_tiles.h"

namespace hersey::solver {
namespace {

HERSEY_KERNEL double sum_of(const Pack& pack) { return (pack[0] + pack[2]) + (pack[1] + pack[3]); }

// y -= A x for rows of whole packs.
template <int rows>
HERSEY_KERNEL void subtract_row_products(int columns, const double* A, std::ptrdiff_t row, const double* x, double* y) {
  Pack sums[rows] = {}, of_x{}, of_a{};
  for (int k = 0; k < columns; k += pack_width) {
    load(x + k, of_x);
    for (int i = 0; i < rows; ++i) {
      load(A + i * row + k, of_a);
      sums[i] += of_a * of_x;
    }
  }
  for (int i = 0; i < rows; ++i) y[i] -= sum_of(sums[i]);
}

HERSEY_KERNEL void subtract_products(int rows, int columns, const double* A, std::ptrdiff_t row, const double* x,
                                     double* y) {
  int i = 0;
  for (; i + 4 <= rows; i += 4) subtract_row_products<4>(columns, A + i * row, row, x, y + i);
  for (; i < rows; ++i) subtract_row_products<1>(columns, A + i * row, row, x, y + i);
}

HERSEY_KERNEL void vector_down(const DenseFront& front, const FrontVector& b) {
  const int own_columns = padded(front.own), columns = own_columns + padded(front.outside);
  for (int i = 0; i < front.own; ++i) {
    const double last = b.own[i];
    b.own[i] = b.own[front.pivots[i]];
    b.own[front.pivots[i]] = last;
  }
  for (int begin = 0; begin < front.own; begin += pack_width) {
    const int end = begin + pack_width < front.own ? begin + pack_width : front.own;
    const double* const block = front.upper + static_cast<std::ptrdiff_t>(begin) * columns;
    subtract_products(end - begin, begin, block, columns, b.own, b.own + begin);
    for (int i = begin + 1; i < end; ++i)
      for (int k = begin; k < i; ++k) b.own[i] -= front.upper[static_cast<std::ptrdiff_t>(i) * columns + k] * b.own[k];
  }
  subtract_products(front.outside, own_columns, front.lower, own_columns, b.own, b.border);
}

HERSEY_KERNEL void vector_up(const DenseFront& front, const FrontVector& b) {
  const int own_columns = padded(front.own), beyond = padded(front.outside), columns = own_columns + beyond;
  subtract_products(front.own, beyond, front.upper + own_columns, columns, b.border, b.own);
  for (int stop = own_columns; stop > 0; stop -= pack_width) {
    const int begin = stop - pack_width, end = stop < front.own ? stop : front.own;
    const double* const block = front.upper + static_cast<std::ptrdiff_t>(begin) * columns;
    subtract_products(end - begin, own_columns - stop, block + stop, columns, b.own + stop, b.own + begin);
    for (int i = end - 1; i >= begin; --i) {
      const double* const row = front.upper + static_cast<std::ptrdiff_t>(i) * columns;
      for (int k = i + 1; k < end; ++k) b.own[i] -= row[k] * b.own[k];
      b.own[i] /= row[i];
    }
  }
}

HERSEY_FUSED void vector_down_fused(const DenseFront& front, const FrontVector& b) { vector_down(front, b); }
HERSEY_FUSED void vector_up_fused(const DenseFront& front, const FrontVector& b) { vector_up(front, b); }

}  // namespace

void solve_down(const DenseFront& front, const FrontVector& vector) {
  has_fused_instructions() ? vector_down_fused(front, vector) : vector_down(front, vector);
}

void solve_up(const DenseFront& front, const FrontVector& vector) {
  has_fused_instructions() ? vector_up_fused(front, vector) : vector_up(front, vector);
}

}  // namespace hersey::solver
