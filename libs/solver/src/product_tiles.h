#pragma once

#include <cstddef>
#include <cstring>

#include "hersey/core/packed.h"
#include "hersey/solver/strided_matrix.h"

/// Kernels of small dense matrices.
namespace hersey::solver {

/// Four numbers of a row: one register with fused instructions, two without.
using Pack = double __attribute__((vector_size(32)));
constexpr int pack_width = 4;

/// Returns the numbers that fill whole packs.
constexpr int padded(int numbers) { return (numbers + pack_width - 1) / pack_width * pack_width; }

HERSEY_KERNEL void load(const double* from, Pack& pack) { std::memcpy(&pack, from, sizeof(Pack)); }
HERSEY_KERNEL void store(const Pack& pack, double* to) { std::memcpy(to, &pack, sizeof(Pack)); }

HERSEY_KERNEL void copy_packs(const double* from, int width, double* to) {
  for (int k = 0; k < width; k += pack_width) {
    Pack pack;
    load(from + k, pack);
    store(pack, to + k);
  }
}

HERSEY_KERNEL void swap_packs(double* a, double* b, int width) {
  for (int k = 0; k < width; k += pack_width) {
    Pack of_a, of_b;
    load(a + k, of_a);
    load(b + k, of_b);
    store(of_b, a + k);
    store(of_a, b + k);
  }
}

// A tile of C stays in registers while the sums run over the inner index.
template <int rows, int packs>
HERSEY_KERNEL void subtract_in_tile(int inner, StridedMatrix A, const double* B, std::ptrdiff_t b_row, double* C,
                                    std::ptrdiff_t c_row) {
  Pack sum[rows][packs], row_of_b[packs];
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < packs; ++j) load(C + i * c_row + j * pack_width, sum[i][j]);
  for (int k = 0; k < inner; ++k) {
    for (int j = 0; j < packs; ++j) load(B + k * b_row + j * pack_width, row_of_b[j]);
    for (int i = 0; i < rows; ++i) {
      const double a = A.data[i * A.row + k * A.column];
      for (int j = 0; j < packs; ++j) sum[i][j] -= a * row_of_b[j];
    }
  }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < packs; ++j) store(sum[i][j], C + i * c_row + j * pack_width);
}

template <int rows>
HERSEY_KERNEL void subtract_in_rows(int columns, int inner, StridedMatrix A, const double* B, std::ptrdiff_t b_row,
                                    double* C, std::ptrdiff_t c_row) {
  int j = 0;
  for (; j + 2 * pack_width <= columns; j += 2 * pack_width)
    subtract_in_tile<rows, 2>(inner, A, B + j, b_row, C + j, c_row);
  if (j + pack_width <= columns) {
    subtract_in_tile<rows, 1>(inner, A, B + j, b_row, C + j, c_row);
    j += pack_width;
  }
  for (; j < columns; ++j) {
    for (int i = 0; i < rows; ++i) {
      double sum = C[i * c_row + j];
      for (int k = 0; k < inner; ++k) sum -= A.data[i * A.row + k * A.column] * B[k * b_row + j];
      C[i * c_row + j] = sum;
    }
  }
}

HERSEY_KERNEL void subtract_by_tiles(int rows, int columns, int inner, StridedMatrix A, const double* B,
                                     std::ptrdiff_t b_row, double* C, std::ptrdiff_t c_row) {
  if (inner <= 0) return;
  int i = 0;
  for (; i + 4 <= rows; i += 4) subtract_in_rows<4>(columns, inner, A.from_row(i), B, b_row, C + i * c_row, c_row);
  if (i + 2 <= rows) {
    subtract_in_rows<2>(columns, inner, A.from_row(i), B, b_row, C + i * c_row, c_row);
    i += 2;
  }
  if (i < rows) subtract_in_rows<1>(columns, inner, A.from_row(i), B, b_row, C + i * c_row, c_row);
}

}  // namespace hersey::solver
