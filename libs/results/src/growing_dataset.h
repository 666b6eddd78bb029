#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hdf5_handle.h"

namespace hersey::results {

/// Of a number as it is stored.
enum class NumberSize { four_bytes, eight_bytes };

/// A dataset of a results file that gets rows.
///
/// Its chunks are written to the file whole, in their final form: HDF5 then need not find out to which part of which
/// chunk a row belongs, nor cache any of them. With thousands of series that is most of the cost of rows.
class GrowingDataset {
 public:
  /// Number of rows in a chunk. Chunks of datasets with many rows are larger, because making a chunk costs more than
  /// filling it.
  /// @param width  numbers per row
  /// @param expected  final number of rows, as far as it is known
  [[nodiscard]] static std::size_t chunk_rows(std::size_t width, std::size_t expected);
  /// Number of rows in a chunk for rows of up to four numbers, the usual case: the same for all, so that their chunks
  /// fill at the same step.
  [[nodiscard]] static std::size_t narrow_chunk_rows(std::size_t expected) { return chunk_rows(1, expected); }

  /// @param dataset  chunked, of `chunk_rows` rows each, with no row yet
  /// @param row_shape  of a row; empty: one number
  GrowingDataset(std::string name, Handle dataset, const std::vector<hsize_t>& row_shape, std::size_t chunk_rows,
                 NumberSize size);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::size_t rows() const { return shape_.front(); }
  [[nodiscard]] std::size_t width() const { return width_; }

  /// Adds rows, one after the other; they are safe only after H5Fflush. @returns false where HDF5 fails
  [[nodiscard]] bool add(std::span<const double> rows);

 private:
  bool write_chunk(std::span<const double> rows);
  template <class Number>
  bool write_chunk_of(std::span<const double> rows);

  std::string name_;
  Handle dataset_;
  std::vector<hsize_t> shape_;
  std::size_t width_, chunk_numbers_;
  NumberSize size_;
  hsize_t next_chunk_ = 0;     // its first row
  std::vector<double> begun_;  // rows of the last chunk, while it is not full
};

}  // namespace hersey::results
