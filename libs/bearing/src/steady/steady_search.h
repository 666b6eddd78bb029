#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/film/film_heat.h"
#include "steady/steady_film.h"

namespace hersey::bearing {

/// Search for the film and the position of one bearing at an operating point (bearing.17). Newton's method is in
/// steady_newton.cpp, the paths to a load from which it converges where it does not from the start in steady_paths.cpp.
class SteadySearch {
  using Columns = SteadyFilm::Columns;

 public:
  /// Keeps references to `model` and `options`.
  SteadySearch(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options);

  /// Solves from the film of begin_at(); without one, or where that does not lead there, from the start that the
  /// options give, or from the kind's estimate.
  [[nodiscard]] SteadySummary solve();
  /// Solves again after a change of viscosities or clearance, from the present film and position.
  [[nodiscard]] SteadySummary retry();
  /// Solves the film at the position that the point gives.
  [[nodiscard]] SteadySummary at_given_position();

  /// Solves the film at the position that the point gives as far as coefficients() need it.
  [[nodiscard]] bool prepare_coefficients();

  /// Begins at a known film `u` and position, with the amplitudes `s` of surfaces that deform.
  void begin_at(const Coordinates& e, const Eigen::VectorXd& u, const Eigen::VectorXd& s = {});
  /// True if there is a film to continue from.
  [[nodiscard]] bool has_film() const { return has_film_; }
  /// Linearises anew; if film and force are within the tolerance of the options, adds the last increment to the film
  /// and returns true.
  [[nodiscard]] bool accept_if_converged();

  void set_viscosity(film::LayeredViscosity viscosity) { film_.set_viscosity(std::move(viscosity)); }
  void set_shapes(ShapesAtRest shapes) { film_.set_shapes(std::move(shapes)); }
  /// Sets the growth of the clearance; the journal keeps its eccentricity ratio.
  void set_growth(double growth);
  /// Sets the tolerance, coarser on the way to a balance of film and temperature.
  void set_tolerance(double rtol);

  /// Advances the temperatures by the present film.
  void heat(film::FilmHeat& heat) { heat.advance(film_.surfaces(e_, x_), film_.history(), film_.film_of(x_)); }

  /// Derivatives at the present film (bearing.21): one solve each for positions and rates, on the factor of the last
  /// linearisation. Surfaces that deform with the position move at its rate (bearing.29).
  [[nodiscard]] DynamicCoefficients coefficients();
  [[nodiscard]] const Coordinates& position() const { return e_; }
  /// What its film has cost.
  [[nodiscard]] film::FilmWork work() const { return film_.reynolds().work(); }
  [[nodiscard]] Eigen::VectorXd film() const { return film_.film_of(x_); }
  [[nodiscard]] SteadyState state();

 private:
  /// A position whose force points along the load.
  struct Position {
    double r = 0, angle = 0;  // of SteadyCoordinates::at() [m, rad]
    Eigen::VectorXd x;
  };

  /// Interval of the outward search: the film is too weak at `inner`, and at `outer` strong enough or absent.
  struct Bounds {
    double angle = 0, inner = 0;
    std::optional<double> outer = {};
    std::optional<Position> strong = {};  // the last one with more force than the load
  };

  /// The largest force along the load that was found, with its position, and why there is none further out.
  struct Limit {
    double force = 0;
    std::string where;
    std::string why;
    bool solver_failed = false;
  };

  /// A step of position, and of film and deformation.
  struct Step {
    Coordinates de;
    Eigen::VectorXd dx;
  };

  // The film at one position

  /// Solves the film at `e` from the present one.
  [[nodiscard]] bool film_at(const Coordinates& e);
  /// True if each film is solved by relaxation, which has no linearisation to share with the position.
  [[nodiscard]] bool is_swept() const { return options_.solver == film::FilmSolver::sor && !film_.deforms(); }
  /// True if the solver did not converge although a film may exist; false if there is none, because the gap closes or
  /// the viscosity grows without bound.
  [[nodiscard]] bool solver_failed(const film::FilmSolveSummary& solved) const;
  /// False where oil between rigid surfaces is a solid: beyond Weibull's limit the equations have numerical solutions.
  [[nodiscard]] bool is_fluid();
  /// True if no pressure builds up anywhere, so that no position carries a load.
  [[nodiscard]] bool carries_no_load();
  [[nodiscard]] bool linearise();
  /// Solves the film at the start, or at positions with a thicker film where that has none.
  [[nodiscard]] bool film_at_start();
  void take_start();

  // Newton's method

