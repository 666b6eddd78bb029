#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hersey/core/spatial.h"
#include "hersey/results/reader.h"

namespace hersey::run {

/// Returns a row of three numbers of a series.
[[nodiscard]] Vector3 vector_at(const results::Reader& results, const std::string& path, std::size_t row);

/// Returns the axes of a body in ground at a row of the series; of ground its own.
[[nodiscard]] Matrix3 orientation_at(const results::Reader& results, const std::string& body, std::size_t row);

/// Returns the origin of a body in ground [m] at a row of the series; of ground its own.
[[nodiscard]] Vector3 origin_at(const results::Reader& results, const std::string& body, std::size_t row);

/// Returns the row of the one of ascending times that is nearest; fields are stored in rows of their own.
[[nodiscard]] std::size_t row_at(const std::vector<double>& times, double time);

}  // namespace hersey::run
