#include "hersey/solver/equilibrium.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hersey/solver/linearise.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::solver {
namespace {

using Eigen::VectorXd;
using Index = Equations::Index;

constexpr double kLargestMove = 0.2;  // rad, or sizes of the system
constexpr double kRoundOff = 1e-13;
constexpr double kSolved = 1e-10;               // rad, or sizes of the system: increments that are negligible
constexpr int kLongestPath = 20;                // in steps of Newton's method, times those allowed to a search
constexpr double kSmallestLoadFraction = 1e-5;  // of the load that one step of following it may add
constexpr double kShortest = 1e-2;              // of a step of Newton's method towards a steady motion
constexpr double kContraction = 0.5;  // of the increments of Newton's method, for a step that one of them solves
constexpr double kNeutral = 1e-12;    // of the terms whose sum is a stiffness
constexpr double kSteady = 1e-8;      // rad, or sizes of the system: ten times what Newton's tolerance leaves
// Torque of a turn of one radian over that of the fastest rate, below which nothing holds a coordinate: films of a grid
// that rotates change by some thousandths of that; what is supported changes by its order.
constexpr double kUnheld = 1e-2;
constexpr double kFixedShare = 1e-2;  // largest share of the deformation that may be fixed in space in a steady motion

class EquilibriumSearch {
 public:
  EquilibriumSearch(Equations& equations, const State& start, const EquilibriumOptions& options)
      : equations_(equations), options_(options), here_(start), reach_(equations.position_scales()) {
    walked_.setZero(reach_.size());
    if (!options.steady_motion) here_.v.setZero();
    here_.vdot.setZero();
  }

  EquilibriumSummary run(State& state) {
    // The first step is about a tenth of the allowed length, estimated from the accelerations at the start.
    const double pull = state.vdot.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>();
    mu_ = std::max(pull, 1e-6) / (0.1 * kLargestMove);
    keep_mass();
    if (!assemble(here_)) {
      const std::string why = equations_.domain_error();
      return failure(why.empty() ? "the forces at the start are not numbers" : why);
    }
    if (options_.steady_motion) find_free_rates();
    const State start = here_;
    const VectorXd load = residual_.head(equations_.nv());
    for (; worst_ > 1; ++summary_.iterations) {
      if (summary_.iterations == options_.max_iterations || mu_ > 1e30) {
        const std::string why =
            fmt::format("no equilibrium in {} iterations; worst equation: {}, {:.3g} times its tolerance",
                        summary_.iterations, summary_.worst_row, worst_);
        if (options_.steady_motion || !follow_the_load(start, load)) return failure(why);
        break;
      }
      if (!options_.steady_motion) {
        advance();
      } else if (!advance_to_steady_motion()) {
        const std::string why = "no steady motion near the start; worst equation: " + summary_.worst_row;
        if (!drift_to_steady_motion(start)) return failure(why);
      }
    }
    if (options_.steady_motion) {
      sharpen();
      const State steady = here_;
      if (!stays_steady(steady)) return failure(summary_.message);
      here_ = steady;
    }
    if (!options_.steady_motion) polish();
    summary_.set_solved(true);
    state = here_;
    if (!options_.steady_motion) classify(state);
    return summary_;
  }

 private:
  /// One step; a step that overshoots is not taken, and mu rises.
  void advance() {
    const Index nv = equations_.nv();
    if (!solve()) {
      mu_ = std::max(10 * mu_, 1e-12);
      return;
    }
    const VectorXd dx = increment_.head(nv);
    const double length =
        std::min(1.0, kLargestMove / std::max(dx.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>(), 1e-300));
    // dx^T (K + mu M) dx: the work the forces do on the way, less what is left of them at its end.
    const double curvature = curvature_along(dx), before = worst_;
    State next = here_;
    equations_.retract(here_.q, length * dx, next.q);
    next.lambda = here_.lambda + length * increment_.tail(increment_.size() - nv);
    const State from = here_;
    const bool inside = assemble(next);
    const double remaining = inside ? -residual_.head(nv).dot(dx) : 0;
    const bool better = worst_ < before;
    const bool on_the_way = remaining >= -0.5 * curvature;
    if (inside && curvature > 0 && (better || on_the_way)) {
      here_ = next;
      mu_ *= better ? std::clamp(worst_ / before, 0.01, 0.5) : 0.7;
      return;
    }
    here_ = from;
    mu_ = std::max(10 * mu_, 1e-12);
    (void)assemble(here_);
  }

