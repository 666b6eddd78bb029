#include "hersey/fem/matrix_market.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/core/input_file.h"
#include "mesh/mesh_text.h"

namespace hersey::fem {
namespace {

class MatrixMarketReader {
 public:
  MatrixMarketReader(std::string_view text, const std::string& name) : lines_(text), name_(name) {}

  Eigen::SparseMatrix<double> read() {
    read_header();
    std::array<long, 3> sizes{};
    const std::size_t needed = is_coordinate_ ? 3 : 2;
    next_line();
    for (std::size_t k = 0; k < needed; ++k) sizes[k] = size(word());
    if (is_symmetric_ && sizes[0] != sizes[1]) fail("a symmetric matrix that is not square", "as many rows as columns");
    is_coordinate_ ? read_entries(sizes) : read_columns(sizes);
    Eigen::SparseMatrix<double> matrix(sizes[0], sizes[1]);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
  }

 private:
  [[noreturn]] void fail(std::string found, std::string expected) const {
    throw InputError(Fault{{name_, lines_.number(), 0}, "", std::move(found), std::move(expected), ""});
  }

  void read_header() {
    std::string_view line;
    (void)lines_.next(line);
    std::string header(line);
    std::transform(header.begin(), header.end(), header.begin(), [](unsigned char c) { return std::tolower(c); });
    rest_ = header;
    const bool is_matrix = word() == "%%matrixmarket" && word() == "matrix";
    const std::string_view format = word(), field = word(), symmetry = word();
    is_coordinate_ = format == "coordinate";
    is_symmetric_ = symmetry == "symmetric" || symmetry == "skew-symmetric";
    sign_ = symmetry == "skew-symmetric" ? -1 : 1;
    const bool is_known = is_matrix && (is_coordinate_ || format == "array") &&
                          (field == "real" || field == "integer" || field == "double") &&
                          (is_symmetric_ || symmetry == "general");
    if (!is_known)
      fail(fmt::format("'{}'", line.substr(0, 80)), "%%MatrixMarket matrix coordinate|array real general|symmetric");
  }

  // The next line that is neither comment nor empty.
  void next_line() {
    do {
      if (!lines_.next(rest_)) fail("the end of the file", "more entries: the file is cut short");
      rest_ = trimmed(rest_);
    } while (rest_.empty() || rest_.front() == '%');
  }

  std::string_view word() {
    rest_ = trimmed(rest_);
    const std::size_t end = std::min(rest_.find_first_of(" \t"), rest_.size());
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return result;
  }

  long size(std::string_view text) const {
    long value = 0;
    if (!parse_integer(text, value) || value < 0 || value > std::numeric_limits<int>::max())
      fail(fmt::format("'{}'", text.substr(0, 20)), "a number of rows, columns or entries");
    return value;
  }

  int index(long limit) {
    const std::string_view text = word();
    long value = 0;
    if (!parse_integer(text, value) || value < 1 || value > limit)
      fail(fmt::format("index '{}'", text.substr(0, 20)), fmt::format("1 to {}", limit));
    return static_cast<int>(value - 1);
  }

  double number() {
    const std::string_view text = word();
    double value = 0;
    if (!parse_number(text, value)) fail(fmt::format("'{}'", text.substr(0, 20)), "a number");
    return value;
  }

  void add(int row, int column, double value) {
    entries_.emplace_back(row, column, value);
    if (is_symmetric_ && row != column) entries_.emplace_back(column, row, sign_ * value);
  }

  void read_entries(const std::array<long, 3>& sizes) {
    for (long k = 0; k < sizes[2]; ++k) {
      next_line();
      const int row = index(sizes[0]), column = index(sizes[1]);
      add(row, column, number());
    }
  }

  // Column by column; of a symmetric matrix from the diagonal (skew: below it) downwards.
  void read_columns(const std::array<long, 3>& sizes) {
    for (int column = 0; column < sizes[1]; ++column) {
      const int first = !is_symmetric_ ? 0 : sign_ < 0 ? column + 1 : column;
      for (int row = first; row < sizes[0]; ++row) {
        next_line();
        add(row, column, number());
      }
    }
  }

  LineScanner lines_;
  std::string name_;
  std::string_view rest_;
  bool is_coordinate_ = false, is_symmetric_ = false;
  double sign_ = 1;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

Eigen::SparseMatrix<double> read_matrix_market(const std::filesystem::path& path) {
  const InputFile file = read_input_file(path);
  if (!file.fault.empty())
    throw InputError(Fault{{path.string(), 0, 0}, "", file.fault, "a Matrix Market file", "check its path"});
  return parse_matrix_market(file.content, path.string());
}

Eigen::SparseMatrix<double> parse_matrix_market(std::string_view text, const std::string& name) {
  return MatrixMarketReader(text, name).read();
}

}  // namespace hersey::fem
