#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "hersey/fem/film_cylinder.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// A field over a film's surface, at an angle [rad] and a position along the axis [m] of the film.
using FilmField = std::function<double(double phi, double z)>;

/// Film pressure as one pressure for each face of a mesh, the load that strength programs take (`*DLOAD`, `PLOAD4`):
/// the mean of the film's over the face, corrected so that all faces together have a given wrench (theory manual,
/// film-surface.10 to 12). For bodies that hersey deforms itself it is SurfacePressure that acts.
/// @verified_by face_pressures_test.cpp
class FacePressures {
 public:
  /// @param faces  those that reach into the film, as film_surface leaves them
  FacePressures(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder);

  /// Returns the integral of a field over the part of each face within the film, over the face's whole area,
  /// shape (faces), (film-surface.10).
  [[nodiscard]] Eigen::VectorXd means(const FilmField& field) const;

  /// Returns its mean over the part of each face within the film alone: of temperatures. Not a number where there is
  /// none.
  [[nodiscard]] Eigen::VectorXd means_within(const FilmField& field) const;

  /// Wrenches [moment about the film's origin; force] of a pressure of 1 Pa on each face, in the film's axes, over the
  /// faces as the elements have them, shape (6, faces) [m^3; m^2], (film-surface.11).
  [[nodiscard]] const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrenches() const { return wrenches_; }

  /// Returns the pressures that have the wrench and differ least from `pressures`, face by face in proportion to these,
  /// (film-surface.12). Along and about the axis, where an even bore takes no force, they have it if that changes no
  /// face by more than a hundredth.
  [[nodiscard]] Eigen::VectorXd with_wrench(const Eigen::VectorXd& pressures, const Vector6& wrench) const;

 private:
  struct Point {
    Eigen::Index face = 0;
    double phi = 0, z = 0, area = 0;
  };
  [[nodiscard]] Eigen::VectorXd integrals(const FilmField& field) const;

  double R_ = 1;
  std::vector<Point> points_;       ///< of integration, within the film
  Eigen::VectorXd areas_, within_;  ///< of each face, and of its part within the film [m^2]
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrenches_;
};

}  // namespace hersey::fem
