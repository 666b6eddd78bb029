#pragma once

#include <filesystem>

#include "hersey/fem/reduction.h"

namespace hersey::fem {

/// Writes a reduced body as HDF5, every number bit for bit (docs/reduced-body-file.md). The file gets its name once it
/// is complete.
/// @throws std::runtime_error naming the file if it cannot be written.
void write_reduced_body(const std::filesystem::path& path, const ReducedBody& body);

/// Reads a reduced body that `write_reduced_body` or another program wrote in that format.
/// @throws InputError naming file and data set: missing, inconsistent in shape, not finite, matrices that are not
/// symmetric, nodes that do not exist.
[[nodiscard]] ReducedBody read_reduced_body(const std::filesystem::path& path);

}  // namespace hersey::fem