  /// Applies the forces that are out of balance at the start in steps, so that Newton's method stays near the path of
  /// equilibria: bodies soft in one direction and stiff in another deform strongly only along that path. Theory manual
  /// eq. (integrator.26). Returns false if it ends before the whole load.
  bool follow_the_load(const State& start, const VectorXd& load) {
    mu_ = 0;
    here_ = start;
    double share = 0, step = 0.1;
    while (share < 1) {
      const State from = here_;
      const double next = std::min(share + step, 1.0);
      withheld_load_ = (1 - next) * load;
      if (reach_balance()) {
        share = next;
        step *= 1.5;
        continue;
      }
      here_ = from;
      step /= 2;
      if (step < kSmallestLoadFraction || summary_.iterations > kLongestPath * options_.max_iterations) break;
    }
    withheld_load_.resize(0);
    (void)assemble(here_);
    return share == 1;
  }

  /// Applies Newton's method from the previous equilibrium on the path; returns false if that is too far away.
  bool reach_balance() {
    constexpr int most = 12;
    (void)assemble(here_);
    for (int i = 0; i < most; ++i, ++summary_.iterations) {
      if (worst_ <= 1) return true;
      if (!solve() || !take_full_step(kLargestMove)) return false;
    }
    return false;
  }

  /// Moves by the full increment if its length does not exceed `most`.
  bool take_full_step(double most) {
    const Index nv = equations_.nv();
    if (increment_.head(nv).cwiseQuotient(reach_).lpNorm<Eigen::Infinity>() > most) return false;
    const State from = here_;
    move(from, 1);
    return assemble(here_);
  }

  /// Continues Newton's method until its increments are negligible: the tolerance of rows with stiff motions bounds
  /// soft motions poorly.
  void polish() {
    if (reach_.size() == 0) return;
    mu_ = 0;
    for (int i = 0; i < 8; ++i) {
      const State from = here_;
      const double before = worst_;
      if (!solve()) return;
      const double reach = increment_.head(equations_.nv()).cwiseQuotient(reach_).lpNorm<Eigen::Infinity>();
      if (reach <= kSolved) return;
      if (take_full_step(0.01) && worst_ <= std::max(before, 1e-3)) continue;
      here_ = from;
      (void)assemble(here_);
      return;
    }
  }

  /// Takes one step of Newton's method, shortened until what the same tangent makes of the new residual is shorter than
  /// the step: the natural test of Deuflhard (2011), which no scale of forces, multipliers or films affects. A steady
  /// motion does not minimise an energy: above a critical speed the stiffness including centrifugal forces is
  /// indefinite, that of a film is never symmetric. Theory manual eq. (integrator.34).
  bool advance_to_steady_motion() {
    mu_ = 0;
    if (!solve()) return false;
    const Index nv = equations_.nv();
    const State from = here_;
    const VectorXd dx = increment_.head(nv);
    const double whole = dx.cwiseQuotient(reach_).norm();
    const double reach = dx.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>();
    for (double length = std::min(1.0, kLargestMove / std::max(reach, 1e-300)); length > kShortest;) {
      move(from, length);
      if (!assemble(here_)) {
        length /= 2;
        continue;
      }
      if (worst_ <= 1 || next_increment().cwiseQuotient(reach_).norm() <= (1 - length / 4) * whole) {
        walked_ += length * of_positions(dx);
        return true;
      }
      length /= 2;
    }
    here_ = from;
    (void)assemble(here_);
    return false;
  }

