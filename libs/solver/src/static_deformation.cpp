#include "hersey/solver/static_deformation.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hersey/core/contract.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Equations::Index;
using SparseMatrix = Equations::SparseMatrix;

constexpr double kTolerance = 1e-9;  // of the terms that a row balances
constexpr double kConstraintTolerance = 1e-12;
constexpr int kMaxIterations = 40, kMaxHalvings = 14, kMaxInnerIterations = 60;

/// Selection of the unknown positions and accelerations. Constraints make as many components depend on the others as
/// there are constraints: of these both are.
struct Unknowns {
  std::vector<Index> dependent, positions, accelerations;
};

/// Free rigid motions are chosen to depend before given ones, deformations only where nothing else can.
Unknowns choose_unknowns(Equations& equations, const State& state, const InitialiseOptions& options) {
  const Index nv = equations.nv(), nlambda = equations.nlambda();
  const VectorXd scales = equations.position_scales();
  VectorXd preference = scales;
  std::vector<bool> elastic(static_cast<std::size_t>(nv), false), depends = elastic;
  for (const std::vector<Index>* given : {&options.fixed, &options.fixed_rates})
    for (const Index k : *given) preference[k] = std::min(preference[k], 1e-3 * scales[k]);
  for (const Index k : options.stiff) {
    preference[k] *= 1e-6;
    elastic[static_cast<std::size_t>(k)] = true;
  }
  Unknowns unknowns;
  if (nlambda > 0) {
    VectorXd phi, scale;
    SparseMatrix G;
    equations.constraints(state, phi, scale, &G);
    const MatrixXd columns = scale.cwiseInverse().asDiagonal() * MatrixXd(G) * preference.asDiagonal();
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
    for (Index i = 0; i < nlambda; ++i) unknowns.dependent.push_back(qr.colsPermutation().indices()[i]);
    for (const Index k : unknowns.dependent) depends[static_cast<std::size_t>(k)] = true;
  }
  for (Index k = 0; k < nv; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (depends[i] || elastic[i]) unknowns.positions.push_back(k);
    if (depends[i] || !elastic[i]) unknowns.accelerations.push_back(k);
  }
  return unknowns;
}

class StaticDeformation {
 public:
  StaticDeformation(Equations& equations, const State& start, const InitialiseOptions& options)
      : equations_(equations),
        unknowns_(choose_unknowns(equations, start, options)),
        here_(start),
        reach_(equations.position_scales()) {
    for (const Index k : options.stiff) here_.v[k] = here_.vdot[k] = 0;
  }

  StaticDeformationSummary run(State& state) {
    equations_.begin_step(here_, 0);
    if (!evaluate(here_)) return failure(failure_);
    while (worst_ > 1) {
      if (summary_.iterations++ == kMaxIterations) return failure(still_open());
      linearise();
      if (!factorise()) return failure("the deformation is not determined; worst equation: " + worst_row_);
      if (!advance()) return failure(failure_.empty() ? still_open() : failure_);
    }
    summary_.set_solved(true);
    summary_.residual = worst_;
    state = here_;
    return summary_;
  }

 private:
  [[nodiscard]] std::string still_open() const {
    return fmt::format("worst equation: {}, {:.3g} times its tolerance after {} iterations", worst_row_, worst_,
                       summary_.iterations);
  }

  StaticDeformationSummary failure(const std::string& why) {
    summary_.residual = worst_;
    summary_.message = why;
    return summary_;
  }

  /// Projects the velocities onto the constraints, with the independent ones unchanged; returns false and sets
  /// `failure_` if the constraints do not determine them.
  bool project_velocities(State& at) {
    const Index nlambda = equations_.nlambda();
    if (nlambda == 0) return true;
    VectorXd phi, scale, velocity, bias;
    SparseMatrix G;
    equations_.constraints(at, phi, scale, &G);
    equations_.constraint_rates(at, velocity, bias);
    MatrixXd by_dependent(nlambda, nlambda);
    for (Index i = 0; i < nlambda; ++i) by_dependent.col(i) = G.col(unknowns_.dependent[static_cast<std::size_t>(i)]);
    const VectorXd change = by_dependent.partialPivLu().solve(-velocity);
    for (Index i = 0; i < nlambda; ++i) at.v[unknowns_.dependent[static_cast<std::size_t>(i)]] += change[i];
    if (change.allFinite()) return true;
    failure_ = "the constraints do not determine the velocities";
    return false;
  }

