#include "kkt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hersey::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Dependencies of exact geometry show up at round-off; ill-conditioned but independent rows stay well above this.
constexpr double kRankThreshold = 1e-10;

MatrixXd normalised_rows(const MatrixXd& G) {
  MatrixXd scaled = G;
  for (Index i = 0; i < G.rows(); ++i)
    if (const double norm = G.row(i).norm(); norm > 0) scaled.row(i) /= norm;
  return scaled;
}

/// 1/sqrt(M_kk): coordinates of unit inertia. Those without inertia get the largest of the others' scales.
VectorXd inertia_scales(const MatrixXd& M) {
  const VectorXd diagonal = M.diagonal();
  const double largest = diagonal.size() > 0 ? diagonal.maxCoeff() : 0;
  VectorXd s = VectorXd::Ones(M.rows());
  double largest_scale = largest > 0 ? 0 : 1;
  for (Index k = 0; k < s.size(); ++k) {
    if (!(diagonal[k] > 0)) continue;
    s[k] = 1 / std::sqrt(diagonal[k]);
    largest_scale = std::max(largest_scale, s[k]);
  }
  for (Index k = 0; k < s.size(); ++k)
    if (!(diagonal[k] > 0)) s[k] = largest_scale;
  return s;
}

}  // namespace

RankAnalysis analyse_rank(const MatrixXd& G) {
  RankAnalysis analysis;
  if (G.rows() == 0) return analysis;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(normalised_rows(G).transpose());
  qr.setThreshold(kRankThreshold);
  analysis.rank = qr.rank();
  if (analysis.rank == G.rows()) return analysis;

  // Each dependent row is a combination of the first `rank` pivots: R11 z = r12.
  const MatrixXd R = qr.matrixR().template triangularView<Eigen::Upper>();
  const Index r = analysis.rank;
  const auto& order = qr.colsPermutation().indices();
  std::set<Index> involved;
  for (Index d = r; d < G.rows(); ++d) {
    involved.insert(order[d]);
    const VectorXd z = R.topLeftCorner(r, r).template triangularView<Eigen::Upper>().solve(R.col(d).head(r));
    for (Index i = 0; i < r; ++i)
      if (std::abs(z[i]) > 1e-6) involved.insert(order[i]);
  }
  analysis.involved.assign(involved.begin(), involved.end());
  return analysis;
}

AccelerationSolution solve_kkt(const MatrixXd& M, const MatrixXd& G, const VectorXd& h, const VectorXd& gamma) {
  const Index n = M.rows(), constraints = G.rows();
  const VectorXd s = inertia_scales(M);
  const MatrixXd M_s = s.asDiagonal() * M * s.asDiagonal();
  MatrixXd G_s = G * s.asDiagonal();
  VectorXd row_scale = VectorXd::Ones(constraints);
  for (Index i = 0; i < constraints; ++i)
    if (const double norm = G_s.row(i).norm(); norm > 0) row_scale[i] = 1 / norm;
  G_s = row_scale.asDiagonal() * G_s;

  // G_s^T = Q [R; 0] P^T: the first columns of Q span the constrained directions, the others the free ones.
  MatrixXd Q = MatrixXd::Identity(n, n);
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  if (constraints > 0) {
    qr.compute(G_s.transpose());
    Q = qr.householderQ() * MatrixXd::Identity(n, n);
  }
  const MatrixXd held = Q.leftCols(constraints), free = Q.rightCols(n - constraints);

  AccelerationSolution solution;
  Eigen::SelfAdjointEigenSolver<MatrixXd> inertia(n - constraints);
  if (free.cols() > 0) inertia.compute(free.transpose() * M_s * free);
  for (Index i = 0; i < free.cols(); ++i) {
    if (inertia.eigenvalues()[i] > 1e-12) continue;
    const VectorXd motion = free * inertia.eigenvectors().col(i);
    for (Index k = 0; k < n; ++k)
      if (std::abs(motion[k]) > 0.1 * motion.cwiseAbs().maxCoeff()) solution.undetermined.push_back(k);
  }
  std::sort(solution.undetermined.begin(), solution.undetermined.end());
  solution.undetermined.erase(std::unique(solution.undetermined.begin(), solution.undetermined.end()),
                              solution.undetermined.end());
  if (!solution.undetermined.empty()) return solution;

  VectorXd y = VectorXd::Zero(n);
  const auto triangle = [&] { return qr.matrixR().topLeftCorner(constraints, constraints); };
  if (constraints > 0) {
    const VectorXd right = qr.colsPermutation().transpose() * VectorXd(-(row_scale.asDiagonal() * gamma));
    y = held * triangle().transpose().template triangularView<Eigen::Lower>().solve(right);
  }
  const VectorXd h_s = s.asDiagonal() * h;
  if (free.cols() > 0) {
    const VectorXd modal = inertia.eigenvectors().transpose() * (free.transpose() * (h_s + M_s * y));
    y -= free * (inertia.eigenvectors() * modal.cwiseQuotient(inertia.eigenvalues()));
  }
  solution.vdot = s.asDiagonal() * y;
  solution.lambda = VectorXd::Zero(constraints);
  if (constraints > 0) {
    const VectorXd load = held.transpose() * -(h_s + M_s * y);
    const VectorXd l = triangle().template triangularView<Eigen::Upper>().solve(load);
    solution.lambda = row_scale.asDiagonal() * VectorXd(qr.colsPermutation() * l);
  }
  return solution;
}

std::string assemble_forces(Equations& equations, const State& state, VectorXd& h, MatrixXd& M) {
  constexpr int max_iterations = 60;
  constexpr double internal_rtol = 1e-10;
  const Index nv = equations.nv();
  State at_rest = state;
  at_rest.vdot.setZero(nv);
  at_rest.lambda.setZero(equations.nlambda());
  const Stage stage{.dt = 0, .k = 0, .c = 0, .m = 1, .dq = {}};
  VectorXd residual, scale;
  Equations::SparseMatrix tangent;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    equations.assemble(at_rest, stage, residual, scale, &tangent);
    if (std::string trouble = equations.domain_error(); !trouble.empty()) return trouble;
    if (!residual.allFinite()) return "the forces are not numbers";
    if (equations.internal_residual() > internal_rtol) continue;
    h = residual.head(nv);
    M = MatrixXd(tangent).topLeftCorner(nv, nv);
    return {};
  }
  return fmt::format("{} is not solved in {} iterations (relative residual {:.2g})",
                     equations.name_of_internal_residual(), max_iterations, equations.internal_residual());
}

bool solve_accelerations(Equations& equations, State& state) {
  VectorXd h, phi, scale, velocity, gamma;
  MatrixXd M;
  Equations::SparseMatrix G;
  if (!assemble_forces(equations, state, h, M).empty()) return false;
  equations.constraints(state, phi, scale, &G);
  equations.constraint_rates(state, velocity, gamma);
  const MatrixXd dense_G(G);
  if (!analyse_rank(dense_G).involved.empty()) return false;
  AccelerationSolution solution = solve_kkt(M, dense_G, h, gamma);
  if (!solution.undetermined.empty()) return false;
  state.vdot = std::move(solution.vdot);
  state.lambda = std::move(solution.lambda);
  return true;
}

}  // namespace hersey::solver
