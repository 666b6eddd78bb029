#include "constraint_space.h"

namespace hersey::solver {

Eigen::MatrixXd free_directions(Equations& equations, const State& state) {
  using Eigen::Index;
  constexpr double rank_threshold = 1e-10;
  const Index nv = equations.nv();
  if (equations.nlambda() == 0) return Eigen::MatrixXd::Identity(nv, nv);
  Eigen::VectorXd phi, scale;
  Equations::SparseMatrix G;
  equations.constraints(state, phi, scale, &G);
  const Eigen::VectorXd reach = equations.position_scales();
  Eigen::MatrixXd rows = scale.cwiseInverse().asDiagonal() * Eigen::MatrixXd(G) * reach.asDiagonal();
  for (Index i = 0; i < rows.rows(); ++i)
    if (const double norm = rows.row(i).norm(); norm > 0) rows.row(i) /= norm;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
  qr.setThreshold(rank_threshold);
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(nv, nv);
  return reach.asDiagonal() * Q.rightCols(nv - qr.rank());
}

}  // namespace hersey::solver
