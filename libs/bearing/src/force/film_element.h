#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "force/oil_balance.h"
#include "hersey/core/archive.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/reynolds.h"

namespace hersey::bearing {

/// An oil film as an element of a machine: its unknowns u and temperatures, their history from step to step, and its
/// forces with u eliminated. It sees two surfaces that move with parameters, and knows no bodies.
///
/// The parameters are those of the gap's kinematics, then amplitudes of the surfaces' shapes, then their rates. Within
/// a step u follows their change through the last linearisation, u += du0 + (du/ds) (s - s_last) (theory manual,
/// bearing.9).
class FilmElement {
 public:
  struct Options {
    film::FilmSolveOptions solve;
    double initial_dt;        ///< the film at the start follows from a gap filled this long before [s], > 0
    double initial_fill = 1;  ///< share of that gap which was oil [-]
    std::optional<film::ThermalModel> thermal;  ///< unset: an isothermal film at the model's temperature
    std::vector<Eigen::Index> angles;           ///< parameters that are the same after a whole revolution
  };
  FilmElement(const film::FilmModel& model, Options options);

  /// Solves the film of a freshly filled gap at the start of a run, a compliant liner in static equilibrium with it. On
  /// failure the summary gives the reason, and the node where the film leaves its domain.
  [[nodiscard]] film::FilmSolveSummary start(const film::SurfaceMotion& surfaces);
  /// Begins a run from these fill fractions, shape (grid.size()), in place of options.initial_fill, and temperatures.
  /// @param heat  null: those that there are
  void begin_from(const Eigen::VectorXd& fill, const film::HeatState* heat);
  /// Solves the steady film of the surfaces' present motion at the present temperatures, starting from the last film.
  [[nodiscard]] film::FilmSolveSummary solve_steady(const film::SurfaceMotion& surfaces);
  /// Starts a step of length dt from the film accepted last.
  void begin_step(double dt);

  /// Linearises the film at surfaces that have moved with `parameters`, after u has followed these. A prediction that
  /// lies outside the domain is not taken: the film then stays as it was while the surfaces move.
  [[nodiscard]] film::FilmDomain linearise(const film::SurfaceMotion& surfaces, const Eigen::VectorXd& parameters);
  /// Forces after the film's increment with their derivatives by each parameter (bearing.10), from the last
  /// linearisation; u follows the parameters from now on.
  film::CondensedFilm& condense(const std::vector<film::MotionDirection>& directions, const Eigen::MatrixXd& openings,
                                film::PortFlows flows = film::PortFlows::left_out);
  struct Forces {
    Vector6 wrench_on_shell;
    Eigen::VectorXd Q;  ///< on shapes
  };
  /// The same forces without derivatives; u does not follow.
  [[nodiscard]] Forces increment(const Eigen::MatrixXd& openings);
  /// The same at surfaces that have moved with `parameters`, after u has followed these: where the step has been
  /// linearised already, on the factor that this has left.
  [[nodiscard]] film::FilmDomain follow_on_chord(const film::SurfaceMotion& surfaces, const Eigen::VectorXd& parameters,
                                                 const Eigen::MatrixXd& openings, Forces& forces);

  /// Solves the film at fixed surfaces. Films that do not converge have no fallback: the step is rather shortened.
  [[nodiscard]] film::FilmSolveSummary solve(const film::SurfaceMotion& surfaces);
  /// Linearises at fixed surfaces, u as it is.
  [[nodiscard]] film::FilmDomain linearise(const film::SurfaceMotion& surfaces);
  /// u += du of the last increment.
  void take_increment() { u_ += du_, is_evaluated_ = false; }

  /// False if the oil balance over the step contradicts the film found with the gap's rate at its end (theory manual,
  /// film.15). If a film with the change of the gap over the step exists, u is that film on return.
  [[nodiscard]] bool is_step_consistent(const film::SurfaceMotion& surfaces);
  /// Accepts the film at the end of a step, or at the start of a run: oil, temperatures and history move on.
  /// @param is_evaluated  true if the film was last evaluated at these very surfaces
  void accept_step(const film::SurfaceMotion& surfaces, bool is_evaluated);
  /// The film is evaluated anew.
  void reset_linearisation() { is_linearised_ = false; }
  /// Discards the oil balance of the step, which belongs to an earlier evaluation of the film.
  void discard_oil_balance() { has_step_oil_ = false; }

