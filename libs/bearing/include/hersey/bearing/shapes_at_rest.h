#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::bearing {

/// How far the surfaces of a steady film lie outside those of its kind of bearing at the nodes, away from the axis [m],
/// cause by cause; an empty one: nowhere. The deformation of elastic bodies, an unknown of the steady film, is none of
/// them. Another cause is one more member, and its line in each function below.
struct ShapesAtRest {
  Eigen::VectorXd thermal_shell;    ///< by the thermal expansion of the shell's body (theory manual, thermal.36)
  Eigen::VectorXd thermal_journal;  ///< by that of the journal's, averaged around (thermal.61)

  /// True if there is none.
  [[nodiscard]] bool empty() const { return thermal_shell.size() == 0 && thermal_journal.size() == 0; }

  /// Adds them to the gap, which has no rate by them.
  void add_to(film::SurfaceMotion& motion) const;

  /// Returns what `change` makes of each that is there, as one on another grid.
  template <class Change>
  [[nodiscard]] ShapesAtRest changed_by(const Change& change) const {
    const auto changed = [&](const Eigen::VectorXd& shape) -> Eigen::VectorXd {
      return shape.size() > 0 ? Eigen::VectorXd(change(shape)) : shape;
    };
    return {changed(thermal_shell), changed(thermal_journal)};
  }
};

/// Moves the shell's surface outwards at the nodes by `shape` [m]; an empty one changes nothing.
void add_to_shell(const Eigen::VectorXd& shape, film::SurfaceMotion& motion);
/// Moves the journal's surface outwards in the same way.
void add_to_journal(const Eigen::VectorXd& shape, film::SurfaceMotion& motion);

}  // namespace hersey::bearing
