#include "hersey/solver/dormand_prince.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/stopwatch.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::solver {
namespace {

using Eigen::VectorXd;
using Index = Equations::Index;

constexpr int kStages = 12;

// Coefficients of the method, Hairer, Noersett and Wanner (1993), program DOP853, rounded to double precision.
constexpr std::array<double, kStages> kInstants{0,
                                                0.05260015195876773,
                                                0.0789002279381516,
                                                0.1183503419072274,
                                                0.2816496580927726,
                                                0.3333333333333333,
                                                0.25,
                                                0.3076923076923077,
                                                0.6512820512820513,
                                                0.6,
                                                0.8571428571428571,
                                                1.0};
constexpr std::array<std::array<double, kStages - 1>, kStages> kStageWeights{
    {{},
     {0.05260015195876773},
     {0.0197250569845379, 0.0591751709536137},
     {0.02958758547680685, 0, 0.08876275643042054},
     {0.2413651341592667, 0, -0.8845494793282861, 0.924834003261792},
     {0.037037037037037035, 0, 0, 0.17082860872947386, 0.12546768756682242},
     {0.037109375, 0, 0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
     {0.03709200011850479, 0, 0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023},
     {0.6241109587160757, 0, 0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894,
      -43.48988418106996},
     {0.47766253643826434, 0, 0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423,
      -33.28821096898486, -0.020331201708508627},
     {-0.9371424300859873, 0, 0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696,
      22.739487099350505, 2.4936055526796523, -3.0467644718982196},
     {2.273310147516538, 0, 0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996,
      -2.8589982771350235, -8.87285693353063, 12.360567175794303, 0.6433927460157636}}};
constexpr std::array<double, kStages> kWeights{0.054293734116568765,
                                               0,
                                               0,
                                               0,
                                               0,
                                               4.450312892752409,
                                               1.8915178993145003,
                                               -5.801203960010585,
                                               0.3111643669578199,
                                               -0.1521609496625161,
                                               0.20136540080403034,
                                               0.04471061572777259};
constexpr std::array<double, kStages> kErrorOfFifthOrder{0.01312004499419488,
                                                         0,
                                                         0,
                                                         0,
                                                         0,
                                                         -1.2251564463762044,
                                                         -0.4957589496572502,
                                                         1.6643771824549864,
                                                         -0.35032884874997366,
                                                         0.3341791187130175,
                                                         0.08192320648511571,
                                                         -0.022355307863886294};
constexpr std::array<double, kStages> kErrorOfThirdOrder{-0.18980075407240762,
                                                         0,
                                                         0,
                                                         0,
                                                         0,
                                                         4.450312892752409,
                                                         1.8915178993145003,
                                                         -5.801203960010585,
                                                         -0.4226823213237919,
                                                         -0.1521609496625161,
                                                         0.20136540080403034,
                                                         0.02265179219836082};

/// Share of the estimate of third order in the norm of the error, Hairer, Noersett and Wanner (1993), II.10: their
/// product with that of fifth order is of the order of the method.
constexpr double kThirdOrderShare = 0.01;

/// Violation of a position constraint that is round-off, relative to its length; a corrected one lies below ten times
/// that. At a tenth, corrections would not end; at a hundred times, it would be seen in the multipliers of short steps.
constexpr double kRoundOffOfPositions = 1e-14;
constexpr double kLargestViolation = 1e-11;

constexpr const char* kSingular = "a motion has no inertia, or constraints depend on each other at this position";

/// A correction that does not halve the violation is one by round-off.
constexpr double kLeastProgress = 0.5;

}  // namespace

/// Everything a step needs, allocated once.
struct DormandPrince::Workspace {
  Index nv = 0, nlambda = 0;
  State trial;            ///< the stage being evaluated, without accelerations and multipliers
  State end;              ///< the end of the step, complete
  Eigen::MatrixXd rates;  ///< of the stages: increments of position, then accelerations
  VectorXd change;        ///< of increment and velocity from the start of the step
  VectorXd rate;          ///< of the increment of position
  VectorXd residual, scale, velocity, bias, phi, lengths, rhs, correction, position;
  VectorXd fifth, third, error, position_scales;
  VectorXd moved, turned;                       ///< changes of position and velocity by the projection
  Equations::SparseMatrix matrix;               ///< [M G^T; G 0]
  std::vector<std::pair<Index, Index>> mirror;  ///< places of the entries of G and of G^T in `matrix`
  SparseLu lu;
  Index analysed = -1;
  int evaluations = 0;
  double linear_solve_time = 0;
  Stage stage;
  StepStatus why = StepStatus::converged;  ///< why the step ends without a solution
  std::string reason;                      ///< in one sentence