  [[nodiscard]] const film::FilmModel& model() const { return reynolds_.model(); }
  [[nodiscard]] const film::Reynolds& reynolds() const { return reynolds_; }
  /// True once the start of a run has been accepted.
  [[nodiscard]] bool has_started() const { return has_started_; }
  /// Step being solved [s].
  [[nodiscard]] double dt() const { return history_.dt; }
  /// Film linearisations in the current step.
  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] const OilBalance& oil() const { return oil_; }
  /// Null: the film is isothermal.
  [[nodiscard]] film::FilmHeat* heat() { return heat_ ? &*heat_ : nullptr; }
  [[nodiscard]] const film::FilmHeat* heat() const { return heat_ ? &*heat_ : nullptr; }
  /// Temperatures of the step accepted last have changed: the next step sees their viscosities.
  void update_viscosity() { history_start_.viscosity = heat_->viscosity(); }

  /// Observes the film at the state accepted last, whose surfaces are given.
  [[nodiscard]] film::FilmObservables observe(const film::SurfaceMotion& accepted, const Eigen::Vector2d& e,
                                              const Eigen::Vector2d& tilt) const;
  /// Fields at the nodes at that state.
  [[nodiscard]] film::FilmFields fields(const film::SurfaceMotion& accepted) const;

  /// Saves or restores what the next step starts from.
  void persist(Archive& archive);
  /// Saves or restores the history of the last step: where the integrator starts afresh, accelerations at the step's
  /// end follow from it (solver::solve_accelerations).
  void persist_step(Archive& archive);
  /// Saves or restores the equation's pivot order.
  void persist_reynolds(Archive& archive) { reynolds_.persist(archive); }

 private:
  [[nodiscard]] film::FilmSolveSummary solve_in_step(const film::SurfaceMotion& surfaces, Eigen::VectorXd& u);
  [[nodiscard]] film::FilmDomain find_by_itself(const film::SurfaceMotion& surfaces);
  [[nodiscard]] Eigen::VectorXd predicted(double dt) const;
  [[nodiscard]] Forces forces_after(const Eigen::VectorXd& du, const Eigen::MatrixXd& openings) const;
  void follow(const Eigen::VectorXd& parameters);
  void compute_oil_balance(const film::SurfaceMotion& surfaces, bool is_evaluated);

  Options options_;
  Eigen::VectorXd fill_at_start_;  // empty: options_.initial_fill everywhere
  film::Reynolds reynolds_;
  std::optional<film::FilmHeat> heat_;  // at the state accepted last

  // Unknowns in the current step, their increment, and the state linearised last.
  Eigen::VectorXd u_, du_, u_linearised_;
  Eigen::VectorXd parameters_linearised_, parameter_change_;
  film::CondensedFilm condensed_;
  bool is_linearised_ = false;
  bool has_layer_shear_ = false;  // the layers' shear at the start has been found
  int iterations_ = 0;

  // State to which a rejected step returns.
  Eigen::VectorXd u_start_;
  Eigen::VectorXd u_before_;  // a step of dt_before_ earlier; at the start of a run the same
  double dt_before_ = 0;
  film::FilmHistory history_;           // of the step being solved
  film::FilmHistory history_start_;     // what the next step starts from
  film::FilmHistory history_accepted_;  // of the step accepted last

  OilBalance oil_;
  bool has_started_ = false;
  bool has_step_oil_ = false;    // oil_ belongs to the film evaluated last
  bool is_evaluated_ = false;    // reynolds_ stands at u_ and the surfaces it has seen last
  bool is_at_accepted_ = false;  // reynolds_ stands at the state accepted last
  bool is_repeated_ = false;     // the next step has been begun before
};

}  // namespace hersey::bearing
