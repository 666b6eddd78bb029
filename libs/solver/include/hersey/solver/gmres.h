#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "hersey/core/outcome.h"

namespace hersey::solver {

struct GmresOptions {
  double atol = 0;          ///< on the Euclidean norm of the residual, >= 0
  double rtol = 1e-10;      ///< on the same over that of the right-hand side, >= 0
  int max_iterations = 60;  ///< applications of the operator
  int restart = 20;         ///< vectors kept, > 0
};

struct [[nodiscard]] GmresSummary : Outcome {
  int iterations = 0;        ///< applications of the operator
  double residual_norm = 0;  ///< Euclidean, as the recurrence has it
};

/// Flexible GMRES with restarts, preconditioned from the right: A x = b with x = sum of M(v). The residual it reports
/// is that of A x = b itself; M may change from one application to the next. Vectors are kept from one solve to the
/// next: no allocation once as many iterations were needed before.
/// @see Saad (1993), A flexible inner-outer preconditioned GMRES algorithm, SIAM J. Sci. Comput. 14, 461-469.
class Gmres {
 public:
  using Operator = std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>;

  /// Solves A x = b from x = 0. If not solved, x is the best approximation found.
  [[nodiscard]] GmresSummary solve(const Operator& A, const Operator& M, const Eigen::VectorXd& b,
                                   const GmresOptions& options, Eigen::VectorXd& x);

 private:
  void make_room(int restart, Eigen::Index n);
  [[nodiscard]] double orthogonalise(int k);
  [[nodiscard]] double rotate(int k, double norm);
  void add_combination(int k, Eigen::VectorXd& x);

  std::vector<Eigen::VectorXd> basis_, preconditioned_;
  Eigen::MatrixXd hessenberg_;
  Eigen::VectorXd cosine_, sine_, g_, y_, residual_;
};

}  // namespace hersey::solver