  void prepare(const Equations& equations, const State& state);
  void set_change(const std::array<double, kStages>& weights, double dt, VectorXd& sum) const;
  void find_mirror();
  [[nodiscard]] bool assemble(Equations& equations, const State& at, bool with_matrix);
  void solve();
  bool refuse(StepStatus status, std::string text);
  [[nodiscard]] bool evaluate_stage(Equations& equations, const State& state, double dt, int i);
  [[nodiscard]] bool close_positions(Equations& equations, int most);
  [[nodiscard]] bool finish(Equations& equations, const State& state, double dt, int most);
  void estimate_error(double dt);
};

void DormandPrince::Workspace::prepare(const Equations& equations, const State& state) {
  trial = state;
  trial.vdot.setZero();
  trial.lambda.setZero();
  evaluations = 0;
  stage.m = 1, stage.k = 0, stage.c = 0;
  if (nv == equations.nv() && nlambda == equations.nlambda() && rates.cols() == kStages) return;
  nv = equations.nv();
  nlambda = equations.nlambda();
  rates.resize(2 * nv, kStages);
  position_scales = equations.position_scales();
  end = state;
}

/// sum = dt sum_i weights_i rates_i.
void DormandPrince::Workspace::set_change(const std::array<double, kStages>& weights, double dt, VectorXd& sum) const {
  sum.setZero(2 * nv);
  for (int i = 0; i < kStages; ++i)
    if (weights[i] != 0) sum += (dt * weights[i]) * rates.col(i);
}

/// Notes why the step ends; false.
bool DormandPrince::Workspace::refuse(StepStatus status, std::string text) {
  why = status;
  reason = std::move(text);
  return false;
}

/// The tangent of a stage without displacements has G^T beside the mass matrix, and zeros in place of G.
void DormandPrince::Workspace::find_mirror() {
  mirror.clear();
  const int* outer = matrix.outerIndexPtr();
  const int* inner = matrix.innerIndexPtr();
  for (Index column = nv; column < nv + nlambda; ++column)
    for (int at = outer[column]; at < outer[column + 1]; ++at) {
      const Index row = inner[at];
      if (row >= nv) continue;
      const int* begin = inner + outer[row];
      const int* found = std::lower_bound(begin, inner + outer[row + 1], static_cast<int>(column));
      HERSEY_REQUIRE(found != inner + outer[row + 1] && *found == column, "a constraint has its force's pattern");
      mirror.emplace_back(at, found - inner);
    }
}

/// Residual, and the matrix with its factors where asked for, at a state; and G v + Phi_t and gamma.
bool DormandPrince::Workspace::assemble(Equations& equations, const State& at, bool with_matrix) {
  ++evaluations;
  equations.assemble(at, stage, residual, scale, with_matrix ? &matrix : nullptr);
  if (std::string outside = equations.domain_error(); !outside.empty())
    return refuse(StepStatus::domain_error, std::move(outside));
  if (!residual.head(nv).allFinite()) return refuse(StepStatus::domain_error, "the residual is not a number");
  if (nlambda > 0) equations.constraint_rates(at, velocity, bias);
  if (!with_matrix) return true;
  const Stopwatch watch(linear_solve_time);
  if (mirror.empty()) find_mirror();
  if (analysed != matrix.nonZeros()) {
    lu.analyse(matrix);
    analysed = matrix.nonZeros();
  }
  double* values = matrix.valuePtr();
  for (const auto& [from, to] : mirror) values[to] = values[from];
  if (lu.factorise({values, static_cast<std::size_t>(matrix.nonZeros())})) return true;
  return refuse(StepStatus::singular, kSingular);
}

void DormandPrince::Workspace::solve() {
  const Stopwatch watch(linear_solve_time);
  lu.solve({rhs.data(), static_cast<std::size_t>(rhs.size())});
}

/// Theory manual eq. (integrator.37) and (integrator.39): rates of stage i.
bool DormandPrince::Workspace::evaluate_stage(Equations& equations, const State& state, double dt, int i) {
  if (i > 0) {
    change.setZero(2 * nv);
    for (int j = 0; j < i; ++j)
      if (kStageWeights[i][j] != 0) change += (dt * kStageWeights[i][j]) * rates.col(j);
    trial.t = state.t + kInstants[i] * dt;
    correction = change.head(nv);
    equations.retract(state.q, correction, trial.q);
    trial.v = state.v + change.tail(nv);
    if (!assemble(equations, trial, true)) return false;
    rhs.resize(nv + nlambda);
    rhs.head(nv) = -residual.head(nv);
    rhs.tail(nlambda) = -bias;
    solve();
    if (!rhs.allFinite()) return refuse(StepStatus::singular, kSingular);
    equations.increment_rate(correction, trial.v, rate);
    rates.col(i).head(nv) = rate;
    rates.col(i).tail(nv) = rhs.head(nv);
    return true;
  }
  rates.col(0).head(nv) = state.v;
  rates.col(0).tail(nv) = state.vdot;
  return true;
}

/// Theory manual eq. (integrator.40), with the factors of the last stage, near the end of the step.
bool DormandPrince::Workspace::close_positions(Equations& equations, int most) {
  moved.setZero(nv);
  turned.setZero(nv);
  if (nlambda == 0) return true;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most; ++i) {
    equations.constraints(trial, phi, lengths, nullptr);
    const double violation = phi.cwiseQuotient(lengths).lpNorm<Eigen::Infinity>();
    if (violation <= kRoundOffOfPositions) return true;
    if (!(violation < kLeastProgress * last)) {
      if (violation <= kLargestViolation) return true;
      break;
    }
    last = violation;
    rhs.setZero(nv + nlambda);
    rhs.tail(nlambda) = -phi;
    solve();
    correction = rhs.head(nv);
    moved += correction;
    position = trial.q;
    equations.retract(position, correction, trial.q);
  }
  return refuse(StepStatus::no_convergence, "positions do not return to the constraints");
}

