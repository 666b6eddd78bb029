#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/rigid_surfaces.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/film/film_heat.h"
#include "steady/steady_film.h"

namespace hersey::bearing {

/// Film and position of one bearing (bearing.17), and the Newton iterations that bring them together.
/// Newton's method is in steady_newton.cpp, the paths to the load where it does not arrive from the start in
/// steady_paths.cpp.
class SteadySearch {
  using Columns = SteadyFilm::Columns;

 public:
  SteadySearch(const film::FilmModel& model, const OperatingPoint& point, const SteadyOptions& options);

  /// The film at `e`, from the film there is.
  [[nodiscard]] bool film_at(const Coordinates& e);

  [[nodiscard]] bool is_swept() const { return options_.solver == film::FilmSolver::sor && !film_.deforms(); }

  /// Whether a solver has not arrived. A film that closes, starves or has an oil that stiffens without bound is none.
  [[nodiscard]] bool is_unsolved(const film::FilmSolveSummary& solved) const;

  /// Between rigid surfaces an oil that stiffens has, beyond Weibull's limit, numerical answers in which it is a solid.
  [[nodiscard]] bool flows();

  [[nodiscard]] SteadySummary solve();

  /// A film and a position to go on from, with the amplitudes `s` of surfaces that deform.
  void begin_at(const Coordinates& e, const Eigen::VectorXd& u, const Eigen::VectorXd& s = {});
  [[nodiscard]] bool has_film() const { return has_film_; }

  [[nodiscard]] SteadySummary at_given_position();

  [[nodiscard]] SteadySummary under_load();

  /// The same with other viscosities, from the film and the position there are.
  [[nodiscard]] SteadySummary retry();

  /// Whether the film and position there are, linearised anew, are the answer.
  [[nodiscard]] bool is_settled();

  void set_viscosity(film::LayeredViscosity viscosity) { film_.set_viscosity(std::move(viscosity)); }

  void set_thermal_shapes(Eigen::VectorXd shell, Eigen::VectorXd journal) {
    film_.set_thermal_shapes(std::move(shell), std::move(journal));
  }
  /// The clearance at other temperatures of its walls; the journal stays where it is in it.
  void set_growth(double growth);

  /// How near to an answer it comes, on the way to one of film and temperature.
  void set_tolerance(double rtol);

  /// Temperatures by the film found.
  void heat(film::FilmHeat& heat) { heat.advance(film_.surfaces(e_, x_), film_.history(), film_.film_of(x_)); }

  /// Derivatives at the film found (bearing.21): one solve with four right-hand sides each on the factor of the last
  /// linearisation. What a motion of the journal does to surfaces that deform, they do at its rate (bearing.29).
  [[nodiscard]] DynamicCoefficients coefficients();

  [[nodiscard]] const Coordinates& position() const { return e_; }
  [[nodiscard]] Eigen::VectorXd film() const { return film_.film_of(x_); }

  [[nodiscard]] SteadyState state();

 private:
  /// A position whose force points along the load.
  struct Position {
    double r = 0, angle = 0;  // of SteadyCoordinates::at() [m, rad]
    Eigen::VectorXd x;
  };

  /// Of the search from the inside out: the load is too much at `inner`, and at `outer` it is not, or there is no film.
  struct Bounds {
    double angle = 0, inner = 0;
    std::optional<double> outer = {};
    std::optional<Position> strong = {};  // the last one with more force than the load
  };

  /// The largest force along the load that has been seen, where, and what is further out: no film, or none found.
  struct Limit {
    double force = 0;
    std::string where;
    std::string why;
    bool is_unsolved = false;
  };

  [[nodiscard]] std::string why_not() const;

  /// That a solver does not arrive says nothing of what the film bears.
  [[nodiscard]] std::string not_found_further_out() const;

  [[nodiscard]] std::string what_to_try() const;

  [[nodiscard]] bool is_tired() const { return summary_.iterations >= budget_; }

  [[nodiscard]] bool bears_nothing();

  [[nodiscard]] bool linearise();

  /// Returns K, the change of the force with the position, and sets dx_de_.
  [[nodiscard]] Eigen::MatrixXd force_by_position();

  /// Where the film at the given start cannot be found, it is sought nearer to the centre, where it is thicker.
  [[nodiscard]] bool film_at_start();

  void take_start();

  /// What is missing from the force to the target, as if the force followed a power of the film thickness: the
  /// logarithm of the ratio along the force and the angle across it, to first order their difference.
  [[nodiscard]] Coordinates missing(const Coordinates& target) const;

