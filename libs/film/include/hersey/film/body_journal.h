#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "hersey/film/grid.h"

namespace hersey::film {

/// What heat from a film does to the body that the journal is part of, which conducts it steadily (theory manual,
/// thermal.59, thermal.61): it turns in the film, so that the heat comes to it evenly, and its one temperature and its
/// mean shape around are linear in all of that heat.
struct JournalConduction {
  double T0 = 293.15;  ///< mean of its surface where the film gives no heat [K]
  double rise = 0;     ///< by the heat [K/W], >= 0
  /// How far the surface lies outside its cylinder, its mean around [m], shape (n_z): without heat, by it [m/W], and by
  /// a rise of the temperature of all of the body [m/K]; empty: it keeps its shape.
  Eigen::VectorXd shape0 = {};
  Eigen::VectorXd shape_by_heat = {};
  Eigen::VectorXd shape_by_rise = {};
  double T_reference = 293.15;     ///< at which the surface is its cylinder [K]
  Eigen::VectorXd T_body0 = {};    ///< at the nodes of the body without heat [K]
  Eigen::VectorXd rise_body = {};  ///< by the heat, shape (nodes) [K/W]

  /// Whether it changes its shape.
  [[nodiscard]] bool deforms() const { return shape0.size() > 0; }
  /// Mean temperature of the surface by heat into it [W].
  [[nodiscard]] double temperature(double heat) const { return T0 + rise * heat; }
  /// Of the body at its nodes [K].
  [[nodiscard]] Eigen::VectorXd body(double heat) const { return T_body0 + rise_body * heat; }
  /// Its shape along the axis by the same heat [m], shape (n_z).
  [[nodiscard]] Eigen::VectorXd shape(double heat) const { return shape0 + shape_by_heat * heat; }
};

/// The same journal seen from another grid: straight lines between nodes along the axis.
[[nodiscard]] JournalConduction on_grid(const JournalConduction& journal, const Grid& from, const Grid& to);

/// A shape along the axis, shape (n_z), at all nodes of a grid, shape (grid.size()); of an empty one nothing.
[[nodiscard]] Eigen::VectorXd around(const Grid& grid, const Eigen::VectorXd& along);

/// A journal in a body that conducts heat. A steady film is in balance with it; over a time step it keeps its
/// temperature, and over cycles it settles at that of their mean heat (WallMotion::held, theory manual, thermal.63).
struct BodyJournal {
  std::shared_ptr<const JournalConduction> conduction;  ///< never null
  std::optional<double> T_start = {};                   ///< with which a simulation begins [K]; unset: the supply's
};

}  // namespace hersey::film
