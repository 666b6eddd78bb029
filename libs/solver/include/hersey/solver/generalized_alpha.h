#pragma once

#include <memory>

#include "hersey/solver/equations.h"
#include "hersey/solver/integrator.h"

namespace hersey::solver {

/// Options of generalized-alpha and of its Newton iteration.
struct GeneralizedAlphaOptions {
  double spectral_radius = 0.8;  ///< amplification of the highest frequencies per step [-], 0..1; 1 dissipates nothing
  double rtol = 1e-8;            ///< residual of every row, relative to the terms it balances
  int max_iterations = 50;       ///< Newton iterations per step
  int max_halvings = 12;         ///< halvings of one increment that leaves the domain of the equations
  /// Relative residual allowed in condensed equations if it is larger than `rtol`; used for films in steps chosen by
  /// their error.
  double condensed_rtol = 0;
  /// True if the lengths of steps with a StepCheck are chosen by their error. Such steps end on the constraints,
  /// (integrator.13), and are solved to a share of their error, (integrator.19). If false, a StepCheck does not change
  /// the step itself.
  bool chosen_by_error = true;
  /// For steps that are not chosen by their error: after a change of step length velocities and accelerations are
  /// projected onto the constraints (theory manual, integrator.16). For runs whose steps are cut hundreds of times, as
  /// with films.
  bool returns_to_constraints = false;
};

/// Generalized-alpha for constrained mechanical systems of index 3 on a Lie group (theory manual, chapter integrator).
///
/// Second order in positions and velocities, and in multipliers once the transient of the start has faded. The step
/// length may change between steps, even alternate by factors of up to 2; larger factors repeated step after step
/// amplify errors of the multipliers, unless steps are chosen by their error: these may change by any factor. The
/// algorithmic acceleration a_n approximates vdot(t_n + (alpha_m - alpha_f) dt); it is a member of the integrator and
/// is rescaled when dt changes.
///
/// @see Chung and Hulbert (1993), J. Appl. Mech. 60, 371-375; Arnold and Bruels (2007), Multibody Syst. Dyn. 18,
///      185-202; Bruels, Cardona and Arnold (2012), Mech. Mach. Theory 48, 121-137.
/// @verified_by generalized_alpha_test.cpp
class GeneralizedAlpha final : public Integrator {
 public:
  /// @pre 0 <= spectral_radius <= 1, rtol > 0, max_iterations > 0.
  explicit GeneralizedAlpha(const GeneralizedAlphaOptions& options = {});
  ~GeneralizedAlpha() override;
  GeneralizedAlpha(GeneralizedAlpha&&) noexcept;
  GeneralizedAlpha& operator=(GeneralizedAlpha&&) noexcept;

  void reset() override;
  void solve_to_round_off(bool is_on) override { has_last_corrections_ = is_on; }

  /// Advances `state` by `dt` > 0, film and other condensed unknowns included.
  /// @throws InputError if spectral_radius is 1, the equations have constraints and the step is not chosen by its
  /// error: the multipliers are then unstable.
  /// @cost per iteration one assembly, one sparse factorisation, one solve.
  [[nodiscard]] StepSummary step(Equations& equations, State& state, double dt);

  /// Advances `state` by `dt` and accepts the step only if `is_accurate` returns true for its local error (theory
  /// manual eq. (integrator.11)); otherwise the step is `inaccurate`, and state, condensed unknowns and history are
  /// those before it.
  [[nodiscard]] StepSummary step(Equations& equations, State& state, double dt, const StepCheck& is_accurate) override;

  [[nodiscard]] double linear_solve_time() const override;

  /// Saves or restores the history and the pivot order in use.
  void persist(Archive& archive) override;

  /// Returns the options given to the constructor.
  [[nodiscard]] const GeneralizedAlphaOptions& options() const { return options_; }

 private:
  /// Where the iteration of a step begins: at the prediction, to which the error of the step refers, or where the
  /// acceleration would go on as over the last step.
  enum class IterationStart { prediction, beyond };
  [[nodiscard]] StepSummary attempt(Equations& equations, State& state, double dt, const StepCheck& is_accurate,
                                    IterationStart begins);

  struct Workspace;
  GeneralizedAlphaOptions options_;
  bool has_last_corrections_ = false;
  std::unique_ptr<Workspace> work_;
};

}  // namespace hersey::solver
