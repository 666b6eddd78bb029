#pragma once

#include <Eigen/Dense>
#include <algorithm>

#include "film_cases.h"

extern "C" void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
                       const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                       const double* beta, double* c, const int* ldc);

namespace hersey::bench {

/// What one core can do at best, measured on the spot: benchmarks print it beside what they reach.
struct MachineLimits {
  double bandwidth = 0;  ///< of the triad a = b + s c on arrays beyond all caches [B/s]
  double flops = 0;      ///< of the product of large dense matrices by BLAS, in double precision [1/s]
};

/// Measures them, in half a second. BLAS may take one thread: OPENBLAS_NUM_THREADS=1.
inline MachineLimits machine_limits() {
  constexpr int numbers = 1 << 24, order = 768, runs = 3;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(numbers), c = b;
  Eigen::VectorXd a = b;
  MachineLimits limits;
  limits.bandwidth = 3.0 * sizeof(double) * numbers / film::shortest(runs, [&] { a.noalias() = b + 0.5 * c; });
  const Eigen::MatrixXd left = Eigen::MatrixXd::Random(order, order), right = left;
  Eigen::MatrixXd product(order, order);
  const double one = 1, zero = 0;
  const double seconds = film::shortest(runs, [&] {
    dgemm_("N", "N", &order, &order, &order, &one, left.data(), &order, right.data(), &order, &zero, product.data(),
           &order);
  });
  limits.flops = 2.0 * order * order * order / seconds;
  return limits;
}

}  // namespace hersey::bench
