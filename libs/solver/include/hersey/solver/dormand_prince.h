#pragma once

#include <memory>

#include "hersey/solver/integrator.h"

namespace hersey::solver {

/// Options of the explicit method.
struct DormandPrinceOptions {
  int max_iterations = 50;  ///< corrections of positions per step until the constraints are satisfied
};

/// The explicit Runge-Kutta method of order eight by Dormand and Prince for constrained mechanical systems without
/// condensed unknowns (theory manual eq. (integrator.37) to (integrator.41)).
///
/// The accelerations are those of the equations with twice differentiated constraints, and positions and velocities are
/// projected onto the constraints at the end of every step. Positions, velocities, accelerations and multipliers are of
/// order eight. The step is limited by the fastest motion, by about 6 over its rate, also where this motion has died
/// out: stiff springs, strong dampers and deformable bodies are for GeneralizedAlpha. No history beside the state:
/// steps may change by any factor.
///
/// @see Hairer, Noersett and Wanner (1993), Solving Ordinary Differential Equations I, II.5 (coefficients, estimate of
///      the error); Munthe-Kaas (1999), Appl. Numer. Math. 29, 115-127 (rotations); Hairer and Wanner (1996), Solving
///      Ordinary Differential Equations II, VII.2 (projection).
/// @verified_by dormand_prince_test.cpp
class DormandPrince final : public Integrator {
 public:
  /// @pre max_iterations > 0
  explicit DormandPrince(const DormandPrinceOptions& options = {});
  ~DormandPrince() override;
  DormandPrince(DormandPrince&&) noexcept;
  DormandPrince& operator=(DormandPrince&&) noexcept;

  /// Advances `state`, whose accelerations must be consistent (see initialise), by `dt` > 0 and accepts the step only
  /// if `is_accurate`, where it is not empty, returns true for the estimate of its error. Otherwise the step is
  /// `inaccurate`, and the state is that before it. The summary's iterations are evaluations of the equations.
  /// @pre the equations have no condensed unknowns
  /// @cost twelve assemblies and factorisations of the mass matrix with the constraints; no allocation after the first
  ///       step
  [[nodiscard]] StepSummary step(Equations& equations, State& state, double dt, const StepCheck& is_accurate) override;

  [[nodiscard]] double linear_solve_time() const override;

  /// Saves or restores the pivot order in use.
  void persist(Archive& archive) override;

 private:
  struct Workspace;
  DormandPrinceOptions options_;
  std::unique_ptr<Workspace> work_;
};

}  // namespace hersey::solver
