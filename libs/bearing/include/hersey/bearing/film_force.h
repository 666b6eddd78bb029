#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/bearing/elastic_surface.h"
#include "hersey/bearing/film_inertia.h"
#include "hersey/bearing/film_observation.h"
#include "hersey/bearing/gap_kinematics.h"
#include "hersey/bearing/wear.h"
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
  double relaxation = 0.1;                 ///< partitioned: under-relaxation of the first iteration, in (0, 1]
  /// The film's own solver: initial film, and every film solve of a partitioned coupling. `multigrid` also solves the
  /// linear systems of a monolithic one.
  film::FilmSolveOptions film;
  double initial_dt = 1e-4;  ///< the film at the start follows from a gap filled this long before [s], > 0
  double initial_fill = 1;   ///< share of that gap which was oil [-], in [0, 1]; below 1 with conserved mass only
  /// With motion.dt = 0, solve the steady film of the surfaces' present motion instead of that of a freshly filled gap:
  /// for machines at rest or in steady motion, and for small motions about it. A partitioned coupling is monolithic
  /// there. Temperatures of a `thermal` film do not move with those motions: a steady state of both is found by turns,
  /// with temperatures() and set_temperatures().
  bool starts_steady = false;
  /// Supply pressure over time of each groove, hole or pocket of the film model [Pa]; empty: constant, as in the model.
  std::vector<std::shared_ptr<const ScalarFunction>> feature_pressures = {};
  /// Features of the film model whose pressure, or that before their restrictor, is not given but a circuit's: the
  /// ports of the film, in this order. Monolithic only.
  std::vector<std::size_t> circuit_ports = {};
  /// Thermal model of the film, whose temperatures are advanced at each accepted step; unset: an isothermal film at the
  /// model's temperature.
  std::optional<film::ThermalModel> thermal = {};
  double growth = 0;                                ///< thermal change of the clearance of an isothermal film [m]
  std::optional<WearModel> wear = {};               ///< of both surfaces, in time; unset: none
  std::shared_ptr<CommonSurface> common = {};       ///< the moving one, where other films wear it, too; null: none do
  std::shared_ptr<const FilmInertia> inertia = {};  ///< of the oil; null: the film's forces are those without inertia
  /// Surfaces of elastic bodies; null: rigid. Their amplitudes come with the motion, the shell's before the journal's.
  std::shared_ptr<const ElasticSurface> shell_surface, journal_surface;
};

/// Film with which a run begins in place of a freshly filled gap at the temperature of the supply.
struct FilmAtStart {
  Eigen::VectorXd fill;                 ///< share of the gap that is oil [-], in [0, 1], shape (grid.size())
  std::optional<film::HeatState> heat;  ///< of a film with temperatures
  double growth = 0;                    ///< of its clearance by temperature [m]
};

class DeformingSurfaces;
class FilmElement;
class SurfaceShape;
class ThermalSurfaces;
class WearingSurfaces;
class WrenchExchange;

/// An oil film between the surfaces of a shell frame A and of a journal frame B (theory manual, chapter bearing), whose
/// gap is that of a GapKinematics. The surfaces are rigid, or belong to elastic bodies whose shapes move them.
///
/// Ports that a circuit feeds are parameters like those of the surfaces, after them.
///
/// Monolithic: `evaluate` takes one Newton step of the film together with the bodies. The film's unknowns u follow the
/// change of the surfaces since the last call through the last linearisation, u += du0 + (du/ds) (s - s_last), are
/// linearised anew, and the wrench is returned with the film eliminated: the exact Schur complement of the full system.
/// Partitioned: `evaluate` takes the surfaces to be the bodies' answer to the wrench it returned last, solves the film
/// there to the end, corrects the wrench by what the film says (FixedPointIteration) and returns it without
/// derivatives. If this iteration does not converge, the step is repeated, shorter and monolithic, and so are some
/// steps after it: `exchanges` of their observations is 0.
class FilmForce : public mbd::TwoBodyForce {
 public:
  /// @param name  as it stands in messages and results
  /// @throws ContractError for a model that describes no film, as film::Reynolds
  FilmForce(std::string name, const film::FilmModel& model, std::unique_ptr<GapKinematics> gap,
            const BearingOptions& options = {});
  ~FilmForce() override;