  /// Assembles with condensed unknowns solved; returns false and sets `failure_` outside the domain of the equations.
  bool assemble(const State& at, const Stage& stage, SparseMatrix& tangent) {
    for (int i = 0; i < kMaxInnerIterations; ++i) {
      equations_.assemble(at, stage, residual_, scale_, &tangent);
      failure_ = equations_.domain_error();
      if (failure_.empty() && !residual_.allFinite()) failure_ = "the forces are not numbers";
      if (!failure_.empty()) return false;
      if (equations_.internal_residual() <= kTolerance) return true;
    }
    failure_ = equations_.name_of_internal_residual() + " is not solved";
    return false;
  }

  /// Residuals and stiffness at `at`, whose velocities are projected.
  bool evaluate(State& at) {
    worst_ = std::numeric_limits<double>::infinity();
    if (!project_velocities(at)) return false;
    if (!assemble(at, {.dt = 0, .k = 1, .c = 0, .m = 0, .dq = {}}, stiffness_)) return false;
    VectorXd velocity;
    equations_.constraint_rates(at, velocity, acceleration_);
    acceleration_size_ = acceleration_.cwiseAbs();
    const Index nv = equations_.nv();
    for (Index column = 0; column < nv; ++column)
      for (SparseMatrix::InnerIterator entry(stiffness_, column); entry; ++entry) {
        if (entry.row() < nv) continue;
        acceleration_[entry.row() - nv] += entry.value() * at.vdot[column];
        acceleration_size_[entry.row() - nv] += std::abs(entry.value() * at.vdot[column]);
      }
    measure();
    return true;
  }

  void measure() {
    const Index nv = equations_.nv(), n = residual_.size();
    worst_ = 0;
    const auto measure_row = [&](Index row, double residual, double tolerance) {
      if (residual == 0) return;
      const double ratio = std::abs(residual) / tolerance;
      if (ratio <= worst_) return;
      worst_ = ratio;
      worst_row_ = equations_.name_of_row(row);
    };
    for (Index i = 0; i < n; ++i)
      measure_row(i, residual_[i], (i < nv ? kTolerance : kConstraintTolerance) * scale_[i]);
    for (Index i = 0; i < n - nv; ++i) measure_row(nv + i, acceleration_[i], kTolerance * acceleration_size_[i]);
  }

