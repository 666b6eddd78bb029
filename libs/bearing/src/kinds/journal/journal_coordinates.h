#pragma once

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/bearing/steady_coordinates.h"

namespace hersey::bearing {

/// A journal's position (e_x, e_y) in the mid-plane of its bore (theory manual, chapter bearing).
class JournalCoordinates final : public SteadyCoordinates {
 public:
  /// Keeps a reference to `model`.
  explicit JournalCoordinates(const film::FilmModel& model);

  [[nodiscard]] Index count() const override { return 2; }
  [[nodiscard]] const ForceRows& force_rows() const override { return force_rows_; }
  [[nodiscard]] film::SurfaceMotion surfaces(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::vector<film::MotionDirection> directions(const Coordinates& e, Index first,
                                                              Index count) const override;
  [[nodiscard]] double smallest_gap(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] Coordinates widest() const override { return Coordinates::Zero(2); }
  [[nodiscard]] double scale(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] Coordinates start(const OperatingPoint& point) override;
  [[nodiscard]] Coordinates opened(const OperatingPoint& point, const Coordinates& e, int k) override;
  [[nodiscard]] std::vector<double> distances(const OperatingPoint& point, double depth) override;
  [[nodiscard]] Coordinates at(const OperatingPoint& point, double distance, double angle) override;
  [[nodiscard]] std::string position_text(const OperatingPoint& point, const Coordinates& e) const override;

 private:
  /// How far the journal moves in the direction `angle` [rad] until it touches an arc, over the clearance; 1 in a whole
  /// bore.
  [[nodiscard]] double room_towards(const OperatingPoint& point, double angle);

  const film::FilmModel& model_;
  RigidSurfaces surfaces_;
  ForceRows force_rows_;
};

}  // namespace hersey::bearing
