#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace hersey::bearing {

/// Wear of one surface where asperities slide, by Archard's law (theory manual, wear.1).
struct SurfaceWear {
  double coefficient = 0;  ///< worn depth over contact pressure and sliding distance, k/H [1/Pa], >= 0
  double lining = std::numeric_limits<double>::infinity();  ///< depth that may wear off before the run ends [m], > 0
};

/// Roughness that follows wear: it tends to that of surfaces which have run in (theory manual, wear.5).
struct RunningIn {
  double ratio = 1;  ///< of the roughness in the end to that at the start [-], in (0, 1]
  double depth = 1;  ///< worn off both surfaces where 1/e of the change is still to come [m], > 0
};

/// Where around a moving surface wears.
enum class WearAround {
  even,   ///< evenly: all of its circumference passes the contact, many times while either changes
  local,  ///< place by place in a journal's own axes: a load that turns with it, or a journal that swings
};

/// Wear of both surfaces of a bearing. The fixed one wears node by node.
struct WearModel {
  SurfaceWear fixed, moving;
  WearAround around = WearAround::even;      ///< of the moving one; `local`: a journal
  std::optional<RunningIn> running_in = {};  ///< of their roughness; unset: it stays
  double acceleration = 1;                   ///< times that wear counts, > 0: a cycle stands for as many
  double cycle = 0;  ///< after which loads repeat, for the error of an acceleration [s]; 0: unknown
};

class WearingSurfaces;

/// Moving surface that several films wear, as the journal of a bearing of pads: each film has in its gap what all of
/// them have worn off it. Their grids have the same rows and, where it wears by place, lines at the same distance.
struct CommonSurface {
  std::vector<const WearingSurfaces*> films;  ///< in the order in which they were made, all as long-lived as the others
};

/// Figures of the wear since the start of a run, all of its acceleration included.
struct WearObservation {
  double fixed_depth = 0;                          ///< largest worn depth of the fixed surface [m]
  double fixed_volume = 0;                         ///< worn off it [m^3]
  double moving_depth = 0;                         ///< largest of the moving surface, by all of its films [m]
  double moving_volume = 0;                        ///< worn off it by this film [m^3]
  double roughness_least = 1, roughness_mean = 1;  ///< ratio of roughness to that at the start, over the film [-]
  double rate = 0;                                 ///< volume worn off both per time, without acceleration [m^3/s]
  /// Uncertainty of the worn volume by the acceleration: half of how much the wear of each cycle differs from that of
  /// the one before, over all cycles [m^3] (theory manual, wear.7).
  double acceleration_error = 0;
};

}  // namespace hersey::bearing
