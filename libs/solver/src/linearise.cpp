#include "hersey/solver/linearise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "constraint_space.h"

namespace hersey::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The block of motions in the tangent for one stage.
MatrixXd tangent_block(Equations& equations, const State& state, const Stage& stage) {
  VectorXd residual, scale;
  Equations::SparseMatrix tangent;
  equations.assemble(state, stage, residual, scale, &tangent);
  return MatrixXd(tangent).topLeftCorner(equations.nv(), equations.nv());
}

Mode mode_of(const std::complex<double>& s, const Eigen::VectorXcd& y, const MatrixXd& Z) {
  Mode mode;
  mode.s = s;
  const double size = std::abs(s);
  mode.frequency = size / (2 * std::numbers::pi);
  mode.damped_frequency = s.imag() / (2 * std::numbers::pi);
  mode.damping_ratio = size > 0 ? -s.real() / size : 0;
  mode.shape = Z * y;
  Index largest = 0;
  mode.shape.cwiseAbs().maxCoeff(&largest);
  mode.shape /= std::complex<double>(mode.shape[largest]);
  return mode;
}

}  // namespace

Linearisation linearise(Equations& equations, const State& state, double dt) {
  Linearisation linear;
  linear.Z = free_directions(equations, state);
  const MatrixXd& Z = linear.Z;
  const auto block = [&](double k, double c, double m) {
    return MatrixXd(Z.transpose() * tangent_block(equations, state, {.dt = dt, .k = k, .c = c, .m = m, .dq = {}}) * Z);
  };
  linear.M = block(0, 0, 1);
  linear.C = block(0, 1, 0);
  linear.K = block(1, 0, 0);
  linear.trouble = equations.domain_error();
  return linear;
}

Modes find_modes(const Linearisation& linear) {
  Modes found;
  const Index n = linear.M.rows();
  if (n == 0) {
    found.message = "drives and joints prescribe every motion: there is nothing that could vibrate";
    return found;
  }
  const Eigen::LLT<MatrixXd> mass(linear.M);
  if (mass.info() != Eigen::Success) {
    found.message = "a free motion without inertia";
    return found;
  }
  // y = L^-T z makes the mass the identity: a well-scaled problem, symmetric where K is.
  const auto congruent = [&](const MatrixXd& A) {
    const MatrixXd left = mass.matrixL().solve(A);
    return MatrixXd(mass.matrixL().solve(left.transpose()).transpose());
  };
  const MatrixXd K = congruent(linear.K), C = congruent(linear.C);
  // Time in units of the fastest motion keeps both halves of the matrix of one size.
  const double omega = std::max(std::sqrt(K.norm()), C.norm());
  MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  if (omega > 0) {
    A.bottomLeftCorner(n, n) = -K / (omega * omega);
    A.bottomRightCorner(n, n) = -C / omega;
  }
  const Eigen::EigenSolver<MatrixXd> eigen(A);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  for (Index i = 0; i < 2 * n; ++i) {
    std::complex<double> s = eigen.eigenvalues()[i];
    // A motion nothing holds is a double zero: round-off splits it into roots of eps.
    if (std::abs(s) <= 1e-6 * largest) s = 0;
    if (s.imag() < 0) continue;
    const Eigen::VectorXcd z = eigen.eigenvectors().col(i).head(n);
    const Eigen::VectorXcd y = mass.matrixU().solve(z);
    const double y_largest = (linear.Z * y).cwiseAbs().maxCoeff();
    if (!(y_largest > 0)) continue;
    found.modes.push_back(mode_of(s * omega, y, linear.Z));
    if (s.real() > 1e-9 * largest) found.stable = false;
  }
  std::sort(found.modes.begin(), found.modes.end(),
            [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
  return found;
}

}  // namespace hersey::solver
