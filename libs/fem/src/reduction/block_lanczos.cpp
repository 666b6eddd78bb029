#include "reduction/block_lanczos.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace hersey::fem {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index block_size = 8;        // more than the six rigid motions of a free body
constexpr double independent = 1e-12;  // squared norm left of a vector that lay in the space already

MatrixXd random_block(Index rows, Index columns, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

/// The basis built so far, with its products by B and the projection of A.
struct Basis {
  MatrixXd Q, BQ, H;
  Index used = 0;

  [[nodiscard]] auto vectors() const { return Q.leftCols(used); }
  [[nodiscard]] auto products() const { return BQ.leftCols(used); }

  /// Removes the part of W that lies in the basis and returns its components. One pass leaves round-off; the second
  /// pass removes it.
  MatrixXd remove_from(MatrixXd& W) const {
    if (used == 0) return {};
    MatrixXd taken = products().transpose() * W;
    W.noalias() -= vectors() * taken;
    return taken;
  }

  void append(const MatrixXd& W, const MatrixXd& BW) {
    const Index columns = W.cols();
    if (used + columns > Q.cols()) {
      const Index room = std::max(2 * Q.cols(), used + 8 * block_size);
      Q.conservativeResize(W.rows(), room);
      BQ.conservativeResize(W.rows(), room);
    }
    Q.middleCols(used, columns) = W;
    BQ.middleCols(used, columns) = BW;
    used += columns;
  }
};

/// B-orthonormal basis of W's columns; directions that W hardly has are dropped. `BW` receives its product by B.
MatrixXd orthonormalise(const LanczosProblem& problem, const MatrixXd& W, MatrixXd& BW) {
  BW = problem.B(W);
  const MatrixXd gram = W.transpose() * BW;
  const VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      MatrixXd(scale.asDiagonal() * ((gram + gram.transpose()) / 2) * scale.asDiagonal()));
  const VectorXd& d = eigen.eigenvalues();
  const Index kept = d[d.size() - 1] > 0 ? (d.array() > independent * d[d.size() - 1]).count() : 0;
  const MatrixXd T =
      scale.asDiagonal() * eigen.eigenvectors().rightCols(kept) * d.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  BW = BW * T;
  return W * T;
}

/// Eigenpairs of the projection and their residuals.
struct Ritz {
  VectorXd theta;     ///< ascending
  MatrixXd vectors;   ///< vectors in the basis
  VectorXd residual;  ///< ||A y - theta y||_B
};

/// `leaving` is the part of A's last block that left the space: only the last components of a Ritz vector take part in
/// it.
Ritz ritz_pairs(const LanczosProblem& problem, const MatrixXd& H, const MatrixXd& leaving) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(H);
  const MatrixXd gram = leaving.transpose() * problem.B(leaving);
  const MatrixXd last = eigen.eigenvectors().bottomRows(leaving.cols());
  return {eigen.eigenvalues(), eigen.eigenvectors(),
          (last.transpose() * gram * last).diagonal().cwiseMax(0).cwiseSqrt()};
}

/// Number of pairs that the caller requests.
Index asked(const Ritz& ritz, int wanted, double smallest) {
  return std::min<Index>(wanted, (ritz.theta.array() >= smallest).count());
}

bool is_converged(const Ritz& ritz, Index needed, double rtol) {
  const Index size = ritz.theta.size();
  if (size <= needed) return false;
  // The first pair beyond those requested must be known to a few digits, because it might still belong to them.
  for (Index i = 0; i <= needed; ++i) {
    const Index k = size - 1 - i;
    if (!(ritz.residual[k] <= (i < needed ? rtol : 1e-3) * std::abs(ritz.theta[k]))) return false;
  }
  return true;
}

/// Projects A on the basis' last block `W`; returns what A W has outside the basis.
MatrixXd extend_projection(const LanczosProblem& problem, const MatrixXd& W, Basis& basis) {
  MatrixXd AW = problem.A(W);
  MatrixXd h = basis.remove_from(AW);
  h += basis.remove_from(AW);
  basis.H.conservativeResize(basis.used, basis.used);
  basis.H.rightCols(W.cols()) = h;
  basis.H.bottomRows(W.cols()) = h.transpose();
  auto corner = basis.H.bottomRightCorner(W.cols(), W.cols());
  corner = ((corner + corner.transpose()) / 2).eval();
  return AW;
}

/// Block of at most as many columns as the space has dimensions left, orthonormal to the basis and to itself to
/// round-off; what the first round has magnified the second takes away.
MatrixXd new_block(const LanczosProblem& problem, const Basis& basis, const MatrixXd& from, MatrixXd& BW) {
  MatrixXd W = from.leftCols(std::min(from.cols(), problem.rank - basis.used));
  for (int round = 0; round < 2 && W.cols() > 0; ++round) {
    basis.remove_from(W);
    W = orthonormalise(problem, W, BW);
  }
  return W;
}

}  // namespace

LanczosResult block_lanczos(const LanczosProblem& problem, int wanted, double smallest, double rtol) {
  LanczosResult result;
  result.solves = 1;
  std::mt19937_64 generator(20240229);  // the same for every run
  Basis basis;
  const Index block = std::min(block_size, problem.rank);
  MatrixXd BW;
  MatrixXd W = new_block(problem, basis, problem.A(random_block(problem.size, block, generator)),
                         BW);  // in the space A maps into
  while (W.cols() > 0) {
    basis.append(W, BW);
    const MatrixXd leaving = extend_projection(problem, W, basis);
    ++result.solves;
    const Ritz ritz = ritz_pairs(problem, basis.H, leaving);
    const Index needed = asked(ritz, wanted, smallest);
    if (basis.used >= problem.rank || is_converged(ritz, needed, rtol)) {
      result.set_solved(true);
      result.theta = ritz.theta.tail(needed).reverse();
      result.vectors = basis.vectors() * ritz.vectors.rightCols(needed).rowwise().reverse();
      return result;
    }
    W = new_block(problem, basis, leaving, BW);
    // An invariant space of A: the remaining directions are found from a new start.
    if (W.cols() == 0) W = new_block(problem, basis, problem.A(random_block(problem.size, block, generator)), BW);
  }
  result.fail("the iteration for modes found no further direction");
  return result;
}

}  // namespace hersey::fem
