#include "hersey/solver/least_residual.h"

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

// Changes of the residual whose part independent of newer ones falls below this share of their size are noise.
constexpr double kIndependentShare = 1e-4;

}  // namespace

// With D_k = f_k - f_(k+1), f = f_0 - sum_k g_k D_k has the weights 1 - g_0, g_0 - g_1, ... of the trials. Q R = D by
// Gram-Schmidt, newest change first.
LeastResidual combine_to_least_residual(const std::vector<Eigen::VectorXd>& residuals) {
  HERSEY_REQUIRE(!residuals.empty(), "there is a trial");
  const Eigen::VectorXd& newest = residuals.front();
  const auto changes = static_cast<Eigen::Index>(residuals.size()) - 1;
  Eigen::MatrixXd Q(newest.size(), changes), R = Eigen::MatrixXd::Zero(changes, changes);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < changes && static_cast<Eigen::Index>(kept.size()) < newest.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Eigen::VectorXd change = residuals[at] - residuals[at + 1];
    const auto count = static_cast<Eigen::Index>(kept.size());
    const Eigen::VectorXd along = Q.leftCols(count).transpose() * change;
    const Eigen::VectorXd independent = change - Q.leftCols(count) * along;
    const double norm = independent.norm();
    if (norm <= kIndependentShare * change.norm()) continue;
    R.col(count).head(count) = along;
    R(count, count) = norm;
    Q.col(count) = independent / norm;
    kept.push_back(k);
  }
  const auto count = static_cast<Eigen::Index>(kept.size());
  const Eigen::VectorXd along = Q.leftCols(count).transpose() * newest;
  const Eigen::VectorXd shares = R.topLeftCorner(count, count).triangularView<Eigen::Upper>().solve(along);
  LeastResidual least{.weights = Eigen::VectorXd::Zero(changes + 1),
                      .norm = (newest - Q.leftCols(count) * along).norm()};
  least.weights[0] = 1;
  for (Eigen::Index i = 0; i < count; ++i) {
    least.weights[kept[static_cast<std::size_t>(i)]] -= shares[i];
    least.weights[kept[static_cast<std::size_t>(i)] + 1] += shares[i];
  }
  return least;
}

}  // namespace hersey::solver