/// The end of the step on the constraints, with its accelerations and multipliers, (integrator.41).
bool DormandPrince::Workspace::finish(Equations& equations, const State& state, double dt, int most) {
  set_change(kWeights, dt, change);
  trial.t = state.t + dt;
  correction = change.head(nv);
  equations.retract(state.q, correction, trial.q);
  trial.v = state.v + change.tail(nv);
  if (!close_positions(equations, most) || !assemble(equations, trial, true)) return false;
  if (nlambda > 0) {
    rhs.setZero(nv + nlambda);
    rhs.tail(nlambda) = -velocity;
    solve();
    turned = rhs.head(nv);
    trial.v += turned;
  }
  rhs.resize(nv + nlambda);
  rhs.head(nv) = -residual.head(nv);
  if (nlambda > 0) rhs.tail(nlambda) = -bias;
  solve();
  end = trial;
  end.vdot = rhs.head(nv);
  end.lambda = rhs.tail(nlambda);
  // The same factors correct what the projected velocity changes; and the equations are left at the end of the step.
  if (!assemble(equations, end, false)) return false;
  rhs.head(nv) = -residual.head(nv);
  if (nlambda > 0) {
    Eigen::Map<const Equations::SparseMatrix> view(matrix.rows(), matrix.cols(), matrix.nonZeros(),
                                                   matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr());
    rhs.tail(nlambda) = -bias;
    for (Index column = 0; column < nv; ++column)
      for (Eigen::Map<const Equations::SparseMatrix>::InnerIterator entry(view, column); entry; ++entry)
        if (entry.row() >= nv) rhs[entry.row()] -= entry.value() * end.vdot[column];
  }
  solve();
  end.vdot += rhs.head(nv);
  end.lambda += rhs.tail(nlambda);
  return (end.vdot.allFinite() && end.lambda.allFinite()) || refuse(StepStatus::singular, kSingular);
}