  [[nodiscard]] SteadySummary under_load();
  /// Returns K, the change of the force with the position, and sets dx_de_.
  [[nodiscard]] Eigen::MatrixXd force_by_position();
  /// Returns the force residual in logarithmic form: ln(W/F) F along the present force plus the angle to the target
  /// times F across it. To first order this is target - force; the logarithm suits a force that follows a power of the
  /// film thickness. Returns target - force for a tiny force, or one more than 90 degrees off.
  [[nodiscard]] Coordinates log_force_residual(const Coordinates& target) const;
  /// Returns sqrt(ln(W/F)^2 + angle^2) of that residual, 0 at the target.
  [[nodiscard]] double log_force_error(const Coordinates& target) const;
  /// Returns Newton's step (bearing.18) towards `target`, limited to where the linear film is valid.
  [[nodiscard]] Step newton_step(const Coordinates& target);
  /// Returns the factor (1 - exp(-x))/x, at most 2, that makes a step of rigid surfaces linear in ln(gap); x is the
  /// relative decrease of the gap by the full step, linearised.
  [[nodiscard]] double log_gap_step_factor(const Coordinates& de) const;
  [[nodiscard]] double gap_at(const Coordinates& e) const { return film_.undeformed_gap(e); }
  [[nodiscard]] SteadyCoordinates& coordinates_of() const { return film_.coordinates(); }
  [[nodiscard]] std::string position_text() const { return coordinates_of().position_text(point_, e_); }
  /// True if the surfaces do not overlap, or may.
  [[nodiscard]] bool has_open_gap() const { return film_.may_overlap() || gap_at(e_) > 0; }
  /// True if a supply at the widest gap rotates so far with the position that the film is another one.
  [[nodiscard]] bool rotates_far(const Coordinates& from, const Coordinates& to) const;
  /// True if film and force are within their tolerance.
  [[nodiscard]] bool is_converged(const Coordinates& target);
  /// Adds the increment of the last linearisation. Returns false, and adds nothing, if a fill fraction would become
  /// negative: such a root of the equations is no film.
  [[nodiscard]] bool take_last_increment();
  /// Where film and force are so near that the derivatives of this linearisation are those of the solution, takes the
  /// last Newton step; nothing is evaluated after it. By multigrid, whose step has come with the linearisation.
  [[nodiscard]] bool take_last_step(const Coordinates& target);
  /// Near the solution, takes one Newton step from the present linearisation; its remainder is known to be small.
  [[nodiscard]] bool take_one_step(const Coordinates& target);
  /// Near the solution, takes steps of the chord method with the factor of the last such step. Each reduces the error
  /// to a fraction that is proportional to change_since_factor_. Gives up if a node changes between full film and
  /// cavitation.
  [[nodiscard]] bool take_chord_steps(const Coordinates& target);
  /// Newton's method on film and position at once, one linearisation per iteration.
  [[nodiscard]] bool solve_jointly(const Coordinates& target);
  /// Newton's method on the position with the film solved at each; a step that does not reduce log_force_error() is
  /// halved.
  [[nodiscard]] bool solve_nested(const Coordinates& target);

  // Paths to the load

  [[nodiscard]] bool is_over_budget() const { return summary_.iterations >= budget_; }
  /// Continues with solve_nested() from the present position, or from the start if that is nearer to the load.
  [[nodiscard]] bool continue_nested();
  /// Returns a force between `from` and the load: rotated at an even rate and grown by an even factor.
  [[nodiscard]] Coordinates between(const Coordinates& from, double fraction) const;
  /// Between surfaces that deform, starts from a fraction of the load at which they hardly do.
  [[nodiscard]] bool raise_from_light_load();
  [[nodiscard]] bool raise_load() { return film_at_start() && change_load(); }
  /// Changes the force from the present one to the load, each equilibrium the start of the next (bearing.19).
  [[nodiscard]] bool change_load();
  /// Moves to a nearby force. Soft bodies yield under a fixed load, but not at a fixed position: position and
  /// deformation then change together.
  [[nodiscard]] bool track(const Coordinates& target);

  /// What is found at one distance: no film, a force that points along the load at no angle, or one below or above it.
  enum class Probe { no_film, not_aligned, below_load, above_load };
  /// Rotates the position at the distance at.r about the bearing's centre until the force points along the load. A
  /// round bearing without features needs one rotation, since its force rotates with the position.
  [[nodiscard]] Probe rotate_to_load(Position& at);
  /// Examines one distance: moves one of the bounds, and records the force found.
  void probe(double r, Bounds& bounds);
  /// Searches outwards, as the force of a film grows with the distance, without bound or up to where the film ends,
  /// until it exceeds the load; then bisects, then applies Newton's method (bearing.20). Its findings say, where there
  /// is no equilibrium, what the film carries at most.
  [[nodiscard]] bool search_outwards();
  /// Applies Newton's method from the last position whose force exceeds the load; from far away it lowers the load from
  /// that force.
  [[nodiscard]] bool is_reached(const Bounds& bounds);

  [[nodiscard]] std::string failure_message() const;
  /// Says that the solver failed further out, which does not limit what the film carries.
  [[nodiscard]] std::string unsolved_message() const;
  [[nodiscard]] std::string suggestion() const;

  const film::FilmModel& model_;
  OperatingPoint point_;
  const SteadyOptions& options_;
  SteadyFilm film_;
  Coordinates e_, force_;
  Eigen::VectorXd x_;  // film and deformation
  Eigen::MatrixXd dx_de_;
  Eigen::MatrixXd K_;  // change of the force with the position in the last take_one_step()
  /// Sum of the relative residuals since the Jacobian of the last take_one_step() was factorised; unset: there is no
  /// factor to reuse.
  std::optional<double> change_since_factor_;
  SteadySummary summary_;
  Limit limit_;
  double rtol_ = options_.rtol;
  bool has_film_ = false;       // to go on from
  bool solver_failed_ = false;  // the solver has not found the film last sought
  int budget_ = 0;              // of linearisations
};

}  // namespace hersey::bearing
