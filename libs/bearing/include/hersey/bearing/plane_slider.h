#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "hersey/bearing/bearing_kind.h"

namespace hersey::bearing {

// Shapes of a pad's face, by how much they open the gap at (y, z) of a pad of size length x width; y along the sliding
// direction from -length/2, where a runner with positive speed comes in, to length/2. A new one is a struct like these
// and an alternative of PadShape.

/// A ramp at the leading end: from `rise` there to nothing at `length` behind it.
struct PadRamp {
  double rise = 0;    ///< [m], >= 0
  double length = 1;  ///< [m], > 0; at least that of the pad: it goes all the way, and beyond
  /// Opening at (y, z) [m] of a pad of this size [m].
  [[nodiscard]] double opening(double y, double z, double pad_length, double width) const;
};

/// A parabola along the sliding direction, higher in the middle.
struct PadCrown {
  double drop = 0;  ///< at both ends [m]
  /// As a ramp's.
  [[nodiscard]] double opening(double y, double z, double pad_length, double width) const;
};

/// A parabola across the sliding direction, higher in the middle.
struct PadBarrel {
  double drop = 0;  ///< at both sides [m]
  /// As a ramp's.
  [[nodiscard]] double opening(double y, double z, double pad_length, double width) const;
};

using PadShape = std::variant<PadRamp, PadCrown, PadBarrel>;

/// A rectangular pad on a plane runner that slides along the pad's y-axis: a slider bearing, a linear guide's pad. Its
/// film lies on film::Plane with R = 1 m, so that phi is y in metres. The pad's frame has x from the film into the pad.
class PlaneSlider final : public BearingKind {
 public:
  /// @param length  of the pad along the sliding direction [m], > 0
  /// @param shapes  of the pad's face; they add up
  explicit PlaneSlider(double length, std::vector<PadShape> shapes = {});

  [[nodiscard]] std::string name() const override { return "plane_slider"; }
  [[nodiscard]] bool has_axis() const override { return false; }
  [[nodiscard]] std::string fixed_surface() const override { return "pad"; }
  [[nodiscard]] std::string moving_surface() const override { return "runner"; }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& model) const override;
  [[nodiscard]] std::unique_ptr<GapKinematics> gap(const film::FilmModel& model,
                                                   bool moving_surface_deforms) const override;
  [[nodiscard]] std::unique_ptr<SteadyCoordinates> steady_coordinates(const film::FilmModel& model) const override;

  /// Length of the pad [m].
  [[nodiscard]] double length() const { return length_; }
  /// Returns by how much the shapes open the gap at the nodes [m], shape (grid.size()).
  [[nodiscard]] Eigen::VectorXd opening(const film::FilmModel& model) const;

 private:
  double length_;
  std::vector<PadShape> shapes_;
};

/// Returns a grid for such a pad.
/// @param lines,rows  nodes along and across the sliding direction, those on the borders included
[[nodiscard]] film::Grid slider_grid(double length, int lines, int rows);

}  // namespace hersey::bearing
