#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/bearing/elastic_surface.h"
#include "hersey/bearing/gap_kinematics.h"
#include "hersey/core/scalar_function.h"
#include "hersey/film/film_heat.h"
#include "hersey/film/film_solver.h"
#include "hersey/film/observables.h"
#include "hersey/film/reynolds.h"
#include "hersey/mbd/two_body_force.h"
#include "hersey/solver/fixed_point_iteration.h"

namespace hersey::bearing {

/// How film and bodies are solved together.
enum class Coupling {
  monolithic,   ///< one Newton system; the film is condensed into the tangent of its wrench
  partitioned,  ///< the bodies see a given wrench, the film given surfaces; repeated until both agree
};

struct BearingOptions {
  Coupling coupling = Coupling::monolithic;
  solver::Acceleration acceleration =
      solver::Acceleration::quasi_newton;  ///< partitioned: how the exchanged wrench is corrected
  double relaxation = 0.1;                 ///< partitioned: share of the first correction taken, in (0, 1]
  /// The film's own solver: initial film, and every film solve of a partitioned coupling. `multigrid` also solves the
  /// linear systems of a monolithic one.
  film::FilmSolveOptions film;
  double initial_dt = 1e-4;  ///< the film at the start is that of a full gap after a step of this length [s], > 0
  /// Pressure of each of the film's features over time [Pa]; empty: the pressures of the film model.
  std::vector<std::shared_ptr<const ScalarFunction>> feature_pressures = {};
  /// Of a film with temperatures, which move on with each accepted step; unset: one temperature, the model's.
  std::optional<film::ThermalModel> thermal = {};
  double growth = 0;  ///< of the clearance of a film with one temperature, at that [m]
  /// Surfaces of elastic bodies; null: rigid. Their amplitudes come with the motion, the shell's before the journal's.
  std::shared_ptr<const ElasticSurface> shell_surface, journal_surface;
};

/// Oil in a film over a run: what is there, what has passed, and what nobody can explain (theory manual, film.15).
struct CumulativeOilBalance {
  double volume = 0;        ///< in the film [m^3]
  double through_flow = 0;  ///< volume that has passed: the larger of what came in and what left, step by step [m^3]
  double unexplained = 0;   ///< change of the volume since the start less what came in [m^3]
  double step_error = 0;    ///< the last step's share of that [m^3]
};

/// What one bearing shows at an accepted state.
struct BearingObservation {
  GapPosition position;                       ///< of the journal, or what moves in its place
  Vector6 wrench_on_shell = Vector6::Zero();  ///< [moment about the bearing's origin; force], bearing frame
  double power_into_bodies = 0;  ///< of wrench, forces on shapes and growing walls [W]; negative: the film takes power
  double power_of_growth = 0;    ///< its part on walls that grow with their temperature [W]
  double clearance = 0;          ///< radial, at the temperatures of the walls [m]
  /// How far walls in bodies have grown outwards by temperature, their means over the nodes [m]; and the clearance with
  /// them (theory manual, thermal.64).
  double bore_growth = 0, journal_growth = 0, clearance_of_bodies = 0;
  film::FilmObservables film;
  std::optional<film::HeatObservables> heat;  ///< of a film with temperatures
  film::WallCorrection walls;                 ///< of held walls, when they settled last
  CumulativeOilBalance oil;
  int film_iterations = 0;  ///< film linearisations in the last step
  int exchanges = 0;        ///< partitioned: wrenches that film and bodies exchanged in the last step
};

class ClearanceGrowth;
class DeformingSurfaces;
class ThermalShape;

/// An oil film between the surfaces of a shell frame A and of a journal frame B (theory manual, chapter bearing), where
/// GapKinematics says how those lie to each other. The surfaces are rigid, or belong to elastic bodies whose shapes
/// move them.
///
/// Monolithic: `evaluate` takes one Newton step of the film together with the bodies. The film's unknowns u follow the
/// change of the surfaces since the last call through the last linearisation, u += du0 + (du/ds) (s - s_last), are
/// linearised anew, and the wrench is returned with the film eliminated: the exact Schur complement of the full system.
/// Partitioned: `evaluate` takes the surfaces to be the bodies' answer to the wrench it returned last, solves the film
/// there to the end, corrects the wrench by what the film says (FixedPointIteration) and returns it without
/// derivatives. Where its exchange has come to no end, that step, shorter, and some more are taken monolithically:
/// `exchanges` of their observations is 0.
class FilmForce : public mbd::TwoBodyForce {
 public:
  /// @param name  as it stands in messages and results
  /// @throws ContractError for a model that describes no film, as film::Reynolds
  FilmForce(std::string name, const film::FilmModel& model, std::unique_ptr<GapKinematics> gap,
            const BearingOptions& options = {});
  ~FilmForce() override;

  /// As it stands in messages and results.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// How its surfaces lie to each other; at the motion evaluated last.
  [[nodiscard]] const GapKinematics& gap() const { return *gap_; }
  /// Of the film; constant.
  [[nodiscard]] const film::FilmModel& model() const { return reynolds_.model(); }
  /// As asked for; a step may be taken as one system all the same.
  [[nodiscard]] Coupling coupling() const { return options_.coupling; }

