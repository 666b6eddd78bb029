#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hersey::cli {

/// The instants that --instant names: each the nearest to a time or a crank angle, or all of them with `all`;
/// ascending, each once.
/// @param times         of the instants, ascending [s], not empty
/// @param crank_angles  of the same [rad]; empty: the model has no crank
/// @throws InputError naming the option: what is neither, or lies beyond the run
[[nodiscard]] std::vector<std::size_t> named_instants(const std::vector<std::string>& texts,
                                                      const std::vector<double>& times,
                                                      const std::vector<double>& crank_angles);

}  // namespace hersey::cli
