#include "hersey/solver/gmres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::solver {

void Gmres::make_room(int restart, Eigen::Index n) {
  const auto size = static_cast<std::size_t>(restart);
  if (basis_.size() < size + 1) basis_.resize(size + 1);
  if (preconditioned_.size() < size) preconditioned_.resize(size);
  hessenberg_.resize(restart + 1, restart);
  for (auto* vector : {&cosine_, &sine_, &g_, &y_}) vector->resize(restart + 1);
  residual_.resize(n);
}

// Modified Gram-Schmidt: the norm of what is left of basis k + 1, which is then normalised.
double Gmres::orthogonalise(int k) {
  Eigen::VectorXd& w = basis_[k + 1];
  for (int i = 0; i <= k; ++i) {
    hessenberg_(i, k) = basis_[i].dot(w);
    w.noalias() -= hessenberg_(i, k) * basis_[i];
  }
  const double norm = w.norm();
  hessenberg_(k + 1, k) = norm;
  if (norm > 0) w /= norm;
  return norm;
}

// Takes column k of the Hessenberg matrix to triangular form; the residual's norm after it.
double Gmres::rotate(int k, double norm) {
  for (int i = 0; i < k; ++i) {
    const double upper = hessenberg_(i, k), lower = hessenberg_(i + 1, k);
    hessenberg_(i, k) = cosine_[i] * upper + sine_[i] * lower;
    hessenberg_(i + 1, k) = cosine_[i] * lower - sine_[i] * upper;
  }
  const double r = std::hypot(hessenberg_(k, k), norm);
  cosine_[k] = r > 0 ? hessenberg_(k, k) / r : 1;
  sine_[k] = r > 0 ? norm / r : 0;
  hessenberg_(k, k) = r;
  g_[k + 1] = -sine_[k] * g_[k];
  g_[k] *= cosine_[k];
  return std::abs(g_[k + 1]);
}

void Gmres::add_combination(int k, Eigen::VectorXd& x) {
  for (int i = k - 1; i >= 0; --i) {
    double sum = g_[i];
    for (int j = i + 1; j < k; ++j) sum -= hessenberg_(i, j) * y_[j];
    y_[i] = hessenberg_(i, i) != 0 ? sum / hessenberg_(i, i) : 0;
  }
  for (int i = 0; i < k; ++i) x.noalias() += y_[i] * preconditioned_[i];
}

GmresSummary Gmres::solve(const Operator& A, const Operator& M, const Eigen::VectorXd& b, const GmresOptions& options,
                          Eigen::VectorXd& x) {
  HERSEY_REQUIRE(options.restart > 0, "at least one vector");
  make_room(options.restart, b.size());
  GmresSummary summary;
  x.setZero(b.size());
  residual_ = b;
  summary.residual_norm = b.norm();
  const double target = std::max(options.atol, options.rtol * summary.residual_norm);
  for (;;) {
    summary.set_solved(summary.residual_norm <= target);
    if (summary.solved() || summary.iterations >= options.max_iterations || !std::isfinite(summary.residual_norm)) {
      if (!summary.solved()) summary.message = fmt::format("no convergence in {} iterations", summary.iterations);
      return summary;
    }
    basis_[0] = residual_ / summary.residual_norm;
    g_[0] = summary.residual_norm;
    int k = 0;
    const double before = summary.residual_norm;
    while (k < options.restart && summary.iterations < options.max_iterations && summary.residual_norm > target) {
      M(basis_[k], preconditioned_[k]);
      A(preconditioned_[k], basis_[k + 1]);
      const double norm = orthogonalise(k);
      summary.residual_norm = rotate(k, norm);
      ++summary.iterations;
      ++k;
      if (norm == 0 || !std::isfinite(norm)) break;
    }
    add_combination(k, x);
    A(x, residual_);
    residual_ = b - residual_;
    summary.residual_norm = residual_.norm();
    if (!(summary.residual_norm < before)) {  // stagnation, or not a number
      summary.message = fmt::format("the residual stays where it is after {} iterations", summary.iterations);
      return summary;
    }
  }
}

}  // namespace hersey::solver
