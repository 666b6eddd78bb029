#pragma once

#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "hersey/film/film_model.h"

namespace hersey::film {

struct GridGeometry;

/// What profiles add to the gap of two cylinders, node by node. Those of the journal that vary around it change the gap
/// as it turns.
class GapShape {
 public:
  /// Of the profiles of `model` at the nodes of its grid.
  explicit GapShape(const FilmModel& model);
  ~GapShape();
  GapShape(GapShape&&) noexcept;
  GapShape& operator=(GapShape&&) noexcept;

  /// Everything that stays where it is when the journal turns [m], shape (grid.size()).
  [[nodiscard]] const Eigen::VectorXd& still() const { return still_; }
  /// The share of it that is cut out of the shell [m], same shape.
  [[nodiscard]] const Eigen::VectorXd& of_shell() const { return of_shell_; }

  /// The derivative of of_shell() around the bearing [m/rad]: what a shell that turns moves past a fixed place.
  [[nodiscard]] Eigen::VectorXd shell_slope() const;

  /// Whether the gap changes as the journal turns.
  [[nodiscard]] bool profiles_turn() const { return !turning_profiles_.empty(); }
  /// Whether nothing is added to the gap of two cylinders.
  [[nodiscard]] bool is_round() const { return !profiles_turn() && still_.isZero(0); }

  /// The journal's profiles with the journal turned by `phi_journal` [rad]: opening [m] and its first and second
  /// derivative with that angle, shape (grid.size()) each. The first times the journal's angular speed is the
  /// rate of the gap (film.25).
  void turn_profiles(double phi_journal, Eigen::VectorXd& opening, Eigen::VectorXd& first,
                     Eigen::VectorXd& second) const;

 private:
  [[nodiscard]] Opening opening_at(const Profile& profile, int node, double turned) const;

  FilmModel model_;
  std::unique_ptr<GridGeometry> geometry_;
  Eigen::VectorXd still_, of_shell_;
  std::vector<Profile> turning_profiles_;
};

/// The sum of all openings with the journal turned by `phi_journal` [m], shape (grid.size()).
[[nodiscard]] Eigen::VectorXd gap_opening(const FilmModel& model, double phi_journal = 0);

}  // namespace hersey::film
