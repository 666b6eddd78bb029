#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>

#include "hersey/film/grid.h"

namespace hersey::film {

/// Response of the body that a journal is part of to heat from its film, conducted steadily (theory manual, thermal.59,
/// thermal.61). The body rotates in the film, so that heat enters it evenly around; its one temperature and its mean
/// shape are linear in the total heat.
struct JournalConduction {
  double T0 = 293.15;  ///< mean of its surface where the film gives no heat [K]
  double rise = 0;     ///< of that temperature by the heat [K/W], >= 0
  /// Displacement of the surface outwards from its cylinder, mean around, shape (n_z): without heat [m], by the heat
  /// [m/W], and by a rise of the temperature of the whole body [m/K]; empty: the body keeps its shape.
  Eigen::VectorXd shape0 = {};
  Eigen::VectorXd shape_by_heat = {};
  Eigen::VectorXd shape_by_rise = {};
  double T_reference = 293.15;     ///< at which the surface is its cylinder [K]
  Eigen::VectorXd T_body0 = {};    ///< at the nodes of the body without heat [K]
  Eigen::VectorXd rise_body = {};  ///< by the heat, shape (nodes) [K/W]

  /// True if the body changes its shape.
  [[nodiscard]] bool deforms() const { return shape0.size() > 0; }
  /// Returns the mean temperature of the surface for a heat into it [W].
  [[nodiscard]] double temperature(double heat) const { return T0 + rise * heat; }
  /// Returns the temperatures of the body at its nodes [K].
  [[nodiscard]] Eigen::VectorXd body(double heat) const { return T_body0 + rise_body * heat; }
  /// Returns the displacement along the axis for the same heat [m], shape (n_z).
  [[nodiscard]] Eigen::VectorXd shape(double heat) const { return shape0 + shape_by_heat * heat; }
};

/// Returns the same journal on another grid, interpolated linearly along the axis.
[[nodiscard]] JournalConduction on_grid(const JournalConduction& journal, const Grid& from, const Grid& to);

/// Returns a displacement along the axis, shape (n_z), at all nodes of a grid, shape (grid.size()); empty for an empty
/// one.
[[nodiscard]] Eigen::VectorXd around(const Grid& grid, const Eigen::VectorXd& along);

/// A journal in a body that conducts heat. In a steady film it is in balance with the film; over a time step it keeps
/// its temperature, and over cycles it takes that of their mean heat (WallMotion::fixed, theory manual, thermal.63).
struct BodyJournal {
  std::shared_ptr<const JournalConduction> conduction;  ///< never null
  std::optional<double> T_start = {};                   ///< with which a simulation begins [K]; unset: the supply's
};

}  // namespace hersey::film
