#pragma once

#include "hersey/core/outcome.h"
#include "hersey/solver/initialise.h"

namespace hersey::solver {

/// Outcome of `settle_deformations`. Unless it is solved the state is unchanged.
struct [[nodiscard]] StaticDeformationSummary : Outcome {
  int iterations = 0;   ///< of Newton's method
  double residual = 0;  ///< largest row residual relative to its tolerance
};

/// Deforms what is elastic as the forces at the start hold it, so that a run does not begin with the vibrations of
/// bodies let go undeformed: deformations and multipliers with which nothing elastic is accelerated,
///
///     r(q, v, vdot, lambda) = 0,    Phi(q) = 0,    G v + Phi_t = 0,    G vdot + gamma = 0,
///     v_e = vdot_e = 0 of the deformations e,    q, v of the free rigid motions as they are,
///
/// theory manual eq. (integrator.23). The rigid motions keep their accelerations: a body may fall or spin. Forces that
/// depend on the deformation, a film among them, take part in Newton's method with their tangent. Ends with begin_step
/// / accept_step of zero length.
/// @param state    consistent, as `initialise` leaves it
/// @param options  `stiff`: the deformations; `held`: other components that keep their positions if the constraints
/// allow
/// @pre every deformation has a stiffness
/// @cost per iteration two assemblies and one sparse factorisation; once a dense QR of G
[[nodiscard]] StaticDeformationSummary settle_deformations(Equations& equations, State& state,
                                                           const InitialiseOptions& options);

}  // namespace hersey::solver