  /// Follows, from the start, the motion that dampers and films allow the machine without its inertia: steps 1/mu of
  /// the implicit Euler method, each by one increment of Newton's method, which lengthen as that is enough. They end
  /// where nothing moves. Near the singular tangents at which Newton's method halts, films still resist all motions.
  /// Theory manual eq. (integrator.35).
  bool drift_to_steady_motion(const State& start) {
    constexpr double fast = 0.1, longest = 1e-6;
    here_ = start;
    if (!assemble(here_)) return false;
    const double fastest = std::max(here_.v.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>(), 1e-300);
    double mu = fastest;
    for (int i = 0; i < options_.max_iterations && mu < 1e12 * fastest; ++i, ++summary_.iterations) {
      if (worst_ <= 1) return true;
      keep_damping();
      const double remaining = try_to_drift(mu);
      if (!(remaining <= kContraction)) {
        mu *= 4;
      } else if (remaining < fast) {
        mu = std::max(mu / 4, longest * fastest);
      }
    }
    return worst_ <= 1;
  }

  /// Takes one such step unless Newton's method would need several increments for it. Returns the length of the next
  /// increment over that of the first, infinity outside the domain.
  double try_to_drift(double mu) {
    const State from = here_;
    mu_ = mu;
    const bool solved = solve();
    mu_ = 0;
    if (!solved) return std::numeric_limits<double>::infinity();
    const Index nv = equations_.nv();
    const VectorXd dx = increment_.head(nv);
    move(from, 1);
    double remaining = std::numeric_limits<double>::infinity();
    if (dx.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>() <= kLargestMove && assemble(here_)) {
      residual_ += mu * (weight_ * of_positions(increment_));
      remaining = next_increment().cwiseQuotient(reach_).norm() / dx.cwiseQuotient(reach_).norm();
      residual_ -= mu * (weight_ * of_positions(increment_));
    }
    if (remaining <= kContraction) {
      walked_ += of_positions(dx);
      return remaining;
    }
    here_ = from;
    (void)assemble(here_);
    return remaining;
  }

  /// Finds the coordinates whose rate is an unknown in place of their position: they move at the start, nothing holds
  /// them, and a rate changes the forces along them, as of a ring that floats between two films. Their rates are
  /// measured by the fastest one. Theory manual eq. (integrator.36).
  void find_free_rates() {
    const double fastest = here_.v.size() > 0 ? here_.v.lpNorm<Eigen::Infinity>() : 0;
    if (fastest == 0) return;
    keep_damping();
    const Index nv = equations_.nv();
    for (Index i = 0; i < nv; ++i) {
      bool is_constrained = false;
      for (Equations::SparseMatrix::InnerIterator entry(stiffness_, i); entry; ++entry)
        is_constrained = is_constrained || (entry.row() >= nv && entry.value() != 0);
      const double by_rate = std::abs(weight_.coeff(i, i)) * fastest;
      const bool moves = here_.v[i] != 0 && !is_constrained;
      if (moves && std::abs(stiffness_.coeff(i, i)) < kUnheld * by_rate) free_rates_.push_back(i);
    }
    for (const Index i : free_rates_) reach_[i] = fastest;
  }

  /// Puts the derivatives by free rates in the place of those by their positions.
  void take_rates_as_unknowns() {
    if (free_rates_.empty()) return;
    const Equations::SparseMatrix other = weight_;
    keep_damping();
    for (const Index i : free_rates_) {
      Equations::SparseMatrix::InnerIterator rate(weight_, i);
      for (Equations::SparseMatrix::InnerIterator entry(tangent_, i); entry; ++entry, ++rate)
        entry.valueRef() = rate.value();
    }
    weight_ = other;
  }

  /// An increment without its rates.
  [[nodiscard]] VectorXd of_positions(VectorXd dx) const {
    for (const Index i : free_rates_) dx[i] = 0;
    return dx;
  }

  /// Moves from a state by a part of the increment: positions, free rates and multipliers.
  void move(const State& from, double length) {
    const Index nv = equations_.nv();
    const VectorXd dx = length * increment_.head(nv);
    equations_.retract(from.q, of_positions(dx), here_.q);
    here_.v = from.v;
    for (const Index i : free_rates_) here_.v[i] += dx[i];
    here_.lambda = from.lambda + length * increment_.tail(increment_.size() - nv);
  }

  /// Returns the increment of the positions by the residual at hand and the tangent factorised last.
  VectorXd next_increment() {
    VectorXd next = -residual_;
    lu_.solve({next.data(), static_cast<std::size_t>(next.size())});
    return next.head(equations_.nv());
  }

