#include "held_lanczos.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Operator = std::function<VectorXd(const VectorXd&)>;

constexpr double kTolerance = 1e-10;

/// Vectors V with V^T M V = 1 and T = V^T M S V tridiagonal.
struct Basis {
  MatrixXd V, MV;
  VectorXd diagonal, side;
  Index size = 0;
};

/// A random vector in the range of S, orthogonal to those before: begins the basis, and goes on where an invariant
/// subspace is exhausted (repeated eigenvalues).
bool begin_vector(Basis& basis, const Operator& apply, const Operator& mass, std::mt19937& random, VectorXd& v) {
  std::normal_distribution<double> normal;
  for (double& x : v) x = normal(random);
  v = apply(v);
  const double before = std::sqrt(std::max(v.dot(mass(v)), 0.0));
  for (int pass = 0; pass < 2 && basis.size > 0; ++pass)
    v -= basis.V.leftCols(basis.size) * (basis.MV.leftCols(basis.size).transpose() * v);
  const double after = std::sqrt(std::max(v.dot(mass(v)), 0.0));
  if (!(after > 1e-10 * before)) return false;
  v /= after;
  return true;
}

void grow(Basis& basis, Index wanted, const Operator& apply, const Operator& mass) {
  const Index n = basis.V.rows();
  std::mt19937 random(1);
  VectorXd v(n);
  if (!begin_vector(basis, apply, mass, random, v)) return;
  while (basis.size < wanted) {
    const Index j = basis.size++;
    basis.V.col(j) = v;
    basis.MV.col(j) = mass(v);
    v = apply(v);
    basis.diagonal[j] = v.dot(basis.MV.col(j));
    const double size = std::sqrt(std::max(v.dot(mass(v)), 0.0));
    for (int pass = 0; pass < 2; ++pass)
      v -= basis.V.leftCols(basis.size) * (basis.MV.leftCols(basis.size).transpose() * v);
    const double left = std::sqrt(std::max(v.dot(mass(v)), 0.0));
    basis.side[j] = left;
    if (left > 1e-12 * size) {
      v /= left;
      continue;
    }
    basis.side[j] = 0;
    if (!begin_vector(basis, apply, mass, random, v)) return;
  }
}

}  // namespace

LanczosModes largest_modes(Index size, int count, const Operator& apply, const Operator& mass) {
  LanczosModes modes;
  if (count <= 0 || size == 0) return modes;
  for (Index wanted = 2 * static_cast<Index>(count) + 20;; wanted *= 2) {
    const Index most = std::min(wanted, size);
    Basis basis{MatrixXd(size, most), MatrixXd(size, most), VectorXd::Zero(most), VectorXd::Zero(most), 0};
    grow(basis, most, apply, mass);
    MatrixXd T = basis.diagonal.head(basis.size).asDiagonal();
    for (Index j = 0; j + 1 < basis.size; ++j) T(j, j + 1) = T(j + 1, j) = basis.side[j];
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(T);
    const Index found = std::min<Index>(count, basis.size);
    const double last = basis.size > 0 ? basis.side[basis.size - 1] : 0;
    const VectorXd theta = eigen.eigenvalues().reverse().head(found);
    const MatrixXd y = eigen.eigenvectors().rowwise().reverse().leftCols(found);
    const bool converged =
        found == 0 ||
        ((last * y.row(basis.size - 1).transpose()).cwiseAbs().array() <= kTolerance * theta.array()).all();
    if (!converged && most < size) continue;
    modes.theta = theta;
    modes.vectors = basis.V.leftCols(basis.size) * y;
    return modes;
  }
}

}  // namespace hersey::mbd
