#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hersey/bearing/coordinates.h"
#include "hersey/bearing/operating_point.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// The coordinates in which the steady search moves the surfaces of one kind of bearing between rigid bodies: how they
/// open the gap, which part of the film's wrench works on them, and where a search begins and goes on. One object per
/// bearing and thread.
class SteadyCoordinates {
 public:
  using Index = Eigen::Index;
  using ForceRows = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 6, 6>;

  virtual ~SteadyCoordinates() = default;

  /// Number of coordinates of the position; tilts are given, not sought.
  [[nodiscard]] virtual Index count() const = 0;
  /// Rows that take the film's wrench on the fixed surface, [moment; force], to the forces that work on position and
  /// tilts, shape (count() + 2, 6).
  [[nodiscard]] virtual const ForceRows& force_rows() const = 0;

  /// Returns the rigid surfaces of an operating point with the moving surface at `e`.
  [[nodiscard]] virtual film::SurfaceMotion surfaces(const OperatingPoint& point, const Coordinates& e) = 0;
  /// Returns `count` directions of motion from `first` on, of: the position's coordinates, both tilts, and the rates of
  /// all of these. A supply at the widest gap follows `e`.
  [[nodiscard]] virtual std::vector<film::MotionDirection> directions(const Coordinates& e, Index first,
                                                                      Index count) const = 0;
  /// Returns the smallest gap of the rigid surfaces [m].
  [[nodiscard]] virtual double smallest_gap(const OperatingPoint& point, const Coordinates& e) = 0;
  /// Returns a position at which the surfaces are as far apart as the kind allows.
  [[nodiscard]] virtual Coordinates widest() const = 0;

  /// Length in which steps from `e` are measured: of a journal the clearance, of a slider its film thickness [m].
  [[nodiscard]] virtual double scale(const OperatingPoint& point, const Coordinates& e) = 0;
  /// Returns an estimate of the position at which the film carries the load of `point`.
  [[nodiscard]] virtual Coordinates start(const OperatingPoint& point) = 0;
  /// Returns a position with a thicker film than at `e`, halving k times what parts it from the thickest.
  [[nodiscard]] virtual Coordinates opened(const OperatingPoint& point, const Coordinates& e, int k) = 0;

  /// Returns the distances, ascending from above 0, at which a search for a load looks for a film that is strong
  /// enough: the further out, the stronger.
  /// @param depth  by which the surfaces of elastic bodies yield to the load [m]; 0: they are rigid
  [[nodiscard]] virtual std::vector<double> distances(const OperatingPoint& point, double depth) = 0;
  /// Returns the position at such a distance; of a kind with two coordinates in the direction `angle` [rad].
  [[nodiscard]] virtual Coordinates at(const OperatingPoint& point, double distance, double angle) = 0;

  /// Says where the moving surface is: "eccentricity ratio 0.7432".
  [[nodiscard]] virtual std::string position_text(const OperatingPoint& point, const Coordinates& e) const = 0;
};

}  // namespace hersey::bearing