  /// With motion.dt = 0 (start of a run) the film is solved to the end instead: freshly filled, theta = 1 before a step
  /// of options.initial_dt, so that a node is full or just emptying.
  void evaluate(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) override;
  void begin_step(const mbd::RelativeMotion& start, double dt) override;
  /// False where the oil that has come in over the step fills another film than the one found: that follows the change
  /// of the gap over the step instead of its rate (theory manual, film.15).
  [[nodiscard]] bool is_step_consistent() override;
  void accept_step(const mbd::RelativeMotion& end) override;
  [[nodiscard]] bool is_costly() const override { return true; }
  [[nodiscard]] bool has_tangent() const override { return options_.coupling == Coupling::monolithic; }
  [[nodiscard]] bool has_condensed_unknowns() const override { return true; }
  [[nodiscard]] double internal_residual() const override { return internal_residual_; }
  [[nodiscard]] std::string name_of_internal_residual() const override;
  [[nodiscard]] std::string domain_error() const override { return domain_error_; }
  void persist(Archive& archive) override;

  /// A cycle of the machine has ended with the step last accepted: as film::FilmHeat::mean_exchange().
  const film::WallExchange& mean_exchange();
  /// Likewise film::FilmHeat::settle_walls().
  void settle_walls(const Eigen::VectorXd& T_nodes);
  /// Of a film with temperatures; null: it has one.
  [[nodiscard]] const film::FilmHeat* heat() const { return heat_ ? &*heat_ : nullptr; }
  /// After a step has been accepted: likewise film::FilmHeat::move_walls().
  void move_walls(const Eigen::VectorXd& T);
  /// What temperatures have come to at the state last accepted, where no film goes on from there: a clearance that they
  /// close, or oil that warms without bound, and where. Empty: nothing of that.
  /// @param closed  share of the clearance as given below which it counts as closed [-]
  [[nodiscard]] std::string thermal_trouble(double closed) const;

  /// Everything to report at the state last accepted (or initialised).
  [[nodiscard]] BearingObservation observe(const mbd::RelativeMotion& motion) const;

  /// Fields at the nodes at the state last accepted.
  [[nodiscard]] film::FilmFields fields() const;

 private:
  void place(const mbd::RelativeMotion& motion);
  void feed(double t);
  void report_contact();
  [[nodiscard]] double smallest_gap() const;
  void report(const film::FilmDomain& domain);
  void fill_gap();
  void settle();
  void close_step();
  void show_oil(film::FilmObservables& film) const;
  [[nodiscard]] double growth_by_temperature() const;
  [[nodiscard]] Eigen::VectorXd journal_shape_by_temperature() const;
  void follow_surfaces();
  [[nodiscard]] film::FilmDomain linearise_film();
  void evaluate_monolithic(bool want_tangent, mbd::ForceResponse& response);
  void evaluate_partitioned(mbd::ForceResponse& response);
  void condense_film(mbd::ForceResponse& response);
  [[nodiscard]] double summed_forces() const;
  void increment_film(mbd::ForceResponse& response);  // forces after the film's increment at fixed surfaces

  std::string name_;
  BearingOptions options_;
  film::Reynolds reynolds_;
  std::optional<film::FilmHeat> heat_;  // at the state last accepted
  film::WallCorrection walls_;
  std::unique_ptr<ThermalShape> thermal_shape_, journal_shape_;  // of a shell and a journal in bodies
  std::unique_ptr<ClearanceGrowth> growth_;
  std::unique_ptr<GapKinematics> gap_;
  std::unique_ptr<DeformingSurfaces> deforming_;
  film::SurfaceMotion surfaces_;
  film::SurfaceMotion observed_surfaces_;  // at the state last accepted
  Eigen::VectorXd observed_s_;
  Eigen::Index gap_parameter_count_;               // parameters of the gap
  Eigen::VectorXd parameters_;                     // those, amplitudes of the surfaces' shapes, and their rates
  std::vector<film::MotionDirection> directions_;  // one per parameter

  // The film in the current step: unknowns, their increment, and where (in parameters) they were last linearised.
  Eigen::VectorXd u_, u_linearised_, du_;
  Eigen::VectorXd parameters_linearised_, parameter_change_;
  film::CondensedFilm condensed_;
  bool linearised_ = false;
  bool is_thinned_ = false;  // the layers' shear has been found at the start

  // The film at the start of the step: what a rejected step returns to.
  film::FilmHistory history_;           // of the step being solved
  film::FilmHistory history_start_;     // what the next step starts from
  film::FilmHistory observed_history_;  // of the step last accepted
  Eigen::VectorXd u_start_;

  // Partitioned: the wrench on the journal and the forces on shapes that the bodies have been given.
  solver::FixedPointIteration interface_;
  Eigen::VectorXd interface_wrench_, interface_wrench_start_;
  bool has_interface_response_ = false;
  bool exchange_has_ended_ = false;
  int monolithic_steps_left_ = 0;   // before exchanging is tried again
  bool is_monolithic_step_ = true;  // the step is solved monolithically

  // Oil of the step last accepted, and over the run.
  film::StepOilBalance oil_;
  CumulativeOilBalance oil_of_run_;
  bool started_ = false;
  bool settled_ = false;  // oil_ belongs to the film evaluated last

  double internal_residual_ = 0;
  int iterations_ = 0, exchanges_ = 0;
  int observed_iterations_ = 0, observed_exchanges_ = 0;
  std::string domain_error_;
};

}  // namespace hersey::bearing
