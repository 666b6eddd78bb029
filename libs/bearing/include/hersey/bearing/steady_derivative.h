#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/spatial.h"
#include "hersey/film/film_exchange.h"
#include "hersey/film/film_model.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// A bearing by itself with one of its parameters a little off.
struct BearingBeside {
  film::FilmModel model;
  OperatingPoint point;
};

/// How a solved operating point moves as parameters of the bearing change, by the Jacobian of the solution factorised
/// once (theory manual, bearing.35 to bearing.37). Nothing is solved anew.
/// @verified_by steady_derivative_test.cpp
class SteadyDerivative {
 public:
  /// About `state`, solved for `model`. Both are copied.
  /// @throws ContractError unless is_of_film_alone(state).
  SteadyDerivative(const film::FilmModel& model, const SteadyState& state);

  /// Whether derivatives of a state are those of its film alone: rigid surfaces and one temperature that is given.
  [[nodiscard]] static bool is_of_film_alone(const SteadyState& state);

  /// The states below and above `state` on its tangent, with observables and coefficients: the difference of any figure
  /// of the two is its derivative times the difference of the parameter, to the square of the latter. None where a side
  /// lies outside the film's domain, or the film's own answer is open (one without any supply).
  /// @param sides  the parameter below and above by the same amount, on the grid of the state's model
  [[nodiscard]] std::optional<std::array<SteadyState, 2>> beside(const std::array<BearingBeside, 2>& sides);

 private:
  struct Change {
    Eigen::Vector2d e;
    Eigen::VectorXd u;
    Eigen::VectorXd residual;  ///< that u takes away again [m^3/s]
  };
  [[nodiscard]] std::vector<film::MotionDirection> directions(const film::FilmModel& model,
                                                              const Eigen::Vector2d& e) const;
  [[nodiscard]] std::optional<Change> change(const std::array<BearingBeside, 2>& sides);
  [[nodiscard]] DynamicCoefficients coefficients(film::Reynolds& film, const Eigen::Vector2d& e) const;

  film::FilmModel model_;
  SteadyState state_;
  film::Reynolds film_;
  Eigen::MatrixXd residual_by_e_;  ///< at fixed u, shape (n, 2)
  Eigen::MatrixXd answers_;        ///< of the film to the directions, shape (n, 8)
  Eigen::MatrixXd adjoints_;       ///< of the force's four entries to the residual, shape (n, 4)
  Eigen::Matrix2d force_by_e_;     ///< [N/m]
};

}  // namespace hersey::bearing
