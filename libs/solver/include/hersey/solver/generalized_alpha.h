#pragma once

#include <Eigen/Dense>
#include <functional>
#include <memory>
#include <string>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// How generalized-alpha steps and when its Newton iteration has converged.
struct GeneralizedAlphaOptions {
  double spectral_radius = 0.8;  ///< amplification of the highest frequencies per step [-], 0..1; 1 dissipates nothing
  double rtol = 1e-8;            ///< residual of every row, relative to the terms it balances
  int max_iterations = 50;       ///< Newton iterations per step
  int max_halvings = 12;         ///< halvings of one increment that leaves the domain of the equations
  /// Of condensed equations where it is larger than `rtol`: what steps chosen by their error may leave of a film.
  double condensed_rtol = 0;
  /// Whether judged steps are chosen by their error: these end on the constraints, (integrator.13), and are solved to a
  /// share of their error, (integrator.19). Judged steps of a given length stay what they are without a judge.
  bool chosen_by_error = true;
  /// Without that: a step of another length than the one before ends on the constraints, velocities and accelerations
  /// (theory manual, integrator.16). For steps that are cut hundreds of times, as with films.
  bool returns_to_constraints = false;
};

/// How a step ended.
enum class StepStatus { no_convergence, domain_error, singular, inaccurate, converged };

/// Outcome of one step. Unless it is solved the state is the one the step started from.
struct [[nodiscard]] StepSummary : OutcomeOf<StepStatus, StepStatus::converged> {
  int iterations = 0;     ///< Newton iterations spent
  double residual = 0;    ///< largest residual relative to what this step may leave, <= 1 when solved
  std::string worst_row;  ///< the row behind `residual`, by name; empty when solved
};

/// Says whether a solved step is accurate enough, from the state it ends in and the estimate of its error of position:
/// an increment of position, shape (nv), from the end of the step to where the exact motion would have ended.
using StepCheck = std::function<bool(const State& end, const Eigen::VectorXd& error)>;

/// Generalized-alpha for constrained mechanical systems of index 3 on a Lie group (theory manual, chapter integrator).
///
/// Second order in positions and velocities, and in multipliers once the transient of the start has faded. The step
/// length may change between steps, even alternate by factors of up to 2; larger factors repeated step after step
/// amplify errors of the multipliers, unless steps are chosen by their error: these may change as they like. The
/// algorithmic acceleration a_n approximates vdot(t_n + (alpha_m - alpha_f) dt); it lives here and is rescaled when dt
/// changes.
///
/// @see Chung and Hulbert (1993), J. Appl. Mech. 60, 371-375; Arnold and Bruels (2007), Multibody Syst. Dyn. 18,
///      185-202; Bruels, Cardona and Arnold (2012), Mech. Mach. Theory 48, 121-137.
/// @verified_by generalized_alpha_test.cpp
class GeneralizedAlpha {
 public:
  /// @pre 0 <= spectral_radius <= 1, rtol > 0, max_iterations > 0.
  explicit GeneralizedAlpha(const GeneralizedAlphaOptions& options = {});
  ~GeneralizedAlpha();
  GeneralizedAlpha(GeneralizedAlpha&&) noexcept;
  GeneralizedAlpha& operator=(GeneralizedAlpha&&) noexcept;

  /// Forgets the history: the next step starts afresh from its state, whose vdot must be consistent (see initialise).
  /// Call it after anything that changes the state or the equations discontinuously.
  void reset();

  /// Advances `state` by `dt` > 0, film and other condensed unknowns included.
  /// @throws InputError if spectral_radius is 1, the equations have constraints and the step is not chosen by its
  /// error: the multipliers are then unstable.
  /// @cost per iteration one assembly, one sparse factorisation, one solve.
  [[nodiscard]] StepSummary step(Equations& equations, State& state, double dt);

  /// The same, kept only if `judge` finds the step's local error (theory manual eq. (integrator.11)) small enough;
  /// otherwise the step is `inaccurate`, and state, condensed unknowns and history are those before it.
  [[nodiscard]] StepSummary step(Equations& equations, State& state, double dt, const StepCheck& judge);

  /// Computing time of factorising and solving linear systems so far [s].
  [[nodiscard]] double linear_solve_time() const;

  /// The history, and the pivot order in use.
  void persist(Archive& archive);

  /// As given.
  [[nodiscard]] const GeneralizedAlphaOptions& options() const { return options_; }

 private:
  struct Workspace;
  GeneralizedAlphaOptions options_;
  std::unique_ptr<Workspace> work_;
};

}  // namespace hersey::solver
