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
  /// The position of the journal is undefined until evaluate() is called.
  explicit RigidSurfaces(const film::FilmModel& model);

  /// Sets by how much, and how fast, the clearance grows with the temperatures of its walls [m, m/s]; later evaluations
  /// include it.
  void set_clearance_change(double growth, double rate) { growth_ = growth, growth_rate_ = rate; }

  /// Writes the gap of two cylinders, g = c - (e + t z) . e_r(phi) (bearing.2), widened by profiles, its rate at fixed
  /// grid points (bearing.3), the speeds, the angle of the supply line and the journal's angle into `motion`.
  void evaluate(const ParameterVector& parameters, film::SurfaceMotion& motion);

  /// Change of the surfaces last evaluated with a unit of one Parameter.
  [[nodiscard]] const film::MotionDirection& direction(int parameter) const { return directions_[parameter]; }

  /// Smallest gap over the film's width at the parameters last evaluated [m]: exact in phi for cylinders, otherwise the
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

/// Calls RigidSurfaces::evaluate once. @param growth  of the clearance [m]
void evaluate_surfaces(const film::FilmModel& model, const ParameterVector& parameters, film::SurfaceMotion& motion,
                       double growth = 0);
/// Returns RigidSurfaces::smallest_gap at these parameters [m]. @param growth  of the clearance [m]
[[nodiscard]] double smallest_gap(const film::FilmModel& model, const ParameterVector& parameters, double growth = 0);
/// Returns RigidSurfaces::direction of a parameter that does not rotate the journal.
[[nodiscard]] film::MotionDirection surface_direction(const film::FilmModel& model, int parameter);

}  // namespace hersey::bearing