  /// Name of the bearing in messages and results.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Kinematics of its surfaces, at the motion evaluated last.
  [[nodiscard]] const GapKinematics& gap() const { return *gap_; }
  /// The film's constant data.
  [[nodiscard]] const film::FilmModel& model() const;
  /// Where its computing time has gone, surfaces and temperatures apart.
  [[nodiscard]] film::FilmWork work() const;
  /// The coupling of the options. A single step may be monolithic in a partitioned coupling, too.
  [[nodiscard]] Coupling coupling() const { return options_.coupling; }

  /// With motion.dt = 0 (start of a run) the film is solved to the end instead: from theta = 1 everywhere a time
  /// options.initial_dt before, so that a node is full or just emptying; steady with options.starts_steady.
  void evaluate(const mbd::RelativeMotion& motion, bool want_tangent, mbd::ForceResponse& response) override;
  void begin_step(const mbd::RelativeMotion& start, double dt) override;
  /// False if the oil balance over the step contradicts the film found with the gap's rate at its end. The step is then
  /// solved again with the change of the gap over the step in place of the rate (theory manual, film.15).
  [[nodiscard]] bool is_step_consistent() override;
  void accept_step(const mbd::RelativeMotion& end) override;
  [[nodiscard]] bool is_costly() const override { return true; }
  [[nodiscard]] bool has_tangent() const override {
    return options_.coupling == Coupling::monolithic || options_.starts_steady;
  }
  [[nodiscard]] bool has_condensed_unknowns() const override { return true; }
  [[nodiscard]] bool needs_tangent() const override { return !is_monolithic_step_; }
  [[nodiscard]] double internal_residual() const override { return internal_residual_; }
  [[nodiscard]] std::string name_of_internal_residual() const override;
  [[nodiscard]] std::string domain_error() const override { return domain_error_; }
  void persist(Archive& archive) override;
  [[nodiscard]] double kinetic_energy(const mbd::RelativeMotion& motion) const override {
    return options_.inertia ? options_.inertia->energy(motion) : 0;
  }

  // Ports that a circuit feeds. An evaluation then has three parts: follow() for all films of a circuit, their
  // pressures, evaluate(), and complete() once the circuit has been condensed (OilCircuit).

  /// Number of ports that a circuit feeds.
  [[nodiscard]] Eigen::Index port_count() const { return static_cast<Eigen::Index>(options_.circuit_ports.size()); }
  /// Evaluates the surfaces at a motion; evaluate() takes them from here.
  void follow(const mbd::RelativeMotion& motion);
  /// Returns the parameters that move the surfaces, pressures of ports apart, at the last evaluation of these.
  [[nodiscard]] Eigen::VectorXd surface_parameters() const {
    return parameters_.head(parameters_.size() - port_count());
  }
  /// Returns what has changed of them since they were `from`; angles by less than half a revolution.
  [[nodiscard]] Eigen::VectorXd change_of_parameters(const Eigen::VectorXd& from) const;
  /// Sets the pressures of the ports [Pa]; below p_cav they say by (film.5) how full the oil is that comes there.
  void set_port_pressures(const Eigen::VectorXd& p);
  /// Oil that enters through each port after the film's increment [m^3/s], and its derivatives by surface_parameters()
  /// and by the pressures of ports.
  struct PortAnswer {
    Eigen::VectorXd flow;
    Eigen::MatrixXd by_parameters, by_pressure;
  };
  [[nodiscard]] PortAnswer port_answer() const;  ///< that of the last evaluation
  /// Completes the response of the last evaluation.
  /// @param dp  by which pressures of ports are to change [Pa]
  /// @param dp_by_parameters  their derivatives by surface_parameters()
  void complete(const Eigen::VectorXd& dp, const Eigen::MatrixXd& dp_by_parameters, mbd::ForceResponse& response);

