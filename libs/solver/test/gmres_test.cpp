#include "hersey/solver/gmres.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace hersey::solver {
namespace gmres_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Convection and diffusion along a line: not symmetric, its eigenvalues complex.
void line_operator(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
  const Eigen::Index n = x.size();
  y.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    y[i] = 2.5 * x[i] - (i > 0 ? 1.7 * x[i - 1] : 0) - (i + 1 < n ? 0.3 * x[i + 1] : 0);
  }
}

void copy(const Eigen::VectorXd& b, Eigen::VectorXd& x) { x = b; }

TEST_CASE("Gmres_LeavesTheResidualItReports") {
  const int n = 200;
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1, 2);
  Gmres gmres;
  Eigen::VectorXd x, Ax;
  for (const int restart : {5, 30}) {
    for (const double rtol : {1e-3, 1e-10}) {
      const GmresSummary summary =
          gmres.solve(line_operator, copy, b, {.rtol = rtol, .max_iterations = 500, .restart = restart}, x);
      CHECK(summary.solved());
      line_operator(x, Ax);
      CHECK((b - Ax).norm() <= rtol * b.norm());
      CHECK(std::abs((b - Ax).norm() - summary.residual_norm) <= n * eps * b.norm());
    }
  }
}

TEST_CASE("Gmres_EndsAfterAsManyStepsAsThereAreUnknowns") {
  const int n = 12;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(n);
  Gmres gmres;
  Eigen::VectorXd x;
  const GmresSummary summary = gmres.solve(line_operator, copy, b, {.rtol = 1e-13, .restart = n}, x);
  CHECK(summary.solved());
  CHECK(summary.iterations <= n);
}

TEST_CASE("Gmres_WithTheInverseAsPreconditioner_NeedsOneStep") {
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(30, 1, 2);
  Gmres gmres;
  Eigen::VectorXd x;
  const auto twice = [](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = 2 * v; };
  const auto half = [](const Eigen::VectorXd& v, Eigen::VectorXd& y) { y = 0.5 * v; };
  const GmresSummary summary = gmres.solve(twice, half, b, {}, x);
  CHECK(summary.solved());
  CHECK(summary.iterations == 1);
  CHECK((2 * x - b).norm() <= 30 * eps * b.norm());
}

TEST_CASE("Gmres_ReportsThatItDoesNotConverge") {
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(200);
  Gmres gmres;
  Eigen::VectorXd x;
  CHECK_FALSE(gmres.solve(line_operator, copy, b, {.max_iterations = 3}, x).solved());
  // A singular operator whose range does not hold b.
  const auto first_only = [](const Eigen::VectorXd& v, Eigen::VectorXd& y) {
    y = v.size() * Eigen::VectorXd::Unit(v.size(), 0) * v[0];
  };
  CHECK_FALSE(gmres.solve(first_only, copy, b, {}, x).solved());
  CHECK(x.allFinite());
}

TEST_CASE("Gmres_OfNothing_IsNothing") {
  Gmres gmres;
  Eigen::VectorXd x;
  const GmresSummary summary = gmres.solve(line_operator, copy, Eigen::VectorXd::Zero(8), {}, x);
  CHECK(summary.solved());
  CHECK(summary.iterations == 0);
  CHECK(x.isZero(0));
}

}  // namespace gmres_test
}  // namespace hersey::solver
