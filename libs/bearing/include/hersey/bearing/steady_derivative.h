#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/spatial.h"
#include "hersey/film/film_model.h"
#include "hersey/film/film_response.h"
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

  /// The state that was solved, its coefficients as beside() works them out: what differences are taken from.
  [[nodiscard]] SteadyState here();

  /// The state of `side` on the tangent, with observables and coefficients of displacement; those of tilt stay as they
  /// are. Over the difference of the parameter, that of any figure to here() is its derivative to the first order of
  /// the difference, and half of that between two sides to the second. None where the side lies outside the film's
  /// domain, or the film's own answer is open (one without any supply).
  /// @param side  the parameter a little off, on the grid of the state's model
  [[nodiscard]] std::optional<SteadyState> beside(const BearingBeside& side);

 private:
  struct Change {
    Eigen::Vector2d e;
    Eigen::VectorXd u;
    Eigen::VectorXd residual;  ///< that u takes away again [m^3/s]
  };
  [[nodiscard]] static std::vector<film::MotionDirection> directions(const RigidSurfaces& surfaces,
                                                                     const film::FilmModel& model,
                                                                     const Eigen::Vector2d& e);
  [[nodiscard]] std::optional<Change> change(const BearingBeside& side, RigidSurfaces& surfaces, film::Reynolds& film);
  [[nodiscard]] double amplification();
  void coefficients(const RigidSurfaces& surfaces, film::Reynolds& film, const Eigen::Vector2d& e,
                    DynamicCoefficients& result) const;

  film::FilmModel model_;
  SteadyState state_;
  film::Reynolds film_;
  RigidSurfaces surfaces_;
  Eigen::MatrixXd residual_by_e_;  ///< at fixed u, shape (n, 2)
  Eigen::MatrixXd answers_;        ///< of the film to the directions, shape (n, 4)
  Eigen::MatrixXd adjoints_;       ///< of the force to the residual, shape (n, 2)
  Eigen::Vector2d force_;          ///< of the film on the shell [N]
  Eigen::Matrix2d force_by_e_;     ///< [N/m]
  bool is_determined_ = false;     ///< the film's equations have one answer
};

}  // namespace hersey::bearing
