#include "fast_motions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kkt.h"
#include "sparse_kkt.h"

namespace hersey::solver {
namespace {

using Eigen::VectorXd;
using Index = Equations::Index;

// Tolerance relative to the terms that a row balances. The combination below amplifies residuals about a hundred times.
constexpr double kSettledTolerance = 1e-10;
constexpr int kSettlingIterations = 30, kSettlingHalvings = 8;

// A motion of which z = C dt/M is less is left to the integrator: it follows motions that end some tens of times sooner
// than the step with its own order.
constexpr double kResolved = 49;
// z/(1 + z) of such a motion in a part 1/kResolved of the step.
constexpr double kFast = 0.5;
// Accelerations below this part of the whole are round-off.
constexpr double kFloor = 1e-6;
constexpr int kPowers = 20;

// w^2 (15 - 40 w + 45 w^2 - 24 w^3 + 5 w^4), theory manual eq. (integrator.9): the share of implicit Euler step k.
constexpr std::array<double, 6> kShares{0, 15, -40, 45, -24, 5};

/// Implicit Euler steps of the velocities alone (integrator.8). Inertia forces keep the velocities of the start:
/// undamped motions then have the same acceleration in all steps and remain unchanged, independent of the mass of the
/// body and of the bodies that it carries; with velocities that grow from step to step, forces quadratic in them would
/// be extrapolated by the shares.
class VelocitySteps {
 public:
  VelocitySteps(Equations& equations, const State& start, double dt)
      : equations_(equations), nv_(equations.nv()), dt_(dt), trial_(start) {
    VectorXd phi, scale, velocity;
    equations.constraints(start, phi, scale, &G_);
    equations.constraint_rates(start, velocity, bias_);
  }

  /// Computes the acceleration at the end of a step of length `span` from velocity v; returns false if there is none.
  bool solve(const VectorXd& v, double span) {
    if (!evaluate(v, span)) return false;
    for (int iteration = 0; worst_ > kSettledTolerance; ++iteration) {
      if (iteration == kSettlingIterations || !advance(v, span)) return false;
    }
    return true;
  }

  /// Resets the initial guess of the acceleration to zero.
  void begin_at_rest(const State& start) {
    trial_.vdot.setZero();
    trial_.lambda = start.lambda;
  }

  [[nodiscard]] const VectorXd& vdot() const { return trial_.vdot; }
  [[nodiscard]] const VectorXd& v() const { return trial_.v; }
  /// The tangent of the last solution, with the constraint rows.
  [[nodiscard]] const Equations::SparseMatrix& matrix() const { return matrix_; }

 private:
  bool evaluate(const VectorXd& v, double span) {
    trial_.v = v + span * trial_.vdot;
    const Stage stage{.dt = dt_, .k = 0, .c = span, .m = 1, .dq = {}, .holds_inertia = true};
    equations_.assemble(trial_, stage, residual_, scale_, &matrix_);
    if (!equations_.domain_error().empty() || !residual_.allFinite()) return false;
    fill_jacobian(G_, nv_, matrix_);
    residual_.tail(bias_.size()) = G_ * trial_.vdot + bias_;
    scale_.tail(bias_.size()) = G_.cwiseAbs() * trial_.vdot.cwiseAbs() + bias_.cwiseAbs();
    worst_ = equations_.internal_residual();
    for (Index i = 0; i < residual_.size(); ++i)
      if (residual_[i] != 0) worst_ = std::max(worst_, std::abs(residual_[i]) / scale_[i]);
    return true;
  }

  /// Newton's increment, halved until the equations accept it.
  bool advance(const VectorXd& v, double span) {
    VectorXd x;
    if (!solve_bordered(matrix_, nv_, -residual_, x)) return false;
    const VectorXd vdot = trial_.vdot, lambda = trial_.lambda;
    double length = 1;
    for (int halvings = 0; halvings <= kSettlingHalvings; ++halvings, length /= 2) {
      trial_.vdot = vdot + length * x.head(nv_);
      trial_.lambda = lambda + length * x.tail(bias_.size());
      if (evaluate(v, span)) return true;
    }
    return false;
  }