/// Theory manual eq. (integrator.38): of position, of velocity over the step, or what the projection has moved,
/// whichever is largest. Where constraints nearly depend on each other a small violation moves much, onto another
/// branch of the motion if nothing refused it.
void DormandPrince::Workspace::estimate_error(double dt) {
  set_change(kErrorOfFifthOrder, dt, fifth);
  set_change(kErrorOfThirdOrder, dt, third);
  error.resize(nv);
  const auto combine = [&](VectorXd& estimate, double reach) {
    for (Index k = 0; k < nv; ++k) {
      const double of_velocity = reach * estimate[nv + k];
      if (std::abs(of_velocity) > std::abs(estimate[k])) estimate[k] = of_velocity;
    }
  };
  combine(fifth, dt);
  combine(third, dt);
  const double five = fifth.head(nv).cwiseQuotient(position_scales).norm();
  const double three = third.head(nv).cwiseQuotient(position_scales).norm();
  const double both = std::hypot(five, std::sqrt(kThirdOrderShare) * three);
  error = (both > 0 ? five / both : 0.0) * fifth.head(nv);
  for (Index k = 0; k < nv; ++k) {
    if (std::abs(moved[k]) > std::abs(error[k])) error[k] = moved[k];
    if (std::abs(dt * turned[k]) > std::abs(error[k])) error[k] = dt * turned[k];
  }
}

DormandPrince::DormandPrince(const DormandPrinceOptions& options)
    : options_(options), work_(std::make_unique<Workspace>()) {
  HERSEY_REQUIRE(options.max_iterations > 0, "options are positive");
}

DormandPrince::~DormandPrince() = default;
DormandPrince::DormandPrince(DormandPrince&&) noexcept = default;
DormandPrince& DormandPrince::operator=(DormandPrince&&) noexcept = default;

double DormandPrince::linear_solve_time() const { return work_->linear_solve_time; }

StepSummary DormandPrince::step(Equations& equations, State& state, double dt, const StepCheck& is_accurate) {
  HERSEY_REQUIRE(dt > 0, "time runs forward");
  Workspace& w = *work_;
  StepSummary summary;
  equations.begin_step(state, dt);
  w.prepare(equations, state);
  const auto fail = [&](StepStatus status, const std::string& why) {
    summary.status = status;
    summary.iterations = w.evaluations;
    summary.message = fmt::format("t = {:.9g} s, step {:.3g} s: {}", state.t, dt, why);
    return summary;
  };
  for (int i = 0; i < kStages; ++i)
    if (!w.evaluate_stage(equations, state, dt, i)) return fail(w.why, w.reason);
  if (!w.finish(equations, state, dt, options_.max_iterations)) return fail(w.why, w.reason);
  if (is_accurate) {
    w.estimate_error(dt);
    if (!is_accurate(w.end, w.error)) return fail(StepStatus::inaccurate, "its error exceeds the tolerance");
  }
  state = w.end;
  equations.accept_step(state);
  summary.status = StepStatus::converged;
  summary.iterations = w.evaluations;
  return summary;
}

void DormandPrince::persist(Archive& archive) {
  Workspace& w = *work_;
  archive.io("analysed", w.analysed);
  const Archive::Group group(archive, "lu");
  w.lu.persist(archive);
}

}  // namespace hersey::solver
