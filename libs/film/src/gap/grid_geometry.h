#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Returns the line after the last one of a patch.
[[nodiscard]] int end_of_patch(const Grid& grid, std::size_t patch);

/// Positions of a film's nodes, and lengths and areas between them on the surface of the film. Lengths along phi are
/// those at R; at another z they are multiplied by the stretch.
struct GridGeometry {
  explicit GridGeometry(const FilmModel& model);

  double R = 1;  ///< [m]
  FilmSurface surface;

  Eigen::VectorXd phi;              ///< of the nodes [rad], shape (n_phi)
  Eigen::VectorXd z;                ///< of the nodes [m], shape (n_z)
  Eigen::VectorXd dx;               ///< from line i to the next [m], shape (n_phi); 0 from the last of a patch
  Eigen::VectorXd dz;               ///< from node j to node j + 1 along the axis [m], shape (n_z - 1)
  Eigen::VectorXd width_phi;        ///< width of the control volumes, half-way to both neighbours [m], shape (n_phi)
  Eigen::VectorXd width_z;          ///< width of the control volumes, which end at the edges [m], shape (n_z)
  Eigen::VectorXd weight_phi;       ///< weights of nodal values in an integral around the bearing [m], shape (n_phi)
  Eigen::VectorXd weight_z;         ///< weights of nodal values in an integral along the axis [m], shape (n_z)
  Eigen::VectorXd stretch;          ///< of the rows [-], shape (n_z)
  Eigen::VectorXd stretch_over;     ///< mean over their control volumes [-], shape (n_z)
  Eigen::VectorXd stretch_between;  ///< half-way to the next row [-], shape (n_z - 1)
  double mean_dx = 0;               ///< [m]
  double mean_dz = 0;               ///< [m]

  /// Area of a control volume [m^2].
  [[nodiscard]] double area(int i, int j) const { return width_phi[i] * width_z[j] * stretch_over[j]; }
  /// Weight of a nodal value in an integral over the film [m^2].
  [[nodiscard]] double weight(int i, int j) const { return weight_phi[i] * weight_z[j] * stretch[j]; }
  /// Distance from node (i, j) to the next along phi [m].
  [[nodiscard]] double step(int i, int j) const { return dx[i] * stretch[j]; }
  /// Angle from line i to the next [rad].
  [[nodiscard]] double dphi(int i) const { return dx[i] / R; }
  /// Returns the angle from one angle to another, the shorter one around a surface that closes [rad].
  [[nodiscard]] double from_to(double from, double to) const;
  /// Returns an angle as results show it: on a surface that closes from 0 to 2 pi [rad].
  [[nodiscard]] double reported_angle(double phi) const;

  /// Node before `angle` in the direction of growing phi, and the fraction of the distance to the next, in [0, 1).
  /// Outside of patches it is the nearest line.
  struct Location {
    int node = 0;
    double fraction = 0;
  };
  [[nodiscard]] Location locate(double angle) const;
};

}  // namespace hersey::film
