#pragma once

#include <Eigen/Dense>
#include <array>

#include "hersey/bearing/journal_kinematics.h"
#include "hersey/film/gap_shape.h"

namespace hersey::bearing {

/// The gap between two rigid surfaces and its motion, from the parameters of the journal's position (theory manual,
/// chapter bearing). One object per bearing and thread; no allocation after the first call.
class RigidSurfaces {
 public:
  /// Of a bearing whose journal has no place yet: place() comes first.
  explicit RigidSurfaces(const film::FilmModel& model);

  /// The clearance has grown and grows with the temperatures of its walls [m, m/s]; what is placed next has it.
  void set_clearance_change(double growth, double rate) { growth_ = growth, growth_rate_ = rate; }

  /// Writes the gap of two cylinders, g = c - (e + t z) . e_r(phi) (bearing.2), widened by profiles, its rate at fixed
  /// grid points (bearing.3), the speeds, the place of the supply line and the journal's angle into `motion`.
  void place(const ParameterVector& parameters, film::SurfaceMotion& motion);

  /// What a unit change of one Parameter does to the surfaces last placed.
  [[nodiscard]] const film::MotionDirection& direction(int parameter) const { return directions_[parameter]; }

  /// Smallest gap over the film's width at the parameters last placed [m]: exact in phi for cylinders, otherwise the
  /// smallest at a node.
  [[nodiscard]] double smallest_gap() const { return smallest_gap_; }

 private:
  void lay_directions();
  void add_turning(double phi_journal, double omega, film::SurfaceMotion& motion);

  film::FilmModel model_;
  film::GapShape shape_;
  Eigen::VectorXd cosine_, sine_;  // of every node's angle
  Eigen::VectorXd z_;              // of every node
  std::array<film::MotionDirection, kParameterCount> directions_;
  double smallest_gap_ = 0;
  double growth_ = 0, growth_rate_ = 0;
  Eigen::VectorXd opening_, first_, second_;
};

// The same for a single use.
/// RigidSurfaces::place for a single use. @param growth  of the clearance [m]
void place_surfaces(const film::FilmModel& model, const ParameterVector& parameters, film::SurfaceMotion& motion,
                    double growth = 0);
/// RigidSurfaces::smallest_gap at these parameters [m]. @param growth  of the clearance [m]
[[nodiscard]] double smallest_gap(const film::FilmModel& model, const ParameterVector& parameters, double growth = 0);
/// Of a parameter that does not turn the journal.
[[nodiscard]] film::MotionDirection surface_direction(const film::FilmModel& model, int parameter);

}  // namespace hersey::bearing
