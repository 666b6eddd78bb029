#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Nodes of a thermal network that a film's heat depends on; unset: none. Their order is that of WallHeatFlow: shell
/// and journal, which always have an index, then those of the others that exist.
struct FilmTerminals {
  std::optional<std::size_t> shell, journal;  ///< walls
  std::optional<std::size_t> ambient;         ///< surroundings of a ring
  std::optional<std::size_t> drain;           ///< that the oil drains to
  std::vector<std::size_t> oil = {};          ///< that oil comes from, each once

  /// True if there is one.
  [[nodiscard]] bool has_any() const { return shell || journal || outside() > 0; }
  /// Number of nodes that are no walls.
  [[nodiscard]] Eigen::Index outside() const {
    return (ambient ? 1 : 0) + (drain ? 1 : 0) + static_cast<Eigen::Index>(oil.size());
  }
  /// Index of the ambient among the nodes that are no walls; -1: not among them.
  [[nodiscard]] Eigen::Index index_of_ambient() const { return ambient ? 0 : -1; }
  /// Index of the drain among the nodes that are no walls; -1: not among them.
  [[nodiscard]] Eigen::Index index_of_drain() const { return drain ? (ambient ? 1 : 0) : -1; }
  /// Index of a node that oil comes from among the nodes that are no walls; -1: not among them.
  [[nodiscard]] Eigen::Index index_of_oil(const std::optional<NetworkNode>& from) const;
  /// Returns each index in WallHeatFlow with its node.
  [[nodiscard]] std::vector<std::pair<Eigen::Index, Eigen::Index>> nodes() const;
};

/// Returns the terminals of a film.
[[nodiscard]] FilmTerminals terminals_of(const ThermalModel& thermal);

/// Returns the initial temperatures of the terminals that are no walls [K].
[[nodiscard]] Eigen::VectorXd outside_at_start(const ThermalModel& thermal);

}  // namespace hersey::film
