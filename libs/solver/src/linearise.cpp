#include "hersey/solver/linearise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "constraint_space.h"

namespace hersey::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSlow = 1e-4;   // of the fastest motion: below, round-off of 1e-8 and more
constexpr double kShift = 1e-5;  // of the fastest motion, where inverses are taken

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

Linearisation linearise(Equations& equations, const State& state, double dt,
                        const std::vector<Equations::Index>& released) {
  Linearisation linear;
  const MatrixXd free = free_directions(equations, state);
  const auto more = static_cast<Index>(released.size());
  linear.Z.setZero(free.rows(), free.cols() + more);
  linear.Z.leftCols(free.cols()) = free;
  for (Index k = 0; k < more; ++k) linear.Z(released[static_cast<std::size_t>(k)], free.cols() + k) = 1;
  const MatrixXd& Z = linear.Z;
  const auto block = [&](double k, double c, double m) {
    return MatrixXd(Z.transpose() * tangent_block(equations, state, {.dt = dt, .k = k, .c = c, .m = m, .dq = {}}) * Z);
  };
  linear.M = block(0, 0, 1);
  linear.C = block(0, 1, 0);
  linear.K = block(1, 0, 0);
  linear.message = equations.domain_error();
  linear.set_solved(linear.message.empty());
  return linear;
}

/// A root of the quadratic eigenvalue problem.
struct Root {
  std::complex<double> s;  ///< [1/s]
  Eigen::VectorXcd y;
  double uncertainty = 0;  ///< uncertainty of the real part [1/s]
};

/// Returns the roots near `shift` by inversion of the stiffness, which the fastest motions dominate: theory manual eq.
/// (integrator.28).
std::vector<Root> roots_near(const Linearisation& linear, double shift) {
  const Index n = linear.M.rows();
  // Units in which no coordinate is large or small by inertia, times in units of 1/shift.
  const VectorXd d = linear.M.diagonal().cwiseSqrt().cwiseInverse();
  const auto scaled = [&](const MatrixXd& A) { return MatrixXd(d.asDiagonal() * A * d.asDiagonal()); };
  const MatrixXd M = scaled(linear.M), C = scaled(linear.C) / shift, K = scaled(linear.K) / (shift * shift);
  const Eigen::FullPivLU<MatrixXd> stiffness(K + C + M);
  MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -stiffness.solve(M);
  A.bottomRightCorner(n, n) = -stiffness.solve(C + 2 * M);
  const Eigen::EigenSolver<MatrixXd> eigen(A);
  std::vector<Root> roots;
  for (Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> mu = eigen.eigenvalues()[i];
    if (mu == 0.0) continue;
    roots.push_back({shift * (1.0 + 1.0 / mu), d.asDiagonal() * eigen.eigenvectors().col(i).head(n), 0});
  }
  return roots;
}

/// Returns the spurious eigenvalue of a motion without stiffness caused by round-off of the stiffness [1/s].
double noise_of(const Linearisation& linear, const Eigen::VectorXcd& y) {
  const VectorXd size = y.cwiseAbs();
  const double inertia = std::abs((y.adjoint() * linear.M * y).value());
  const double eps = 100 * std::numeric_limits<double>::epsilon();
  return std::sqrt(eps * size.dot(linear.K.cwiseAbs() * size) / inertia) +
         eps * size.dot(linear.C.cwiseAbs() * size) / inertia;
}

/// Replaces the slow ones among `roots` by those that do not carry the round-off of the fast ones. A slender blade
/// bends a million times slower than its sections shear.
void refine_slow(const Linearisation& linear, double fastest, std::vector<Root>& roots) {
  const auto by_size = [](const Root& a, const Root& b) { return std::abs(a.s) < std::abs(b.s); };
  std::sort(roots.begin(), roots.end(), by_size);
  const auto slow = static_cast<std::size_t>(
      std::count_if(roots.begin(), roots.end(), [&](const Root& r) { return std::abs(r.s) <= kSlow * fastest; }));
  if (slow == 0) return;
  const double shift = kShift * fastest;
  std::vector<Root> near = roots_near(linear, shift);
  std::sort(near.begin(), near.end(), by_size);
  for (std::size_t i = 0; i < std::min(slow, near.size()); ++i) {
    // A motion without stiffness has a double zero eigenvalue, which round-off splits.
    const double noise = noise_of(linear, near[i].y), size = std::abs(near[i].s);
    if (size <= std::max(1e-6 * shift, noise)) near[i].s = 0;
    near[i].uncertainty = std::max(1e-6 * size, noise * noise / size);
    roots[i] = std::move(near[i]);
  }
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
  std::vector<Root> roots;
  for (Index i = 0; i < 2 * n; ++i) {
    const Eigen::VectorXcd z = eigen.eigenvectors().col(i).head(n);
    roots.push_back({eigen.eigenvalues()[i] * omega, mass.matrixU().solve(z), 0});
  }
  const double fastest = eigen.eigenvalues().cwiseAbs().maxCoeff() * omega;
  for (Root& root : roots) root.uncertainty = 1e-9 * fastest;
  refine_slow(linear, fastest, roots);
  for (const Root& root : roots) {
    if (root.s.imag() < 0) continue;
    found.modes.push_back(mode_of(root.s, root.y, linear.Z));
    if (root.s.real() > root.uncertainty) found.stable = false;
  }
  std::sort(found.modes.begin(), found.modes.end(),
            [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
  found.set_solved(true);
  return found;
}

}  // namespace hersey::solver