  Equations& equations_;
  Index nv_;
  double dt_;
  State trial_;
  Equations::SparseMatrix G_, matrix_;
  VectorXd bias_, residual_, scale_;
  double worst_ = 0;
};

/// True if damping ends a motion that takes part in `change`, of accelerations by the first step, within the step: by
/// powers of F, theory manual after eq. (integrator.9). The norm is that of the kinetic energy, which no choice of
/// coordinates changes.
bool ends_a_motion(const Equations::SparseMatrix& inertia, const Equations::SparseMatrix& damped, const VectorXd& whole,
                   VectorXd change) {
  const Index nv = whole.size();
  const Equations::SparseMatrix M = inertia.topLeftCorner(nv, nv);
  const Equations::SparseMatrix part = (1 - 1 / kResolved) * inertia + 1 / kResolved * damped;
  const SparseKkt kkt(part, nv);
  const auto size = [&](const VectorXd& a) { return std::sqrt(std::max(0.0, a.dot(M * a))); };
  const double noticeable = kFloor * size(whole);
  double before = size(change), left = 1;
  VectorXd force = VectorXd::Zero(inertia.rows()), x;
  for (int power = 1; power <= kPowers && before > left * noticeable; ++power) {
    force.head(nv) = M * change;
    if (!kkt.sound() || !kkt.solve(force, x)) return true;
    change -= x.head(nv);
    const double after = size(change), ratio = after / before;
    if (ratio > kFast && after > std::pow(ratio, power) * noticeable) return true;
    before = after;
    left *= kFast;
  }
  return false;
}

/// The difference of two accelerations as what damping leaves of it, g(w) of each motion by (integrator.9); false where
/// the equations do not determine it.
bool settle_difference(const Equations::SparseMatrix& inertia, const Equations::SparseMatrix& damped,
                       VectorXd& difference) {
  if (difference.isZero(0)) return true;
  const Index nv = difference.size();
  const Equations::SparseMatrix M = inertia.topLeftCorner(nv, nv);
  const SparseKkt kkt(damped, nv);
  if (!kkt.sound()) return false;
  VectorXd force = VectorXd::Zero(inertia.rows()), x, left = difference;
  difference.setZero();
  for (const double share : kShares) {
    force.head(nv) = M * left;
    if (!kkt.solve(force, x)) return false;
    left = x.head(nv);
    difference += share * left;
  }
  return true;
}

}  // namespace

std::optional<SettledStart> settle_fast_motions(Equations& equations, const State& state, double dt) {
  if (!equations.has_whole_tangent()) return std::nullopt;
  VelocitySteps steps(equations, state, dt);
  // A motion without inertia has only the acceleration computed here.
  const bool all_have_inertia = steps.solve(state.v, 0);
  const VectorXd instant = all_have_inertia ? steps.vdot() : state.vdot;
  const Equations::SparseMatrix inertia = steps.matrix();
  if (!steps.solve(state.v, dt)) {
    // Force over mass carried through the step is as far off as the mass is light: Newton's way back through damping
    // that grows with speed takes iterations for each power of ten. The velocity of the start is nearer then.
    steps.begin_at_rest(state);
    if (!steps.solve(state.v, dt)) return std::nullopt;
  }
  if (all_have_inertia && !ends_a_motion(inertia, steps.matrix(), instant, instant - steps.vdot())) return std::nullopt;

  // The acceleration that the equations give at the start may differ from vdot, because condensed unknowns respond.
  // Damping that ends a motion ends what it has of that, too: force over a light mass, which would be extrapolated.
  VectorXd difference = state.vdot - instant;
  if (!settle_difference(inertia, steps.matrix(), difference)) return std::nullopt;
  SettledStart settled{VectorXd::Zero(state.v.size()), VectorXd::Zero(state.v.size()), std::move(difference)};
  VectorXd v = state.v, way = VectorXd::Zero(v.size());
  for (std::size_t k = 0; k < kShares.size(); ++k) {
    if (k > 0 && !steps.solve(v, dt)) return std::nullopt;
    v = steps.v();
    way += dt * v;
    settled.offset += kShares[k] * way;
    settled.v += kShares[k] * v;
    settled.vdot += kShares[k] * steps.vdot();
  }
  return settled;
}

}  // namespace hersey::solver
