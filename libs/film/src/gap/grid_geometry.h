#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Lengths and areas of a film's grid.
struct GridGeometry {
  explicit GridGeometry(const FilmModel& model);

  Eigen::VectorXd phi;         ///< of the nodes [rad], shape (n_phi)
  Eigen::VectorXd z;           ///< of the nodes [m], shape (n_z)
  Eigen::VectorXd dx;          ///< from node i to node i + 1 around the bearing [m], shape (n_phi)
  Eigen::VectorXd dz;          ///< from node j to node j + 1 along the axis [m], shape (n_z - 1)
  Eigen::VectorXd width_phi;   ///< of the control volumes: half-way to both neighbours [m], shape (n_phi)
  Eigen::VectorXd width_z;     ///< likewise; those on the edges end there [m], shape (n_z)
  Eigen::VectorXd weight_phi;  ///< by which nodal values count in an integral around the bearing [m], shape (n_phi)
  Eigen::VectorXd weight_z;    ///< in one along the axis [m], shape (n_z)
  double mean_dx = 0;          ///< [m]
  double mean_dz = 0;          ///< [m]

  /// Of a control volume [m^2].
  [[nodiscard]] double area(int i, int j) const { return width_phi[i] * width_z[j]; }

  /// The node before `angle` in the direction of growing phi, and the share of the way to the next, in [0, 1).
  struct Place {
    int node = 0;
    double share = 0;
  };
  [[nodiscard]] Place place_of(double angle) const;
};

}  // namespace hersey::film
