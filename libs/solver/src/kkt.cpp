#include "kkt.h"

#include <fmt/format.h>

#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>
#include <set>

#include "sparse_kkt.h"

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

/// Solves  M x + G^T l = a,  G x = b  for x and l, M semidefinite and G of full row rank, in the null space of G.
class NullSpaceSolver {
 public:
  NullSpaceSolver(const MatrixXd& M, const MatrixXd& G)
      : s_(inertia_scales(M.diagonal())), row_scale_(VectorXd::Ones(G.rows())), inertia_(M.rows() - G.rows()) {
    const Index n = M.rows(), constraints = G.rows();
    M_s_ = s_.asDiagonal() * M * s_.asDiagonal();
    MatrixXd G_s = G * s_.asDiagonal();
    for (Index i = 0; i < constraints; ++i)
      if (const double norm = G_s.row(i).norm(); norm > 0) row_scale_[i] = 1 / norm;
    G_s = row_scale_.asDiagonal() * G_s;
    // G_s^T = Q [R; 0] P^T: the first columns of Q span the constrained directions, the others the free ones.
    MatrixXd Q = MatrixXd::Identity(n, n);
    if (constraints > 0) {
      qr_.compute(G_s.transpose());
      R_ = qr_.matrixR().topLeftCorner(constraints, constraints);
      Q = qr_.householderQ() * Q;
    }
    constrained_ = Q.leftCols(constraints);
    free_ = Q.rightCols(n - constraints);
    if (free_.cols() > 0) inertia_.compute(free_.transpose() * M_s_ * free_);
  }

  /// Components of the free motions that have no inertia.
  [[nodiscard]] std::vector<Index> undetermined() const {
    std::set<Index> components;
    for (Index i = 0; i < free_.cols(); ++i) {
      if (inertia_.eigenvalues()[i] > kNoInertia) continue;
      const VectorXd motion = (free_ * inertia_.eigenvectors().col(i)).cwiseAbs();
      for (Index k = 0; k < motion.size(); ++k)
        if (motion[k] > 0.1 * motion.maxCoeff()) components.insert(k);
    }
    return {components.begin(), components.end()};
  }

  /// Free motions that have no inertia, a column each.
  [[nodiscard]] MatrixXd massless() const {
    const Index n = free_.cols() > 0 ? (inertia_.eigenvalues().array() <= kNoInertia).count() : 0;
    if (n == 0) return MatrixXd(s_.size(), 0);
    return s_.asDiagonal() * (free_ * inertia_.eigenvectors().leftCols(n));  // eigenvalues ascend
  }

  /// Motions without inertia get no acceleration.
  void solve(const VectorXd& a, const VectorXd& b, VectorXd& x, VectorXd& l) const {
    const Index constraints = constrained_.cols();
    VectorXd y = VectorXd::Zero(s_.size());
    if (constraints > 0) {
      const VectorXd right = qr_.colsPermutation().transpose() * VectorXd(row_scale_.asDiagonal() * b);
      y = constrained_ * R_.transpose().template triangularView<Eigen::Lower>().solve(right);
    }
    const VectorXd a_s = s_.asDiagonal() * a;
    if (free_.cols() > 0) {
      const VectorXd modal = inertia_.eigenvectors().transpose() * (free_.transpose() * (a_s - M_s_ * y));
      const VectorXd given = modal.cwiseQuotient(inertia_.eigenvalues());
      y +=
          free_ * (inertia_.eigenvectors() * (inertia_.eigenvalues().array() > kNoInertia).select(given, 0.0).matrix());
    }
    x = s_.asDiagonal() * y;
    l = VectorXd::Zero(constraints);
    if (constraints == 0) return;
    const VectorXd left = R_.template triangularView<Eigen::Upper>().solve(constrained_.transpose() * (a_s - M_s_ * y));
    l = row_scale_.asDiagonal() * VectorXd(qr_.colsPermutation() * left);
  }

 private:
  VectorXd s_, row_scale_;
  MatrixXd M_s_, constrained_, free_, R_;
  Eigen::ColPivHouseholderQR<MatrixXd> qr_;
  Eigen::SelfAdjointEigenSolver<MatrixXd> inertia_;
};

}  // namespace

