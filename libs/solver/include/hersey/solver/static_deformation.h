#pragma once

#include "hersey/core/outcome.h"
#include "hersey/solver/initialise.h"

namespace hersey::solver {

/// Outcome of `settle_deformations`. If it is not solved, the state is unchanged.
struct [[nodiscard]] StaticDeformationSummary : Outcome {
  int iterations = 0;   ///< iterations of Newton's method
  double residual = 0;  ///< largest row residual relative to its tolerance
};

/// Computes the static deformation of elastic bodies under the forces at the start, so that a run does not begin with
/// the vibrations of bodies released undeformed. The deformations and multipliers are those without elastic
/// accelerations,
///
///     r(q, v, vdot, lambda) = 0,    Phi(q) = 0,    G v + Phi_t = 0,    G vdot + gamma = 0,
///     v_e = vdot_e = 0 for the deformations e, q, v of the free rigid motions unchanged,
///
/// theory manual eq. (integrator.23). The rigid motions keep their accelerations: a body may fall or spin. Forces that
/// depend on the deformation, such as films, contribute their tangent to Newton's method. Ends with begin_step /
/// accept_step of zero length.
/// @param state    consistent, as computed by `initialise`
/// @param options  `stiff`: the deformations; `fixed`: other components that keep their positions if the constraints
/// allow it
/// @pre every deformation has a stiffness
/// @cost per iteration two assemblies and one sparse factorisation; once a dense QR of G
[[nodiscard]] StaticDeformationSummary settle_deformations(Equations& equations, State& state,
                                                           const InitialiseOptions& options);

}  // namespace hersey::solver
