#pragma once

#include "hersey/bearing/steady_coordinates.h"

namespace hersey::bearing {

/// Pads of one size, by which a search for a film thickness estimates what they bear.
struct PadSize {
  double length = 1;  ///< along the sliding direction, on average [m], > 0
  int count = 1;
  double radius = 1;  ///< speed [m/s] of the film per unit of OperatingPoint::journal_speed
};

/// Steady coordinates of kinds whose surfaces approach each other along a normal: one coordinate, the distance, which
/// grows by as much as the gap does, or falls. What is common to them: the search goes by the smallest gap.
class ApproachCoordinates : public SteadyCoordinates {
 public:
  [[nodiscard]] Index count() const final { return 1; }
  [[nodiscard]] const ForceRows& force_rows() const final { return force_rows_; }
  [[nodiscard]] Coordinates widest() const final { return Coordinates::Constant(1, sign_ * widest_); }
  [[nodiscard]] double scale(const OperatingPoint& point, const Coordinates& e) final;
  [[nodiscard]] Coordinates start(const OperatingPoint& point) final;
  [[nodiscard]] Coordinates opened(const OperatingPoint& point, const Coordinates& e, int k) final;
  [[nodiscard]] std::vector<double> distances(const OperatingPoint& point, double depth) final;
  [[nodiscard]] Coordinates at(const OperatingPoint& point, double distance, double angle) final;

 protected:
  /// Keeps a reference to `model`.
  /// @param sign  1: the coordinate grows with the gap; -1: it falls
  /// @param widest  gap from which a search measures, no smaller than any that occurs [m]
  ApproachCoordinates(const film::FilmModel& model, PadSize pads, double sign, double widest, ForceRows force_rows);

 private:
  [[nodiscard]] Coordinates with_smallest_gap(const OperatingPoint& point, double gap);

  const film::FilmModel& model_;
  PadSize pads_;
  double sign_, widest_;
  ForceRows force_rows_;
};

}  // namespace hersey::bearing
