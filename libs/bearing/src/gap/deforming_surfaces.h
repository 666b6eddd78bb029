#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <vector>

#include "gap/surface_shape.h"
#include "hersey/bearing/elastic_surface.h"
#include "hersey/bearing/gap_kinematics.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"
#include "hersey/film/surface_shapes.h"

namespace hersey::bearing {

/// Change of the gap by surfaces that deform: the shell's displacement away from the axis opens it, the journal's
/// closes it (theory manual, bearing.12 to bearing.14). The film's grid is fixed to the shell; the journal's
/// deformation rotates over it with the journal.
class DeformingSurfaces : public SurfaceShape {
 public:
  /// A null surface is rigid.
  DeformingSurfaces(const film::FilmModel& model, std::shared_ptr<const ElasticSurface> shell,
                    std::shared_ptr<const ElasticSurface> journal);

  /// Amplitudes of the shell's body, then of the journal's.
  [[nodiscard]] Eigen::Index amplitudes() const { return shapes_.amplitudes(); }
  [[nodiscard]] bool deform() const { return amplitudes() > 0; }
  [[nodiscard]] bool shell_deforms() const { return shell_ != nullptr; }
  [[nodiscard]] bool journal_deforms() const { return journal_ != nullptr; }

  /// Adds the displacements by the amplitudes `s` to gap and rate in `motion`.
  void add_displacements(const Eigen::VectorXd& s, const Eigen::VectorXd& s_rate, const GapKinematics::Turning& turning,
                         film::SurfaceMotion& motion);

  /// Adds the displacements by the amplitudes of `motion`, shell's first.
  void add_to(const mbd::RelativeMotion& motion, const GapKinematics::Turning& turning,
              film::SurfaceMotion& surfaces) override {
    add_displacements(motion.s, motion.s_rate, turning, surfaces);
  }
  /// True if a surface deforms.
  [[nodiscard]] bool changes_gap() const override { return deform(); }

  /// Shapes by which the amplitudes open the gap, at the journal's last angle and speed.
  [[nodiscard]] const film::SurfaceShapes& shapes() const { return shapes_; }

  /// Adds to the directions of the gap's parameters that the journal's deformation rotates with the journal.
  void add_turning(const GapKinematics::Turning& turning,
                   std::vector<film::MotionDirection>& of_parameters) const override;
  /// Adds the same to the derivative of forces on amplitudes with the journal's angle, a column of `Q_by_s`.
  void add_turning_forces(const GapKinematics::Turning& turning, const Eigen::VectorXd& normal_forces,
                          Eigen::MatrixXd& Q_by_s) const;

  /// Radial displacement of each surface at the nodes, away from the axis [m]; zero where it is rigid.
  [[nodiscard]] Eigen::VectorXd shell_displacement(const Eigen::VectorXd& s) const;
  [[nodiscard]] Eigen::VectorXd journal_displacement(const Eigen::VectorXd& s) const;

 private:
  using Functions = film::SurfaceShapes::Functions;
  /// Values at the nodes and first and second derivatives by phi of a surface's functions rotated by `phi`.
  [[nodiscard]] std::array<Functions, 3> at_nodes(const SurfaceFunctions& functions, double phi) const;
  void turn_journal(double phi);
  [[nodiscard]] Eigen::Index shell_count() const { return shell_ ? shell_->D.cols() : 0; }

  film::Grid grid_;
  double L_;
  std::shared_ptr<const ElasticSurface> shell_, journal_;
  film::SurfaceShapes shapes_;
  Functions slopes_, curvatures_;  ///< d opening / d phi of the journal's functions, and again
  double turned_ = 0;
  Eigen::VectorXd opened_;
  Eigen::VectorXd by_angle_, rate_by_angle_;  ///< d(gap) / d phi = d(gap rate) / d omega, and d(gap rate) / d phi
};

}  // namespace hersey::bearing