void fill_jacobian(const Equations::SparseMatrix& G, Index nv, Equations::SparseMatrix& S) {
  if (G.rows() == 0) return;
  for (Index column = 0; column < nv; ++column)
    for (Equations::SparseMatrix::InnerIterator entry(G, column); entry; ++entry)
      S.coeffRef(nv + entry.row(), column) = entry.value();
}

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

namespace {

/// [1, G^T; G, 0]: as singular as G's rows depend on each other.
Equations::SparseMatrix bordered_identity(const Equations::SparseMatrix& G) {
  const auto n = static_cast<int>(G.cols()), size = n + static_cast<int>(G.rows());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n + 2 * G.nonZeros()));
  for (int k = 0; k < n; ++k) entries.emplace_back(k, k, 1.0);
  for (int column = 0; column < n; ++column) {
    for (Equations::SparseMatrix::InnerIterator entry(G, column); entry; ++entry) {
      entries.emplace_back(n + static_cast<int>(entry.row()), column, entry.value());
      entries.emplace_back(column, n + static_cast<int>(entry.row()), entry.value());
    }
  }
  Equations::SparseMatrix S(size, size);
  S.setFromTriplets(entries.begin(), entries.end());
  return S;
}

}  // namespace

// Elimination is linear in the length of a chain, the QR decomposition is quadratic: it is used only if elimination is
// not conclusive.
bool has_full_rank(const Equations::SparseMatrix& G) {
  if (G.rows() == 0) return true;
  if (G.rows() > G.cols()) return false;
  VectorXd norm = VectorXd::Zero(G.rows());
  for (Index column = 0; column < G.cols(); ++column)
    for (Equations::SparseMatrix::InnerIterator entry(G, column); entry; ++entry)
      norm[entry.row()] += entry.value() * entry.value();
  if (!(norm.minCoeff() > 0)) return false;
  const Equations::SparseMatrix S = bordered_identity(G);
  if (SparseKkt(S, G.cols()).sound()) return true;
  const VectorXd scale = norm.cwiseSqrt().cwiseInverse();
  Equations::SparseMatrix columns = Equations::SparseMatrix(scale.asDiagonal() * G).transpose();
  columns.makeCompressed();
  Eigen::SparseQR<Equations::SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(kRankThreshold);
  qr.compute(columns);
  return qr.rank() == G.rows();
}

VectorXd smallest_increment(const Equations::SparseMatrix& G, const VectorXd& residual, const VectorXd& weight) {
  if (G.rows() == 0) return VectorXd::Zero(G.cols());
  const Equations::SparseMatrix S = bordered_identity(G * weight.asDiagonal());
  VectorXd x, b = VectorXd::Zero(S.rows());
  b.tail(G.rows()) = -residual;
  if (const SparseKkt kkt(S, G.cols()); kkt.sound() && kkt.solve(b, x)) return weight.cwiseProduct(x.head(G.cols()));
  // With (G W)^T = Q R P^T the smallest z with G W z = b is Q R^-T P^T b.
  Equations::SparseMatrix columns = Equations::SparseMatrix(G * weight.asDiagonal()).transpose();
  columns.makeCompressed();
  Eigen::SparseQR<Equations::SparseMatrix, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(0);
  qr.compute(columns);
  const Index rows = G.rows();
  const Equations::SparseMatrix R = qr.matrixR().topLeftCorner(rows, rows);
  VectorXd z = VectorXd::Zero(G.cols());
  z.head(rows) = -(qr.colsPermutation().transpose() * residual);
  z.head(rows) = VectorXd(R.transpose().triangularView<Eigen::Lower>().solve(VectorXd(z.head(rows))));
  return weight.asDiagonal() * VectorXd(qr.matrixQ() * z);
}

