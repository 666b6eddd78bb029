#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>

#include "hersey/core/archive.h"
#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Status of a step.
enum class StepStatus { no_convergence, domain_error, singular, inaccurate, converged };

/// Outcome of one step. If it is not solved, the state is that at the start of the step.
struct [[nodiscard]] StepSummary : OutcomeOf<StepStatus, StepStatus::converged> {
  int iterations = 0;     ///< Newton iterations spent
  double residual = 0;    ///< largest residual relative to the tolerance of this step, <= 1 when solved
  std::string worst_row;  ///< name of the row with `residual`; empty when solved
};

/// Function that returns whether a solved step is accurate enough. Its arguments are the state at the end of the step
/// and the estimated error of position: an increment of position, shape (nv), from the end of the step to the exact
/// solution.
using StepCheck = std::function<bool(const State& end, const Eigen::VectorXd& error)>;

/// Interface of a method that advances the state of a mechanical system step by step.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Discards the history: the next step starts from its state alone, whose vdot must be consistent (see initialise).
  /// Call it after every discontinuous change of the state or the equations.
  virtual void reset() {}

  /// True: from now on steps end with Newton's corrections by the exact tangent at their solution, beyond the tolerance
  /// and down to round-off (theory manual, after integrator.46). For neighbours of a step, whose difference is a
  /// derivative; they do not have the bits of a step to its tolerance. A method without iterations has nothing to do.
  virtual void solve_to_round_off(bool /*is_on*/) {}

  /// Advances `state` by `dt` > 0 and accepts the step only if `is_accurate`, where it is not empty, returns true for
  /// the estimate of its local error; otherwise the step is `inaccurate`, and everything is as before it.
  [[nodiscard]] virtual StepSummary step(Equations& equations, State& state, double dt,
                                         const StepCheck& is_accurate) = 0;

  /// Returns the computing time spent so far on factorising and solving linear systems [s].
  [[nodiscard]] virtual double linear_solve_time() const = 0;

  /// Saves or restores all that later steps depend on beside the state.
  virtual void persist(Archive& archive) = 0;
};

}  // namespace hersey::solver
