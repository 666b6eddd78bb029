#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "hersey/film/grid.h"

namespace hersey::film {

/// What heat from a film does to the body whose surface it lies on, which conducts it steadily (theory manual,
/// thermal.35, thermal.36): temperatures and shape of that surface are linear in the heat, angle by angle.
struct WallConduction {
  Eigen::VectorXd T0;    ///< of the surface where the film gives no heat, mean over its width, shape (n_phi) [K]
  Eigen::MatrixXd rise;  ///< by the heat into each angle, shape (n_phi, n_phi) [K/W]
  /// How far the surface lies outside its cylinder [m], shape (grid.size()): without heat, by it [m/W], and by a rise
  /// of the temperature of all of the body [m/K]; empty: it keeps its shape.
  Eigen::VectorXd shape0 = {};
  Eigen::MatrixXd shape_by_heat = {};
  Eigen::VectorXd shape_by_rise = {};
  double T_reference = 293.15;     ///< at which the surface is its cylinder [K]
  Eigen::VectorXd T_body0 = {};    ///< at the nodes of the body without heat [K]
  Eigen::MatrixXd rise_body = {};  ///< by the heat, shape (nodes, n_phi) [K/W]

  /// Whether it changes its shape.
  [[nodiscard]] bool deforms() const { return shape0.size() > 0; }
  /// Temperatures of the surface by heat into it, (n_phi) [W].
  [[nodiscard]] Eigen::VectorXd temperatures(const Eigen::VectorXd& heat) const { return T0 + rise * heat; }
  /// Of the body at its nodes [K].
  [[nodiscard]] Eigen::VectorXd body(const Eigen::VectorXd& heat) const { return T_body0 + rise_body * heat; }
  /// Its shape by the same heat [m], shape (grid.size()).
  [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd& heat) const { return shape0 + shape_by_heat * heat; }
};

/// The same wall seen from a coarser grid, whose angles are among those of the finer one: heat and shape are the same
/// to what its lines between nodes can say.
[[nodiscard]] WallConduction on_grid(const WallConduction& wall, const Grid& from, const Grid& to);

/// A shell in a body that conducts heat. A steady film is in balance with it; over a time step it keeps its
/// temperature, and over cycles it settles at that of their mean heat (WallMotion::held, theory manual, thermal.57).
struct BodyWall {
  std::shared_ptr<const WallConduction> conduction;  ///< never null
  std::optional<double> T_start = {};                ///< with which a simulation begins [K]; unset: the supply's
};

}  // namespace hersey::film
