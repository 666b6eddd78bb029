#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hersey/bearing/bearing_kind.h"

namespace hersey::bearing {

/// A place on a sector-shaped pad, as its shapes see it.
struct SectorPoint {
  double theta = 0;  ///< angle from the leading edge, in the sense of rotation that the pads are made for [rad]
  double arc = 1;    ///< of the whole pad [rad]
  double r = 0;      ///< [m]
  double inner = 0, outer = 1;  ///< radii of the pad's edges [m]
};

// Shapes of pads in sectors of an annulus, by how much they open the gap (theory manual, thrust.5). A new one is a
// struct like these and an alternative of SectorShape.

/// A ramp from `rise` at the leading edge to nothing at the angle `arc` behind it, the same at every radius.
struct SectorRamp {
  double rise = 0;  ///< [m], >= 0
  double arc = 1;   ///< [rad], > 0; at least the pad's: it goes all the way
  /// Opening there [m].
  [[nodiscard]] double opening(const SectorPoint& at) const;
};

/// A parabola in the direction of rotation, highest in the middle.
struct SectorCrown {
  double drop = 0;  ///< at leading and trailing edge [m]
  /// Opening there [m].
  [[nodiscard]] double opening(const SectorPoint& at) const;
};

/// A parabola along the radius, highest at the mean radius.
struct SectorBarrel {
  double drop = 0;  ///< at inner and outer edge [m]
  /// Opening there [m].
  [[nodiscard]] double opening(const SectorPoint& at) const;
};

/// A cone: a gap that widens linearly with the radius, or towards the axis.
struct SectorCone {
  double rise = 0;  ///< from the inner to the outer edge [m]; negative: it widens towards the inner edge
  /// Opening there, not negative [m].
  [[nodiscard]] double opening(const SectorPoint& at) const;
};

/// A flat face that is inclined to the stator's plane about the point at the pad's mean angle and mean radius.
struct SectorIncline {
  double along = 0;   ///< slope: the gap is wider at the leading edge [-]
  double across = 0;  ///< slope: the gap is wider at the outer edge [-]
  /// Opening there; negative where the face lies above the plane [m].
  [[nodiscard]] double opening(const SectorPoint& at) const;
};

using SectorShape = std::variant<SectorRamp, SectorCrown, SectorBarrel, SectorCone, SectorIncline>;

/// A pad: a sector of the annulus.
struct SectorPad {
  std::string name;
  double from = 0, to = 1;  ///< [rad], from < to, in ascending order and 2 pi together at most
};

/// Pads in sectors of an annulus, or a whole washer, against a runner that turns about the axis. Its film lies on
/// film::Annulus, R the mean radius. The stator's frame has its origin on the axis in the plane of the pads and z from
/// there into the film, towards the runner.
class ThrustBearing final : public BearingKind {
 public:
  /// @param pads      each a patch of the film's grid; empty: a whole washer
  /// @param shapes    of all pads; they add up
  /// @param is_forward  the pads are made for a runner that turns from x towards y; else for the other sense
  explicit ThrustBearing(std::vector<SectorPad> pads, std::vector<SectorShape> shapes = {}, bool is_forward = true);

  [[nodiscard]] std::string name() const override { return "thrust"; }
  [[nodiscard]] bool has_axis() const override { return false; }
  [[nodiscard]] std::string fixed_surface() const override { return "stator"; }
  [[nodiscard]] std::string moving_surface() const override { return "runner"; }
  [[nodiscard]] bool is_forward() const override { return is_forward_; }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> description(
      const film::FilmModel& model) const override;
  [[nodiscard]] std::unique_ptr<GapKinematics> gap(const film::FilmModel& model,
                                                   bool moving_surface_deforms) const override;
  [[nodiscard]] std::unique_ptr<SteadyCoordinates> steady_coordinates(const film::FilmModel& model) const override;

  /// The pads; empty: a washer.
  [[nodiscard]] const std::vector<SectorPad>& pads() const { return pads_; }
  /// What makes the faces of all pads differ from the stator's plane.
  [[nodiscard]] const std::vector<SectorShape>& shapes() const { return shapes_; }
  /// Returns by how much the shapes open the gap at the nodes [m], shape (grid.size()).
  [[nodiscard]] Eigen::VectorXd opening(const film::FilmModel& model) const;

 private:
  std::vector<SectorPad> pads_;
  std::vector<SectorShape> shapes_;
  bool is_forward_;
};

/// Returns a grid for such pads.
/// @param lines  nodes along each pad, those on its edges included; around a washer all of them
/// @param rows   nodes along the radius, those on the edges included
[[nodiscard]] film::Grid thrust_grid(const std::vector<SectorPad>& pads, int lines, int rows);

}  // namespace hersey::bearing