  /// Continues Newton's method until its increments no longer shrink: films are thinner than the size by which the
  /// tolerance is measured by many powers of ten.
  void sharpen() {
    constexpr int most = 4;
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most && solve(); ++i) {
      const double size = increment_.head(equations_.nv()).cwiseQuotient(reach_).norm();
      const State from = here_;
      if (!(size < 0.1 * last)) return;
      last = size;
      if (take_full_step(kLargestMove)) continue;
      here_ = from;
      (void)assemble(here_);
      return;
    }
  }

  /// True if the motion is steady: solved again a short time later, it must differ only by its velocities.
  bool stays_steady(const State& now) {
    const double fastest = now.v.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>();
    if (fastest == 0) return true;
    const double dt = kLargestMove / fastest;
    State expected = now;
    expected.t += dt;
    equations_.retract(now.q, dt * now.v, expected.q);
    here_ = expected;
    const double deformed = walked_.cwiseQuotient(reach_).lpNorm<Eigen::Infinity>();
    walked_.setZero(reach_.size());
    if (!assemble(here_)) return true;  // outside the domain: only the state itself can be checked
    for (int i = 0; worst_ > 1 && i < 20; ++i)
      if (!advance_to_steady_motion()) break;
    const VectorXd moved = walked_.cwiseQuotient(reach_).cwiseAbs();
    Index farthest = 0;
    if (moved.maxCoeff(&farthest) < std::max(kSteady, kFixedShare * kLargestMove * deformed)) return true;
    summary_.message = fmt::format(
        "no steady motion: {} does not keep still while the drives rotate; in its coordinates loads, unbalances and "
        "surroundings must be the same at every angle (gravity along the axis of coordinates that rotate), and the "
        "speeds "
        "of the drives must be constant",
        equations_.name_of_row(farthest));
    return false;
  }

  bool assemble(const State& at) {
    const Stage stage{.dt = 0, .k = 1, .c = 0, .m = 0, .dq = {}};
    equations_.assemble(at, stage, residual_, scale_, &stiffness_);
    if (!equations_.domain_error().empty() || !residual_.allFinite()) {
      worst_ = std::numeric_limits<double>::infinity();
      return false;
    }
    if (withheld_load_.size() > 0) residual_.head(withheld_load_.size()) -= withheld_load_;
    measure();
    return true;
  }

