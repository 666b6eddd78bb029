#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "hersey/film/grid.h"

namespace hersey::bearing {

/// Returns the angle that a film covers around: 2 pi, or the sum of its patches [rad].
[[nodiscard]] double covered_angle(const film::Grid& grid);

/// Values on a journal in its own axes: on lines at equal angles, each with the film's rows, and between the lines as
/// quadratic splines, which are smooth enough for the rate of a gap that they pass (theory manual, wear.8, wear.9).
class JournalRing {
 public:
  explicit JournalRing(const film::Grid& grid);

  /// Number of lines, about as many as the film's grid would have around a whole circumference.
  [[nodiscard]] Eigen::Index lines() const { return lines_; }
  /// Number of values.
  [[nodiscard]] Eigen::Index size() const { return lines_ * grid_.n_z; }

  /// Rotates the journal over the film's grid to an angle [rad].
  void turn(double angle);

  /// Returns the values at the film's nodes.
  [[nodiscard]] Eigen::VectorXd at_nodes(const Eigen::VectorXd& values) const { return spread(values, value_, 1); }
  /// Returns the values on the lines, of the whole journal.
  [[nodiscard]] Eigen::VectorXd at_lines(const Eigen::VectorXd& values) const;
  /// Returns the first derivative of those at the nodes by the journal's angle [1/rad].
  [[nodiscard]] Eigen::VectorXd by_angle(const Eigen::VectorXd& values) const;
  /// Returns the second derivative [1/rad^2].
  [[nodiscard]] Eigen::VectorXd by_angle_twice(const Eigen::VectorXd& values) const;

  /// Returns what amounts at the film's nodes add up to on the ring: each is shared among three lines, none is lost.
  [[nodiscard]] Eigen::VectorXd collected(const Eigen::VectorXd& nodal) const;

 private:
  using Weights = std::vector<std::array<double, 3>>;  ///< of each of the film's lines
  [[nodiscard]] Eigen::VectorXd spread(const Eigen::VectorXd& values, const Weights& weights, double factor) const;
  /// The ring's line with one of the three weights.
  [[nodiscard]] Eigen::Index line(std::size_t of_film, std::size_t weight) const {
    return (first_[of_film] + static_cast<Eigen::Index>(weight)) % lines_;
  }

  film::Grid grid_;
  Eigen::Index lines_;
  double step_;                      ///< angle between lines [rad]
  std::vector<Eigen::Index> first_;  ///< of the three lines that a line of the film lies on
  Weights value_, slope_, curvature_;
};

}  // namespace hersey::bearing
