#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "hersey/film/film_model.h"

namespace hersey::film {

struct GridGeometry;

/// Opening of the gap of two cylinders by profiles, node by node. Profiles of the journal that vary around it change
/// the gap as it rotates.
class GapShape {
 public:
  /// Evaluates the profiles of `model` at the nodes of its grid.
  explicit GapShape(const FilmModel& model);
  ~GapShape();
  GapShape(GapShape&&) noexcept;
  GapShape& operator=(GapShape&&) noexcept;

  /// Opening that does not change as the journal rotates [m], shape (grid.size()).
  [[nodiscard]] const Eigen::VectorXd& still() const { return still_; }
  /// Its part in the shell [m], same shape.
  [[nodiscard]] const Eigen::VectorXd& of_shell() const { return of_shell_; }

  /// Derivative of of_shell() around the bearing [m/rad]: a shell that rotates moves it past a fixed point.
  [[nodiscard]] Eigen::VectorXd shell_slope() const;

  /// True if the gap changes as the journal rotates.
  [[nodiscard]] bool profiles_rotate() const { return !turning_profiles_.empty(); }
  /// True if nothing is added to the gap of two cylinders.
  [[nodiscard]] bool is_round() const { return !profiles_rotate() && still_.isZero(0); }

  /// Evaluates the journal's profiles with the journal rotated by `phi_journal` [rad]: opening [m] and its first and
  /// second derivative by that angle, shape (grid.size()) each. The first times the journal's angular speed is the
  /// rate of the gap (film.25).
  void rotate_profiles(double phi_journal, Eigen::VectorXd& opening, Eigen::VectorXd& first,
                       Eigen::VectorXd& second) const;

 private:
  [[nodiscard]] Opening opening_at(const Profile& profile, int node, double turned) const;

  FilmModel model_;
  std::unique_ptr<GridGeometry> geometry_;
  Eigen::VectorXd still_, of_shell_;
  std::vector<Profile> turning_profiles_;
};

/// Returns the sum of all openings with the journal rotated by `phi_journal` [m], shape (grid.size()).
[[nodiscard]] Eigen::VectorXd gap_opening(const FilmModel& model, double phi_journal = 0);

}  // namespace hersey::film
