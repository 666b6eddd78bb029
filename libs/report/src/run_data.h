#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hersey/results/reader.h"

namespace hersey::report {

/// Limits of the data that the page takes from one results file.
struct Budget {
  std::size_t series_rows;   ///< most rows of the time series, > 0
  std::size_t field_bytes;   ///< most bytes of all fields together; at least one instant is kept
  std::size_t series_bytes;  ///< most bytes of all time series together; at least a hundred rows are kept
};

/// One results file as the page reads it (web/src/data.ts): attributes and datasets by path, numbers in base64.
/// Thinning keeps every k-th row counted from the last one, so that the end of the run is always shown.
[[nodiscard]] nlohmann::json run_data(const results::Reader& reader, const Budget& budget);

/// The fields of one film with all instants that fit into `budget` bytes of all films, datasets by path as in run_data.
[[nodiscard]] nlohmann::json film_fields(const results::Reader& reader, const std::string& bearing, std::size_t budget);

}  // namespace hersey::report
