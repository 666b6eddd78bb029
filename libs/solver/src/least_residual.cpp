#include "hersey/solver/least_residual.h"

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace {

// Changes of the residual whose part independent of newer ones falls below this share of their size are noise.
constexpr double kIndependentShare = 1e-4;

}  // namespace

// Q R = D by Gram-Schmidt, in the order of the changes.
Eigen::VectorXd shares_of_changes(const Eigen::VectorXd& residual, const std::vector<Eigen::VectorXd>& changes) {
  const auto most = static_cast<Eigen::Index>(changes.size());
  Eigen::MatrixXd Q(residual.size(), most), R = Eigen::MatrixXd::Zero(most, most);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < most && static_cast<Eigen::Index>(kept.size()) < residual.size(); ++k) {
    const Eigen::VectorXd& change = changes[static_cast<std::size_t>(k)];
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
  const Eigen::VectorXd along = Q.leftCols(count).transpose() * residual;
  const Eigen::VectorXd of_kept = R.topLeftCorner(count, count).triangularView<Eigen::Upper>().solve(along);
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(most);
  for (Eigen::Index i = 0; i < count; ++i) shares[kept[static_cast<std::size_t>(i)]] = of_kept[i];
  return shares;
}

// With D_k = f_k - f_(k+1), f = f_0 - sum_k g_k D_k has the weights 1 - g_0, g_0 - g_1, ... of the trials.
LeastResidual combine_to_least_residual(const std::vector<Eigen::VectorXd>& residuals) {
  HERSEY_REQUIRE(!residuals.empty(), "there is a trial");
  std::vector<Eigen::VectorXd> changes;
  for (std::size_t k = 0; k + 1 < residuals.size(); ++k) changes.emplace_back(residuals[k] - residuals[k + 1]);
  const Eigen::VectorXd shares = shares_of_changes(residuals.front(), changes);
  LeastResidual least{.weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(residuals.size())), .norm = 0};
  least.weights[0] = 1;
  Eigen::VectorXd left = residuals.front();
  for (Eigen::Index k = 0; k < shares.size(); ++k) {
    least.weights[k] -= shares[k];
    least.weights[k + 1] += shares[k];
    left -= shares[k] * changes[static_cast<std::size_t>(k)];
  }
  least.norm = left.norm();
  return least;
}

}  // namespace hersey::solver
