#include "hersey/solver/reduced_coefficients.h"

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// Directions of the free motions: those that move one chosen coordinate by 1 and no other chosen one, then those that
/// move none.
MatrixXd chosen_first(const MatrixXd& Z, const std::vector<Equations::Index>& chosen) {
  MatrixXd S(static_cast<Index>(chosen.size()), Z.cols());
  for (Index k = 0; k < S.rows(); ++k) S.row(k) = Z.row(chosen[static_cast<std::size_t>(k)]);
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition(S);
  HERSEY_REQUIRE(decomposition.rank() == S.rows(), "motions of the chosen coordinates are free and independent");
  const Eigen::FullPivLU<MatrixXd> lu(S);
  MatrixXd T(Z.cols(), Z.cols());
  T.leftCols(S.rows()) = decomposition.pseudoInverse();
  if (S.rows() < Z.cols()) T.rightCols(Z.cols() - S.rows()) = lu.kernel();
  return T;
}

}  // namespace

ReducedCoefficients reduce(const Linearisation& linear, const std::vector<Equations::Index>& chosen, double omega) {
  const MatrixXd T = chosen_first(linear.Z, chosen);
  const Index a = static_cast<Index>(chosen.size()), b = T.cols() - a;
  const auto projected = [&](const MatrixXd& A) { return MatrixXd(T.transpose() * A * T); };
  const MatrixXd K = projected(linear.K), C = projected(linear.C), M = projected(linear.M);
  ReducedCoefficients reduced{K.topLeftCorner(a, a), C.topLeftCorner(a, a)};
  if (b == 0) return reduced;
  if (omega == 0) {
    const MatrixXd follow = K.bottomRightCorner(b, b).fullPivLu().solve(K.bottomLeftCorner(b, a));
    const MatrixXd lead =
        K.bottomRightCorner(b, b).transpose().fullPivLu().solve(K.topRightCorner(a, b).transpose()).transpose();
    reduced.K -= K.topRightCorner(a, b) * follow;
    reduced.C +=
        lead * C.bottomRightCorner(b, b) * follow - C.topRightCorner(a, b) * follow - lead * C.bottomLeftCorner(b, a);
    return reduced;
  }
  const std::complex<double> i(0, 1);
  const MatrixXcd D = K + i * omega * C - omega * omega * M;
  const MatrixXcd follow = D.bottomRightCorner(b, b).fullPivLu().solve(D.bottomLeftCorner(b, a));
  const MatrixXcd change = D.topRightCorner(a, b) * follow;
  reduced.K -= change.real();
  reduced.C -= change.imag() / omega;
  return reduced;
}

}  // namespace hersey::solver