  /// The matrix of theory manual eq. (integrator.23), columns [positions; accelerations; multipliers].
  void linearise() {
    const State at = here_;
    const VectorXd residual = residual_, scale = scale_;
    SparseMatrix mass;
    HERSEY_REQUIRE(assemble(at, {.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}}, mass), "it was assembled here before");
    residual_ = residual;
    scale_ = scale;
    const Index nv = equations_.nv(), nlambda = equations_.nlambda();
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(stiffness_.nonZeros() + mass.nonZeros()));
    Index column = 0;
    for (const Index k : unknowns_.positions) {
      for (SparseMatrix::InnerIterator entry(stiffness_, k); entry; ++entry)
        entries.emplace_back(entry.row(), column, entry.value());
      ++column;
    }
    for (const Index k : unknowns_.accelerations) {
      for (SparseMatrix::InnerIterator entry(mass, k); entry; ++entry)
        if (entry.row() < nv) entries.emplace_back(entry.row(), column, entry.value());
      for (SparseMatrix::InnerIterator entry(stiffness_, k); entry; ++entry)
        if (entry.row() >= nv) entries.emplace_back(entry.row() + nlambda, column, entry.value());
      ++column;
    }
    for (Index j = 0; j < nlambda; ++j, ++column)
      for (SparseMatrix::InnerIterator entry(stiffness_, nv + j); entry; ++entry)
        if (entry.row() < nv) entries.emplace_back(entry.row(), column, entry.value());
    matrix_.resize(nv + 2 * nlambda, nv + 2 * nlambda);
    matrix_.setFromTriplets(entries.begin(), entries.end());
  }

  /// Columns of comparable size: stiffnesses and masses differ by the square of a frequency.
  bool factorise() {
    size_.resize(matrix_.cols());
    for (Index column = 0; column < matrix_.cols(); ++column) {
      const double norm = matrix_.col(column).norm();
      size_[column] = norm > 0 ? 1 / norm : 1;
    }
    SparseMatrix scaled = matrix_ * size_.asDiagonal();
    scaled.makeCompressed();
    lu_.analyse(scaled);
    return lu_.factorise({scaled.valuePtr(), static_cast<std::size_t>(scaled.nonZeros())});
  }

  /// Computes the Newton increment at the last residuals.
  [[nodiscard]] VectorXd increment() const {
    VectorXd x(matrix_.cols());
    x << -residual_, -acceleration_;
    lu_.solve({x.data(), static_cast<std::size_t>(x.size())});
    return size_.asDiagonal() * x;
  }

  /// Returns the norm of the change of positions; accelerations and multipliers follow from these by linear equations.
  [[nodiscard]] double length_of(const VectorXd& x) const {
    double sum = 0;
    for (std::size_t i = 0; i < unknowns_.positions.size(); ++i)
      sum += std::pow(x[static_cast<Index>(i)] / reach_[unknowns_.positions[i]], 2);
    return std::sqrt(sum);
  }

  [[nodiscard]] State moved(const State& from, const VectorXd& x) const {
    const Index n_q = static_cast<Index>(unknowns_.positions.size());
    VectorXd dq = VectorXd::Zero(reach_.size());
    State to = from;
    for (Index i = 0; i < n_q; ++i) dq[unknowns_.positions[static_cast<std::size_t>(i)]] = x[i];
    for (std::size_t i = 0; i < unknowns_.accelerations.size(); ++i)
      to.vdot[unknowns_.accelerations[i]] += x[n_q + static_cast<Index>(i)];
    equations_.retract(from.q, dq, to.q);
    to.lambda += x.tail(to.lambda.size());
    return to;
  }

  /// Moves by the increment, halved until the next one, by the same matrix, is shorter (Deuflhard's natural test: the
  /// residuals of soft and of stiff deformations cannot be compared).
  bool advance() {
    const State from = here_;
    const VectorXd x = increment();
    if (!x.allFinite()) return false;
    const double before = length_of(x);
    double length = 1;
    for (int halvings = 0; halvings <= kMaxHalvings; ++halvings, length /= 2) {
      here_ = moved(from, length * x);
      if (!evaluate(here_)) continue;
      if (worst_ <= 1 || length_of(increment()) < (1 - 0.25 * length) * before) return true;
    }
    return false;
  }

  Equations& equations_;
  Unknowns unknowns_;
  State here_;
  VectorXd residual_, scale_, acceleration_, acceleration_size_, reach_, size_;
  SparseMatrix stiffness_, matrix_;
  SparseLu lu_;
  double worst_ = 0;
  std::string worst_row_, failure_;
  StaticDeformationSummary summary_;
};

}  // namespace

StaticDeformationSummary settle_deformations(Equations& equations, State& state, const InitialiseOptions& options) {
  StaticDeformationSummary summary = StaticDeformation(equations, state, options).run(state);
  if (!summary.solved()) return summary;
  equations.begin_step(state, 0);
  VectorXd residual, scale;
  equations.assemble(state, {.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}}, residual, scale, nullptr);
  equations.accept_step(state);
  return summary;
}

}  // namespace hersey::solver
