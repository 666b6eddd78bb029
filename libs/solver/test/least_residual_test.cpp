#include "hersey/solver/least_residual.h"

#include <doctest/doctest.h>

namespace hersey::solver {
namespace least_residual_test {

// x = A x + b with multipliers of which two grow.
struct Map {
  Eigen::MatrixXd A = Eigen::Vector4d(1.3, -0.98, 0.6, -1.05).asDiagonal();
  Eigen::VectorXd b = Eigen::Vector4d(1, 2, 3, 4);
  Map() { A(0, 1) = 0.4, A(2, 0) = 0.2; }
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& x) const { return A * x + b; }
  [[nodiscard]] Eigen::VectorXd solution() const {
    return (Eigen::MatrixXd::Identity(4, 4) - A).partialPivLu().solve(b);
  }
};

TEST_CASE("LeastResidual_SolvesALinearProblemInItsDimensionPlusOne") {
  const Map P;
  std::vector<Eigen::VectorXd> images, residuals;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  for (int k = 0; k < 5; ++k) {
    images.insert(images.begin(), P(x));
    residuals.insert(residuals.begin(), P(x) - x);
    const LeastResidual least = combine_to_least_residual(residuals);
    CHECK(least.weights.sum() == doctest::Approx(1).epsilon(1e-12));  // round-off
    x.setZero();
    Eigen::VectorXd combined = Eigen::VectorXd::Zero(4);
    for (std::size_t i = 0; i < images.size(); ++i) {
      x += least.weights[static_cast<Eigen::Index>(i)] * images[i];
      combined += least.weights[static_cast<Eigen::Index>(i)] * residuals[i];
    }
    CHECK(combined.norm() == doctest::Approx(least.norm));
  }
  CHECK((x - P.solution()).norm() < 1e-9 * P.solution().norm());  // round-off times the condition
}

TEST_CASE("LeastResidual_LeavesOutTrialsThatSayNothingNew") {
  const Eigen::VectorXd f = Eigen::Vector3d(1, 2, 3), g = Eigen::Vector3d(0, 1, 1);
  const LeastResidual least = combine_to_least_residual({f, g, g, g});
  CHECK(least.weights.tail(2).cwiseAbs().maxCoeff() == 0);
  CHECK(combine_to_least_residual({f}).weights == Eigen::VectorXd::Ones(1));
}

}  // namespace least_residual_test
}  // namespace hersey::solver