  /// Returns film::FilmHeat::mean_heat_flow() of the cycle of the machine that ended with the step last accepted.
  const film::WallHeatFlow& mean_heat_flow();
  /// Calls film::FilmHeat::settle_walls() at the end of a cycle.
  void settle_walls(const Eigen::VectorXd& T_nodes);
  /// Temperatures of the film; null: the film is isothermal.
  [[nodiscard]] const film::FilmHeat* heat() const;
  /// Returns the temperatures on which the film's pressure depends, and the growth of its clearance as one, as unknowns
  /// of the alternate solution of film and heat: rises [K]. Those of a film that starts steady are, after a state has
  /// been accepted, what that film makes.
  [[nodiscard]] Eigen::VectorXd temperatures() const;
  /// Sets these; what is evaluated next has their viscosities.
  void set_temperatures(const Eigen::VectorXd& x);
  /// Reduces temperatures that a film without warm oil has made, as the oil thins while it warms (film::first_guess).
  void guess_temperatures();
  /// Sets the oil that ends of the film's patches draw in (film::FilmHeat::set_ends).
  void set_ends(std::vector<film::EndOil> ends);
  /// Calls film::FilmHeat::move_walls() after a step has been accepted.
  void move_walls(const Eigen::VectorXd& T);
  /// Describes, at the state last accepted, a clearance that temperatures close, or oil that warms without bound, and
  /// where; empty if neither is the case.
  /// @param closed  fraction of the clearance as given below which it counts as closed [-]
  [[nodiscard]] std::string thermal_failure(double closed) const;
  /// Names a lining that has been worn off at the state last accepted; empty where there is none.
  [[nodiscard]] std::string wear_failure() const;

  /// Puts the surfaces of the state last accepted where those of `motion` are: where a film restored by persist() is
  /// observed before a step has led to it.
  void place_surfaces(const mbd::RelativeMotion& motion);

  /// Returns all figures of the state last accepted (or initialised).
  [[nodiscard]] BearingObservation observe(const mbd::RelativeMotion& motion) const;

  /// Returns the fields at the nodes at the state last accepted.
  [[nodiscard]] film::FilmFields fields() const;

  /// Returns that film, with which a run on another grid can begin (theory manual, integrator.42). @param grid  of the
  /// other film, with patches as those of this one
  [[nodiscard]] FilmAtStart on_grid(const film::Grid& grid) const;
  /// Begins with a film: the next evaluation with motion.dt = 0 finds the film into which it develops within
  /// options.initial_dt. @throws ContractError on a wrong shape
  void begin_from(const FilmAtStart& start);

 private:
  void evaluate_surfaces(const mbd::RelativeMotion& motion);
  void set_supply_pressures(double t);
  void report_contact();
  void report(const film::FilmDomain& domain);
  [[nodiscard]] double smallest_gap() const;
  [[nodiscard]] double summed_forces() const;
  void start_film();
  [[nodiscard]] double heat_of_growth() const;
  void evaluate_monolithic(bool want_tangent, mbd::ForceResponse& response);
  void evaluate_partitioned(mbd::ForceResponse& response);
  void condense_film(mbd::ForceResponse& response);
  void respond(mbd::ForceResponse& response);

  std::string name_;
  BearingOptions options_;
  std::unique_ptr<GapKinematics> gap_;
  std::unique_ptr<FilmElement> film_;
  std::vector<std::unique_ptr<SurfaceShape>> shapes_;  // all that moves the surfaces beyond `gap_`
  ThermalSurfaces* thermal_;                           // of `shapes_`, as what follows
  DeformingSurfaces* deforming_;
  WearingSurfaces* wearing_ = nullptr;  // null: surfaces do not wear
  std::unique_ptr<WrenchExchange> exchange_;
  bool is_monolithic_step_ = true;

  // The surfaces, and the parameters that move them: those of the gap, amplitudes of the surfaces' shapes, their rates.
  film::SurfaceMotion surfaces_;
  Eigen::Index gap_parameter_count_;
  Eigen::VectorXd parameters_;
  std::vector<film::MotionDirection> directions_;  // one per parameter
  film::CondensedFilm* condensed_ = nullptr;       // of the last evaluation with derivatives
  Eigen::VectorXd port_pressures_;                 // of ports that a circuit feeds
  bool has_followed_ = false;                      // the surfaces are those of the evaluation to come

  // The state last accepted.
  film::SurfaceMotion accepted_surfaces_;
  Eigen::VectorXd accepted_s_;
  film::WallCorrection walls_;
  int accepted_iterations_ = 0, accepted_exchanges_ = 0;

  double internal_residual_ = 0;
  std::string domain_error_;
};

}  // namespace hersey::bearing
