#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "hersey/film/thermal_model.h"

namespace hersey::film {

/// Which nodes of a network a film's heat depends on; unset: none. Their order is that of WallExchange: shell and
/// journal, which are always there, then what there is of the others.
struct FilmTerminals {
  std::optional<std::size_t> shell, journal;  ///< walls
  std::optional<std::size_t> ambient;         ///< surroundings of a ring
  std::optional<std::size_t> drain;           ///< where the oil goes that leaves
  std::vector<std::size_t> oil = {};          ///< where oil comes from, each once

  /// Whether there is one.
  [[nodiscard]] bool has_any() const { return shell || journal || outside() > 0; }
  /// Those that are no walls.
  [[nodiscard]] Eigen::Index outside() const {
    return (ambient ? 1 : 0) + (drain ? 1 : 0) + static_cast<Eigen::Index>(oil.size());
  }
  /// Places among those; -1: it is none of them.
  [[nodiscard]] Eigen::Index place_of_ambient() const { return ambient ? 0 : -1; }
  [[nodiscard]] Eigen::Index place_of_drain() const { return drain ? (ambient ? 1 : 0) : -1; }
  /// Likewise of the node that oil comes from.
  [[nodiscard]] Eigen::Index place_of_oil(const std::optional<NetworkNode>& from) const;
  /// Place in WallExchange and the node.
  [[nodiscard]] std::vector<std::pair<Eigen::Index, Eigen::Index>> nodes() const;
};

/// Of a film.
[[nodiscard]] FilmTerminals terminals_of(const ThermalModel& thermal);

/// Temperatures at the start of those of them that are no walls [K].
[[nodiscard]] Eigen::VectorXd outside_at_start(const ThermalModel& thermal);

}  // namespace hersey::film