AccelerationSolution solve_kkt(const Equations::SparseMatrix& S, Index nv, const VectorXd& h, const VectorXd& gamma) {
  AccelerationSolution solution;
  VectorXd x, b(S.rows());
  b << -h, -gamma;
  if (const SparseKkt kkt(S, nv); kkt.all_motions_have_inertia(nv) && kkt.solve(b, x)) {
    solution.vdot = x.head(nv);
    solution.lambda = x.tail(S.rows() - nv);
    return solution;
  }
  const MatrixXd dense(S);
  return solve_kkt(MatrixXd(dense.topLeftCorner(nv, nv)), MatrixXd(dense.bottomLeftCorner(S.rows() - nv, nv)), h,
                   gamma);
}

namespace {

AccelerationSolution solve_refined(const NullSpaceSolver& solver, const MatrixXd& M, const MatrixXd& G,
                                   const VectorXd& h, const VectorXd& gamma) {
  AccelerationSolution solution;
  solver.solve(-h, -gamma, solution.vdot, solution.lambda);
  // One refinement returns the digits that inertias of very different size cost.
  VectorXd dv, dl;
  solver.solve(-h - M * solution.vdot - G.transpose() * solution.lambda, -gamma - G * solution.vdot, dv, dl);
  solution.vdot += dv;
  solution.lambda += dl;
  return solution;
}

struct Blocks {
  MatrixXd M, G;
};

Blocks blocks_of(const Equations::SparseMatrix& S, Index nv) {
  const MatrixXd dense(S);
  return {dense.topLeftCorner(nv, nv), dense.bottomLeftCorner(S.rows() - nv, nv)};
}

}  // namespace

AccelerationSolution solve_kkt(const MatrixXd& M, const MatrixXd& G, const VectorXd& h, const VectorXd& gamma) {
  const NullSpaceSolver solver(M, G);
  AccelerationSolution solution;
  solution.undetermined = solver.undetermined();
  return solution.undetermined.empty() ? solve_refined(solver, M, G, h, gamma) : solution;
}

MatrixXd massless_motions(const Equations::SparseMatrix& S, Index nv) {
  const Blocks blocks = blocks_of(S, nv);
  return NullSpaceSolver(blocks.M, blocks.G).massless();
}

AccelerationSolution solve_kkt_but_massless(const Equations::SparseMatrix& S, Index nv, const VectorXd& h,
                                            const VectorXd& gamma) {
  const Blocks blocks = blocks_of(S, nv);
  return solve_refined(NullSpaceSolver(blocks.M, blocks.G), blocks.M, blocks.G, h, gamma);
}

bool solve_bordered(const Equations::SparseMatrix& S, Index nv, const VectorXd& b, VectorXd& x) {
  const SparseKkt kkt(S, nv);
  return kkt.sound() && kkt.solve(b, x);
}

Outcome assemble_forces(Equations& equations, const State& state, double dt, VectorXd& h, Equations::SparseMatrix& S) {
  constexpr int max_iterations = 60;
  constexpr double internal_rtol = 1e-10;
  const Index nv = equations.nv();
  State at_rest = state;
  at_rest.vdot.setZero(nv);
  at_rest.lambda.setZero(equations.nlambda());
  const Stage stage{.dt = dt, .k = 0, .c = 0, .m = 1, .dq = {}};
  VectorXd residual, scale;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    equations.assemble(at_rest, stage, residual, scale, &S);
    if (std::string why = equations.domain_error(); !why.empty()) return no_answer<Outcome>(std::move(why));
    if (!residual.allFinite()) {
      const auto wrong = std::find_if(residual.begin(), residual.end(), [](double r) { return !std::isfinite(r); });
      return no_answer<Outcome>(equations.name_of_row(wrong - residual.begin()) + ": the forces there are not numbers");
    }
    if (equations.internal_residual() > internal_rtol) continue;
    h = residual.head(nv);
    if (equations.nlambda() > 0) {
      VectorXd phi, sizes;
      Equations::SparseMatrix G;
      equations.constraints(at_rest, phi, sizes, &G);
      fill_jacobian(G, nv, S);
    }
    return {Ending::solved};
  }
  return no_answer<Outcome>(fmt::format("{} is not solved in {} iterations (relative residual {:.2g})",
                                        equations.name_of_internal_residual(), max_iterations,
                                        equations.internal_residual()));
}

}  // namespace hersey::solver
