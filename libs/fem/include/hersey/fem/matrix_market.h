#pragma once

#include <Eigen/SparseCore>
#include <filesystem>
#include <string>
#include <string_view>

namespace hersey::fem {

/// Reads a real or integer matrix of NIST's Matrix Market format: coordinate or array, general, symmetric or
/// skew-symmetric; entries that occur twice are summed.
/// @throws InputError with file and line.
/// @see Boisvert, Pozo, Remington (1996), The Matrix Market exchange formats, NISTIR 5935.
[[nodiscard]] Eigen::SparseMatrix<double> read_matrix_market(const std::filesystem::path& path);

/// Reads the matrix from the text of a file called `name` in messages.
[[nodiscard]] Eigen::SparseMatrix<double> parse_matrix_market(std::string_view text, const std::string& name);

}  // namespace hersey::fem
