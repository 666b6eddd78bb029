#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "hersey/film/grid.h"

namespace hersey::film {

/// Response of the body whose surface a film lies on to heat from the film, conducted steadily (theory manual,
/// thermal.35, thermal.36): temperatures and shape of that surface are linear in the heat into each angle.
struct WallConduction {
  Eigen::VectorXd T0;    ///< of the surface where the film gives no heat, mean over its width, shape (n_phi) [K]
  Eigen::MatrixXd rise;  ///< of the temperatures by the heat into each angle, shape (n_phi, n_phi) [K/W]
  /// Displacement of the surface outwards from its cylinder, shape (grid.size()): without heat [m], by the heat [m/W],
  /// and by a rise of the temperature of the whole body [m/K]; empty: the body keeps its shape.
  Eigen::VectorXd shape0 = {};
  Eigen::MatrixXd shape_by_heat = {};
  Eigen::VectorXd shape_by_rise = {};
  double T_reference = 293.15;     ///< at which the surface is its cylinder [K]
  Eigen::VectorXd T_body0 = {};    ///< at the nodes of the body without heat [K]
  Eigen::MatrixXd rise_body = {};  ///< by the heat, shape (nodes, n_phi) [K/W]

  /// True if the body changes its shape.
  [[nodiscard]] bool deforms() const { return shape0.size() > 0; }
  /// Returns the temperatures of the surface for heat into it [W], shape (n_phi).
  [[nodiscard]] Eigen::VectorXd temperatures(const Eigen::VectorXd& heat) const { return T0 + rise * heat; }
  /// Returns the temperatures of the body at its nodes [K].
  [[nodiscard]] Eigen::VectorXd body(const Eigen::VectorXd& heat) const { return T_body0 + rise_body * heat; }
  /// Returns the displacement for the same heat [m], shape (grid.size()).
  [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd& heat) const { return shape0 + shape_by_heat * heat; }
};

/// Returns the same wall on a coarser grid, whose angles are among those of the finer one; heat and shape are the same
/// to the order of linear interpolation.
[[nodiscard]] WallConduction on_grid(const WallConduction& wall, const Grid& from, const Grid& to);

/// A shell in a body that conducts heat. In a steady film it is in balance with the film; over a time step it keeps its
/// temperature, and over cycles it takes that of their mean heat (WallMotion::fixed, theory manual, thermal.57).
struct BodyWall {
  std::shared_ptr<const WallConduction> conduction;  ///< never null
  std::optional<double> T_start = {};                ///< with which a simulation begins [K]; unset: the supply's
};

}  // namespace hersey::film