  /// Stores the mass matrix at the start, in the pattern of the tangent; it weights the increments.
  void keep_mass() { keep_weight({.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}}); }

  /// Stores the damping matrix here in its place.
  void keep_damping() { keep_weight({.dt = 0, .k = 0, .c = 1, .m = 0, .dq = {}}); }

  void keep_weight(const Stage& stage) {
    VectorXd residual, scale;
    equations_.assemble(here_, stage, residual, scale, &weight_);
    const Index nv = equations_.nv();
    for (Index column = 0; column < weight_.cols(); ++column)
      for (Equations::SparseMatrix::InnerIterator entry(weight_, column); entry; ++entry)
        if (entry.row() >= nv || column >= nv) entry.valueRef() = 0;
  }

  [[nodiscard]] double curvature_along(const VectorXd& dx) const {
    double sum = 0;
    for (Index column = 0; column < dx.size(); ++column)
      for (Equations::SparseMatrix::InnerIterator entry(tangent_, column); entry; ++entry)
        if (entry.row() < dx.size()) sum += dx[entry.row()] * entry.value() * dx[column];
    return sum;
  }

  /// Returns the sum of the magnitudes of all terms of the stiffness along a motion; round-off is proportional to it.
  [[nodiscard]] double terms_along(const VectorXd& motion) const {
    double sum = 0;
    for (Index column = 0; column < motion.size(); ++column)
      for (Equations::SparseMatrix::InnerIterator entry(stiffness_, column); entry; ++entry)
        if (entry.row() < motion.size()) sum += std::abs(motion[entry.row()] * entry.value() * motion[column]);
    return sum;
  }

  /// Out-of-balance forces over their tolerances. A row is compared with the terms it adds up and with what its own
  /// stiffness makes of the largest reach: at rest under no torque at all the terms are round-off themselves.
  void measure() {
    const Index nv = equations_.nv();
    for (Index i = 0; i < nv; ++i) scale_[i] = std::max(scale_[i], std::abs(stiffness_.coeff(i, i)) * reach_[i]);
    Index row = 0;
    VectorXd ratio(residual_.size());
    for (Index i = 0; i < ratio.size(); ++i) {
      const double tolerance = i < nv ? options_.rtol * scale_[i] : std::max(options_.rtol, kRoundOff) * scale_[i];
      ratio[i] = residual_[i] == 0 ? 0 : std::abs(residual_[i]) / tolerance;
    }
    worst_ = ratio.size() > 0 ? ratio.maxCoeff(&row) : 0;
    summary_.residual = worst_;
    summary_.worst_row = ratio.size() > 0 ? equations_.name_of_row(row) : "";
  }

  bool solve() {
    tangent_ = stiffness_;
    Eigen::Map<VectorXd>(tangent_.valuePtr(), tangent_.nonZeros()) +=
        mu_ * Eigen::Map<const VectorXd>(weight_.valuePtr(), weight_.nonZeros());
    take_rates_as_unknowns();
    const auto nonzeros = static_cast<std::size_t>(tangent_.nonZeros());
    if (lu_.size() != tangent_.rows()) lu_.analyse(tangent_);
    if (!lu_.factorise({tangent_.valuePtr(), nonzeros})) return false;
    increment_ = -residual_;
    lu_.solve({increment_.data(), static_cast<std::size_t>(increment_.size())});
    return increment_.allFinite();
  }

  EquilibriumSummary failure(std::string why) {
    summary_.message = std::move(why);
    return summary_;
  }

  /// Determines the stability: an equilibrium is stable if every free motion increases the energy, that is, if the
  /// smallest eigenvalue of the stiffness against the mass is positive.
  void classify(const State& state) {
    const Linearisation linear = linearise(equations_, state, 0);
    if (linear.K.rows() == 0) return;
    const Eigen::MatrixXd K = 0.5 * (linear.K + linear.K.transpose());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, linear.M);
    const VectorXd& stiffness = eigen.eigenvalues();
    const VectorXd softest_motion = linear.Z * eigen.eigenvectors().col(0);
    const double small = kNeutral * terms_along(softest_motion);
    const VectorXd motion = softest_motion.cwiseAbs().cwiseQuotient(reach_);
    Index softest = 0;
    motion.maxCoeff(&softest);
    summary_.softest = equations_.name_of_row(softest);
    if (stiffness[0] < -small) {
      summary_.kind = EquilibriumKind::unstable;
      summary_.message =
          fmt::format("the equilibrium is unstable: the least push along {} leads away from it", summary_.softest);
    } else if (stiffness[0] <= small) {
      summary_.kind = EquilibriumKind::neutral;
      summary_.message = fmt::format("the equilibrium is indifferent: no stiffness resists {}", summary_.softest);
    }
  }

  Equations& equations_;
  EquilibriumOptions options_;
  State here_;
  VectorXd reach_, residual_, scale_, increment_;
  VectorXd withheld_load_;         ///< out-of-balance forces that do not act yet; empty: none
  VectorXd walked_;                ///< by the steps towards a steady motion
  std::vector<Index> free_rates_;  ///< coordinates whose rate is an unknown in place of their position
  Equations::SparseMatrix stiffness_, weight_, tangent_;
  SparseLu lu_;
  double mu_ = 0, worst_ = 0;
  EquilibriumSummary summary_;
};

}  // namespace

EquilibriumSummary find_equilibrium(Equations& equations, State& state, const EquilibriumOptions& options) {
  State found = state;
  EquilibriumSummary summary = EquilibriumSearch(equations, state, options).run(found);
  if (!summary.solved()) return summary;
  state = std::move(found);
  equations.begin_step(state, 0);
  VectorXd residual, scale;
  equations.assemble(state, {.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}}, residual, scale, nullptr);
  equations.accept_step(state);
  return summary;
}

}  // namespace hersey::solver
