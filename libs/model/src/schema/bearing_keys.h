#pragma once

#include <string>
#include <vector>

#include "schema/format.h"

namespace hersey::model {

/// Keys of the two surfaces of a kind of bearing, with a sentence on each.
struct SurfaceKeys {
  std::string fixed = "shell", of_fixed = "The bore.";
  std::string moving = "journal", of_moving = "The journal.";
};

/// A pressure.
[[nodiscard]] TypePtr bearing_pressure();
/// Pressure outside an edge of the film, or a wall there.
[[nodiscard]] TypePtr edge_format();
/// A seal at an edge of the film, through which oil leaks.
[[nodiscard]] TypePtr seal_format();

/// Model of the temperature of a film between pads and a runner.
[[nodiscard]] TypePtr flat_thermal_format(const SurfaceKeys& surfaces);

/// Keys that every kind of bearing has.
[[nodiscard]] std::vector<Key> shared_bearing_keys();
/// Keys of every kind that name its surfaces: roughness and materials.
[[nodiscard]] std::vector<Key> surface_keys(const SurfaceKeys& surfaces);

/// How one kind of bearing is written. A new kind is a line in bearing_kind_formats().
struct BearingKindFormat {
  std::string tag, title, description;
  SurfaceKeys surfaces;
  std::vector<Key> keys;
};
/// All kinds, the default one first.
[[nodiscard]] const std::vector<BearingKindFormat>& bearing_kind_formats();

// Keys of the kinds, one file each in schema/kinds.
[[nodiscard]] std::vector<Key> journal_keys();
[[nodiscard]] std::vector<Key> plane_slider_keys();
[[nodiscard]] std::vector<Key> tilting_pad_keys();
[[nodiscard]] std::vector<Key> tilting_pad_thrust_keys();
[[nodiscard]] std::vector<Key> floating_ring_keys();
[[nodiscard]] std::vector<Key> thrust_keys();
[[nodiscard]] std::vector<Key> squeeze_film_damper_keys();
[[nodiscard]] std::vector<Key> skirt_keys();

/// Keys of what pads that tilt stand on. @param common  those that every pivot has
[[nodiscard]] TypePtr pivot_format(const std::vector<Key>& common);
/// Operating point of a journal in a bearing of several parts.
/// @param clearance  over which positions are given, "the assembled clearance"
/// @param parts  that follow the journal, "pads"
[[nodiscard]] TypePtr composite_point_format(const std::string& clearance, const std::string& parts);
/// True for a key of a bearing of tilting pads, of such a kind, that belongs to the film of each pad.
[[nodiscard]] bool is_key_of_each_pad(const std::string& kind, const std::string& key);

}  // namespace hersey::model