  /// The same as one number: 0 at the target.
  [[nodiscard]] double distance_to(const Coordinates& target) const;

  /// A step of position, and of film and deformation.
  struct Step {
    Coordinates de;
    Eigen::VectorXd dx;
  };

  /// Newton's step (bearing.18) at the present linearisation towards `target`, cut to where the linear film may be
  /// trusted.
  [[nodiscard]] Step newton_step(const Coordinates& target);

  /// Rigid surfaces: the force follows a power of the gap, so its logarithm is what a step changes in proportion.
  [[nodiscard]] double share_of_gap(const Coordinates& de) const;

  [[nodiscard]] double gap_at(const Coordinates& e) const { return film_.undeformed_gap(e); }

  [[nodiscard]] SteadyCoordinates& coordinates_of() const { return film_.coordinates(); }
  [[nodiscard]] std::string position_text() const { return coordinates_of().position_text(point_, e_); }

  /// Whether the journal stands inside its bore, as far as a rigid one must.
  [[nodiscard]] bool stands_inside() const { return film_.yields() || gap_at(e_) > 0; }

  /// A supply at the widest gap turns with the position: after a large turn the film is another one.
  [[nodiscard]] bool turns_far(const Coordinates& from, const Coordinates& to) const;

  /// Whether film and force are within their tolerance.
  [[nodiscard]] bool holds(const Coordinates& target);
  /// The last increment, unless it leaves less than no oil somewhere: the equations hold there, but that is no film.
  [[nodiscard]] bool settle();

  /// Near the answer one step of Newton's method from the present linearisation is enough, and known to be.
  [[nodiscard]] bool one_step(const Coordinates& target);

  /// Likewise by steps of the chord method, from where the last such step has led, with its linearisation: what they
  /// leave is what is missing times all that has changed since. Not where nodes fill or empty.
  [[nodiscard]] bool on_chord(const Coordinates& target);

  /// Newton on film and position at once: one linearisation per iteration.
  [[nodiscard]] bool together(const Coordinates& target);

  /// Newton on the position with the film solved at each; a step that does not bring the force nearer is halved.
  [[nodiscard]] bool in_turn(const Coordinates& target);

  /// Where the joint iteration has left off, if its position is nearer to the load than the start, else from there.
  [[nodiscard]] bool from_here();

  /// A force on the way from `from` to the load: turning at an even rate and growing by an even factor.
  [[nodiscard]] Coordinates between(const Coordinates& from, double share) const;

  /// Between surfaces that deform: from a share of the load at which they hardly do.
  [[nodiscard]] bool from_light_load();

  [[nodiscard]] bool raise_load() { return film_at_start() && change_load(); }

  /// From the force the film has here to the load, each equilibrium the start of the next (bearing.19).
  [[nodiscard]] bool change_load();

  /// To a force near the present one. Soft bodies give way under a load that is held, but not where the journal is
  /// held: position and deformation then go together.
  [[nodiscard]] bool follow(const Coordinates& target);

  enum class Look { no_film, across, too_weak, strong };

  /// Turns the journal about the bearing's centre, at the distance at.r from it, until the force points along the load.
  /// A round bearing without features needs one turn: its force turns with it.
  [[nodiscard]] Look turn_to_load(Position& at);

  /// One look further out, or half-way between the last two: moves one of the bounds, and keeps what has been borne.
  void look_at(double r, Bounds& bounds);

  /// The force of a film grows the further out the journal stands, without bound or up to where the film ends: outwards
  /// until it reaches the load, then halving the last step, then Newton (bearing.20). What has been seen on the way
  /// says, where the load is not found, what the film bears.
  [[nodiscard]] bool from_inside_out();

  /// Newton from the last position whose force exceeds the load, if that is near enough; from further away the load is
  /// lowered from its force.
  [[nodiscard]] bool is_reached(const Bounds& bounds);

  const film::FilmModel& model_;
  OperatingPoint point_;
  const SteadyOptions& options_;
  SteadyFilm film_;
  Coordinates e_, force_;
  Eigen::VectorXd x_;  // film and deformation
  Eigen::MatrixXd dx_de_;
  Eigen::MatrixXd K_;              // change of the force with the position in the last one_step()
  std::optional<double> changed_;  // by how much of itself the film has since; unset: there is none
  SteadySummary summary_;
  Limit limit_;
  double rtol_ = options_.rtol;
  bool has_film_ = false;     // to go on from
  bool is_unsolved_ = false;  // the solver has not found the film last sought
  int budget_ = 0;            // of linearisations
};

}  // namespace hersey::bearing
