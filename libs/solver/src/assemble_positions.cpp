#include "assemble_positions.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace hersey::solver {
namespace {

using Eigen::VectorXd;
using Index = Equations::Index;
using SparseMatrix = Equations::SparseMatrix;

// The largest increment of one coordinate [rad, or sizes]: half a radian keeps a joint on its branch.
constexpr double kLargestIncrement = 0.5;
constexpr double kSmallestDamping = 1e-14;
constexpr double kLargestDamping = 1e8;

/// The constraints at one configuration, in units of their scales.
struct Residual {
  VectorXd phi;
  SparseMatrix G;
  [[nodiscard]] double size() const { return phi.norm(); }
  [[nodiscard]] double largest() const { return phi.size() > 0 ? phi.lpNorm<Eigen::Infinity>() : 0; }
};

Residual residual_at(Equations& equations, const State& state, const VectorXd& mobility) {
  Residual r;
  VectorXd scale;
  equations.constraints(state, r.phi, scale, &r.G);
  r.phi = r.phi.cwiseQuotient(scale);
  r.G = scale.cwiseInverse().asDiagonal() * r.G * mobility.asDiagonal();
  return r;
}

/// z = -G^T (G G^T + damping)^-1 phi, no longer than allowed (integrator.21).
bool damped_increment(const Residual& r, double damping, VectorXd& z) {
  SparseMatrix normal = r.G * SparseMatrix(r.G.transpose());
  SparseMatrix identity(normal.rows(), normal.cols());
  identity.setIdentity();
  normal += damping * identity;
  const Eigen::SimplicialLDLT<SparseMatrix> factor(normal);
  if (factor.info() != Eigen::Success) return false;
  z = -(r.G.transpose() * VectorXd(factor.solve(r.phi)));
  if (!z.allFinite()) return false;
  if (const double largest = z.lpNorm<Eigen::Infinity>(); largest > kLargestIncrement) z *= kLargestIncrement / largest;
  return true;
}

}  // namespace

ClosureResult close_constraints(Equations& equations, State& state, const VectorXd& mobility,
                                const InitialiseOptions& options) {
  constexpr double stalled = 1e-9;
  const VectorXd reach = mobility.cwiseProduct(equations.position_scales());
  ClosureResult result;
  State trial = state;
  Residual here = residual_at(equations, state, reach);
  double damping = 1e-3;
  VectorXd z;
  for (;; ++result.iterations) {
    result.residual = here.largest();
    if (result.residual <= options.rtol) break;
    const bool is_closest = (here.G.transpose() * here.phi).norm() <= stalled * here.size();
    if (result.iterations == options.max_iterations || is_closest || !here.phi.allFinite()) return result;
    if (damped_increment(here, damping, z)) {
      equations.retract(state.q, reach.cwiseProduct(z), trial.q);
      Residual there = residual_at(equations, trial, reach);
      if (there.size() < here.size()) {
        state.q = trial.q;
        here = std::move(there);
        // Near the solution the damping vanishes with the square of the residual.
        damping = std::max(std::min(0.2 * damping, here.phi.squaredNorm()), kSmallestDamping);
        continue;
      }
      if (here.largest() <= 1e3 * options.rtol) break;  // round-off: no increment improves it further
    }
    damping *= 10;
    if (damping > kLargestDamping) return result;
  }
  result.closed = true;
  return result;
}

void disturb(const Equations& equations, State& state, const VectorXd& mobility) {
  const VectorXd scales = equations.position_scales().cwiseProduct(mobility);
  VectorXd dq(equations.nv()), q;
  for (Index k = 0; k < dq.size(); ++k) dq[k] = 0.1 * scales[k] * std::sin(1.0 + 2.3 * static_cast<double>(k));
  equations.retract(state.q, dq, q);
  state.q = q;
}

}  // namespace hersey::solver
