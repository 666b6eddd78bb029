#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hersey/results/error.h"

namespace hersey::results {

/// Description of a dataset, without its numbers.
struct DatasetInfo {
  std::vector<std::size_t> shape;
  bool grows = false;       ///< one entry of the first dimension per stored instant
  bool is_text = false;     ///< names of a dimension, not numbers
  bool is_float32 = false;  ///< numbers are stored in four bytes
  std::string unit;
  std::string description;
};

/// A dataset of numbers, row-major.
struct Array {
  DatasetInfo info;
  std::vector<double> values;
  /// Numbers per entry of the first dimension; 1 for a plain series.
  [[nodiscard]] std::size_t width() const;
};

/// Reads a results file: finished, still growing, or left behind by a killed program.
///
/// A program killed in the middle of a flush may leave the last rows in some series and not in others. The reader
/// counts only the rows that every non-empty growing dataset has, and the same apart for each group named `fields`.
/// @verified_by writer_test.cpp, crash_test.cpp
class Reader {
 public:
  /// @throws ReadError if the file is missing, not HDF5, or not a results file this version understands.
  explicit Reader(std::filesystem::path path);
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader();

  [[nodiscard]] bool has(std::string_view path) const;                            ///< a group or dataset
  [[nodiscard]] const std::vector<std::string>& groups() const;                   ///< paths of all groups, "/" first
  [[nodiscard]] const std::vector<std::string>& datasets() const;                 ///< paths of all datasets, sorted
  [[nodiscard]] std::vector<std::string> children(std::string_view group) const;  ///< sorted; empty without the group
  [[nodiscard]] std::vector<std::string> attributes(std::string_view object) const;  ///< names, sorted

  /// Attribute of that name and kind, if there is one.
  [[nodiscard]] std::optional<std::string> text_attribute(std::string_view object, std::string_view name) const;
  /// Returns an attribute that is a number.
  [[nodiscard]] std::optional<double> number_attribute(std::string_view object, std::string_view name) const;
  /// Returns an attribute that is a list of texts; empty if there is none.
  [[nodiscard]] std::vector<std::string> list_attribute(std::string_view object, std::string_view name) const;

  /// Returns the description of a dataset.
  /// @throws ReadError if there is none; the members below also if it is of another kind
  [[nodiscard]] DatasetInfo info(std::string_view path) const;
  /// All numbers of a dataset.
  [[nodiscard]] Array read(std::string_view path) const;
  /// Rows first, first + stride, ... of a dataset; one row is one entry of its first dimension.
  [[nodiscard]] Array read_rows(std::string_view path, std::size_t first, std::size_t count,
                                std::size_t stride = 1) const;
  /// Returns the paths of the dimensions of a dataset, the slowest first; of a dimension its own first path, and none
  /// where the file names none.
  [[nodiscard]] std::vector<std::string> dimensions(std::string_view path) const;
  /// Returns all strings of a dataset, row-major.
  [[nodiscard]] std::vector<std::string> texts(std::string_view path) const;
  /// The one string of a dataset, such as the model's text.
  [[nodiscard]] std::string text(std::string_view path) const;
  /// Pairs of a dataset [n, 2] of strings, such as the assumptions.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> text_table(std::string_view path) const;

  [[nodiscard]] std::size_t rows() const;  ///< rows of the time series
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::results
