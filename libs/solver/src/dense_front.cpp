#include "dense_front.h"

#include <algorithm>
#include <cmath>

#include "product_tiles.h"

namespace hersey::solver {
namespace {

// So many columns are eliminated before their product is subtracted from the columns beyond.
constexpr int panel_columns = 16;

HERSEY_KERNEL bool bring_pivot(const DenseFront& front, int columns, int k) {
  double* const row = front.upper + static_cast<std::ptrdiff_t>(k) * columns;
  double* best = row;
  front.pivots[k] = k;
  for (int i = k + 1; i < front.own; ++i) {
    double* const other = front.upper + static_cast<std::ptrdiff_t>(i) * columns;
    if (std::abs(other[k]) > std::abs(best[k])) best = other, front.pivots[k] = i;
  }
  if (best != row) swap_packs(row, best, columns);
  return row[k] != 0 && std::isfinite(row[k]);
}

// Eliminates the columns of one pack from the rows below.
HERSEY_KERNEL bool eliminate_pack(const DenseFront& front, int columns, int first, int end) {
  for (int k = first; k < end; ++k) {
    if (!bring_pivot(front, columns, k)) return false;
    const double* pivot_row = front.upper + static_cast<std::ptrdiff_t>(k) * columns;
    const double by_pivot = 1 / pivot_row[k];
    Pack beyond{};
    for (int j = k + 1; j < first + pack_width; ++j) beyond[j - first] = pivot_row[j];
    for (int i = k + 1; i < front.own; ++i) {
      double* row = front.upper + static_cast<std::ptrdiff_t>(i) * columns;
      const double l = row[k] * by_pivot;
      Pack pack;
      load(row + first, pack);
      pack -= l * beyond;
      store(pack, row + first);
      row[k] = l;
    }
  }
  return true;
}

// Solves with the unit lower triangle of rows first..end for some columns of these rows.
HERSEY_KERNEL void solve_rows(const DenseFront& front, int columns, int first, int end, int column, int stop) {
  const double* const above = front.upper + static_cast<std::ptrdiff_t>(first) * columns;
  for (int i = first + 1; i < end; ++i) {
    double* const row = front.upper + static_cast<std::ptrdiff_t>(i) * columns;
    subtract_in_rows<1>(stop - column, i - first, {row + first, columns}, above + column, columns, row + column,
                        columns);
  }
}

// Subtracts from rows and columns beyond what eliminated rows first..end contribute.
HERSEY_KERNEL void update(const DenseFront& front, int columns, int first, int end, int column, int stop) {
  solve_rows(front, columns, first, end, column, stop);
  double* const row = front.upper + static_cast<std::ptrdiff_t>(end) * columns;
  subtract_by_tiles(front.own - end, stop - column, end - first, {row + first, columns},
                    front.upper + static_cast<std::ptrdiff_t>(first) * columns + column, columns, row + column,
                    columns);
}

HERSEY_KERNEL bool eliminate_own(const DenseFront& front, int columns, int own_columns) {
  for (int panel = 0; panel < front.own; panel += panel_columns) {
    const int panel_end = std::min(panel + panel_columns, front.own);
    const int panel_stop = std::min(panel + panel_columns, own_columns);
    for (int first = panel; first < panel_end; first += pack_width) {
      const int end = std::min(first + pack_width, panel_end);
      if (!eliminate_pack(front, columns, first, end)) return false;
      if (first + pack_width < panel_stop) update(front, columns, first, end, first + pack_width, panel_stop);
    }
    update(front, columns, panel, panel_end, panel_stop, columns);
  }
  return true;
}

// L21 = A21 U11^-1, a pack of columns after the other.
HERSEY_KERNEL void divide_lower(const DenseFront& front, int columns, int own_columns) {
  for (int first = 0; first < front.own; first += pack_width) {
    const int many = std::min(pack_width, front.own - first);
    subtract_by_tiles(front.outside, pack_width, first, {front.lower, own_columns}, front.upper + first, columns,
                      front.lower + first, own_columns);
    Pack beyond[pack_width];
    double by_pivot[pack_width];
    for (int k = 0; k < pack_width; ++k) {
      beyond[k] = Pack{};
      by_pivot[k] = 0;
      if (k >= many) continue;
      const double* row = front.upper + static_cast<std::ptrdiff_t>(first + k) * columns + first;
      by_pivot[k] = 1 / row[k];
      for (int j = k + 1; j < many; ++j) beyond[k][j] = row[j];
    }
    for (int i = 0; i < front.outside; ++i) {
      double* at = front.lower + static_cast<std::ptrdiff_t>(i) * own_columns + first;
      Pack row, answer{};
      load(at, row);
      for (int k = 0; k < pack_width; ++k) {
        const double l = row[k] * by_pivot[k];
        row -= l * beyond[k];
        answer[k] = l;
      }
      store(answer, at);
    }
  }
}

HERSEY_KERNEL bool eliminate_front(const DenseFront& front) {
  const int own_columns = padded(front.own), beyond = padded(front.outside), columns = own_columns + beyond;
  if (!eliminate_own(front, columns, own_columns)) return false;
  divide_lower(front, columns, own_columns);
  subtract_by_tiles(front.outside, beyond, front.own, {front.lower, own_columns}, front.upper + own_columns, columns,
                    front.complement, beyond);
  return true;
}

HERSEY_FUSED bool eliminate_fused(const DenseFront& front) { return eliminate_front(front); }

HERSEY_KERNEL void divide(double* row, double by, int width) {
  for (int k = 0; k < width; k += pack_width) {
    Pack pack;
    load(row + k, pack);
    pack *= by;
    store(pack, row + k);
  }
}

enum class Diagonal { unit, stored };

// Rows of a triangle are solved in groups of so many, whose sums do not wait for one another.
constexpr int rows_at_once = 4;

HERSEY_KERNEL void solve_lower_triangle(int n, StridedMatrix T, Diagonal diagonal, double* b, int width) {
  for (int begin = 0; begin < n; begin += rows_at_once) {
    const int end = std::min(begin + rows_at_once, n);
    double* const first = b + begin * width;
    subtract_by_tiles(end - begin, width, begin, T.from_row(begin), b, width, first, width);
    for (int i = begin; i < end; ++i) {
      const StridedMatrix row = T.from(i, begin);
      subtract_in_rows<1>(width, i - begin, row, first, width, b + i * width, width);
      if (diagonal == Diagonal::stored) divide(b + i * width, 1 / *T.from(i, i).data, width);
    }
  }
}

HERSEY_KERNEL void solve_upper_triangle(int n, StridedMatrix T, Diagonal diagonal, double* b, int width) {
  for (int end = n; end > 0; end -= rows_at_once) {
    const int begin = std::max(end - rows_at_once, 0);
    subtract_by_tiles(end - begin, width, n - end, T.from(begin, end), b + end * width, width, b + begin * width,
                      width);
    for (int i = end - 1; i >= begin; --i) {
      double* const at = b + i * width;
      subtract_in_rows<1>(width, end - 1 - i, T.from(i, i + 1), at + width, width, at, width);
      if (diagonal == Diagonal::stored) divide(at, 1 / *T.from(i, i).data, width);
    }
  }
}

HERSEY_KERNEL void down(const DenseFront& front, const FrontSides& b) {
  const int own_columns = padded(front.own), columns = own_columns + padded(front.outside), width = b.width;
  for (int i = 0; i < front.own; ++i)
    if (front.pivots[i] != i) swap_packs(b.own + i * width, b.own + front.pivots[i] * width, width);
  solve_lower_triangle(front.own, {front.upper, columns}, Diagonal::unit, b.own, width);
  subtract_by_tiles(front.outside, width, front.own, {front.lower, own_columns}, b.own, width, b.border, width);
}

HERSEY_KERNEL void up(const DenseFront& front, const FrontSides& b) {
  const int own_columns = padded(front.own), columns = own_columns + padded(front.outside), width = b.width;
  subtract_by_tiles(front.own, width, front.outside, {front.upper + own_columns, columns}, b.border, width, b.own,
                    width);
  solve_upper_triangle(front.own, {front.upper, columns}, Diagonal::stored, b.own, width);
}

HERSEY_KERNEL void down_transposed(const DenseFront& front, const FrontSides& b) {
  const int own_columns = padded(front.own), columns = own_columns + padded(front.outside), width = b.width;
  solve_lower_triangle(front.own, {front.upper, 1, columns}, Diagonal::stored, b.own, width);
  subtract_by_tiles(front.outside, width, front.own, {front.upper + own_columns, 1, columns}, b.own, width, b.border,
                    width);
}

HERSEY_KERNEL void up_transposed(const DenseFront& front, const FrontSides& b) {
  const int own_columns = padded(front.own), columns = own_columns + padded(front.outside), width = b.width;
  subtract_by_tiles(front.own, width, front.outside, {front.lower, 1, own_columns}, b.border, width, b.own, width);
  solve_upper_triangle(front.own, {front.upper, 1, columns}, Diagonal::unit, b.own, width);
  for (int i = front.own - 1; i >= 0; --i)
    if (front.pivots[i] != i) swap_packs(b.own + i * width, b.own + front.pivots[i] * width, width);
}

HERSEY_FUSED void down_fused(const DenseFront& front, const FrontSides& b) { down(front, b); }
HERSEY_FUSED void up_fused(const DenseFront& front, const FrontSides& b) { up(front, b); }
HERSEY_FUSED void down_transposed_fused(const DenseFront& front, const FrontSides& b) { down_transposed(front, b); }
HERSEY_FUSED void up_transposed_fused(const DenseFront& front, const FrontSides& b) { up_transposed(front, b); }

}  // namespace

int DenseFront::own_columns() const { return padded(own); }
int DenseFront::outside_columns() const { return padded(outside); }

bool DenseFront::eliminate() const {
  return has_fused_instructions() ? eliminate_fused(*this) : eliminate_front(*this);
}

void solve_down(const DenseFront& front, const FrontSides& sides) {
  has_fused_instructions() ? down_fused(front, sides) : down(front, sides);
}

void solve_up(const DenseFront& front, const FrontSides& sides) {
  has_fused_instructions() ? up_fused(front, sides) : up(front, sides);
}

void solve_down_transposed(const DenseFront& front, const FrontSides& sides) {
  has_fused_instructions() ? down_transposed_fused(front, sides) : down_transposed(front, sides);
}

void solve_up_transposed(const DenseFront& front, const FrontSides& sides) {
  has_fused_instructions() ? up_transposed_fused(front, sides) : up_transposed(front, sides);
}

}  // namespace hersey::solver
