#pragma once

#include <Eigen/Core>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Nodal values of a film, such as those of a results file, as a field on its surface: integrals as the film's own
/// forces have them, and values between nodes. For what takes a film's pressure elsewhere; the film itself works at its
/// nodes.
/// @verified_by nodal_field_test.cpp
class NodalField {
 public:
  /// Of a film on this grid. @throws ContractError where the grid is none
  explicit NodalField(const FilmModel& model);

  /// Weights of nodal values in an integral over the film [m^2], shape (n_phi n_z): with them a pressure has the force
  /// that results give as the film's, (film-surface.9).
  [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }

  /// Returns the field at angle `phi` [rad] and position `z` [m], linear between nodes in both directions; 0 beyond the
  /// film's width and outside of its patches.
  [[nodiscard]] double at(const Eigen::VectorXd& values, double phi, double z) const;

  /// Returns the field as at() does on the film, and its continuation beside the film: constant beyond the width,
  /// linear around between the last line of a patch and the first of the next. For temperatures, which do not end with
  /// a film.
  [[nodiscard]] double continued(const Eigen::VectorXd& values, double phi, double z) const;

 private:
  /// Cell of the grid that contains an angle, or the gap behind line `i`.
  struct Interval {
    int i = 0, next = 0;   ///< lines; next: the first line after a gap
    double s = 0;          ///< from `i` to `next`, 0 to 1
    double from_line = 0;  ///< angle behind line i [rad]
  };
  [[nodiscard]] Interval around(double phi) const;
  [[nodiscard]] double on_line(const Eigen::VectorXd& values, int i, double z) const;

  Grid grid_;
  Eigen::VectorXd phi_, z_, weights_;
};

}  // namespace hersey::film
