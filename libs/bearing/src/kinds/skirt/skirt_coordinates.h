#pragma once

#include "hersey/bearing/steady_coordinates.h"
#include "kinds/skirt/skirt_surfaces.h"

namespace hersey::bearing {

/// The single coordinate e_x of a skirt in its liner: how far the middle of its axis is off that of the liner towards
/// the thrust side, that middle at z = 0 of the liner. OperatingPoint::journal_speed is the skirt's speed along z over
/// R [rad/s].
class SkirtCoordinates final : public SteadyCoordinates {
 public:
  /// Keeps a reference to `model`. @param opening  as SkirtSurfaces
  SkirtCoordinates(const film::FilmModel& model, Eigen::VectorXd opening, std::optional<LinerBore> liner);

  [[nodiscard]] Index count() const override { return 1; }
  [[nodiscard]] const ForceRows& force_rows() const override { return force_rows_; }
  [[nodiscard]] film::SurfaceMotion surfaces(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::vector<film::MotionDirection> directions(const Coordinates& e, Index first,
                                                              Index count) const override;
  [[nodiscard]] double smallest_gap(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] Coordinates widest() const override { return Coordinates::Zero(1); }
  [[nodiscard]] double scale(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] Coordinates start(const OperatingPoint& point) override;
  [[nodiscard]] Coordinates opened(const OperatingPoint& point, const Coordinates& e, int k) override;
  [[nodiscard]] std::vector<double> distances(const OperatingPoint& point, double depth) override;
  [[nodiscard]] Coordinates at(const OperatingPoint& point, double distance, double angle) override;
  [[nodiscard]] std::string position_text(const OperatingPoint& point, const Coordinates& e) const override;

 private:
  /// How far the skirt moves from the liner's axis in the direction of the load until it touches [m].
  [[nodiscard]] double room(const OperatingPoint& point);

  const film::FilmModel& model_;
  SkirtSurfaces surfaces_;
  ForceRows force_rows_;
  Eigen::VectorXd cosine_;
};

}  // namespace hersey::bearing
