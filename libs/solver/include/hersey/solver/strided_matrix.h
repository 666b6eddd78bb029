#pragma once

#include <cstddef>

namespace hersey::solver {

/// A dense matrix inside an array: element (i, j) stands at data[i * row + j * column].
struct StridedMatrix {
  const double* data = nullptr;
  std::ptrdiff_t row = 0, column = 1;

  /// Returns the matrix from row i on.
  [[nodiscard]] StridedMatrix from_row(int i) const { return {data + i * row, row, column}; }
  /// Returns the matrix from row i and column j on.
  [[nodiscard]] StridedMatrix from(int i, int j) const { return {data + i * row + j * column, row, column}; }
};

}  // namespace hersey::solver
