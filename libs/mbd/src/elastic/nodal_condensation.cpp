// Condensation of the nodes: their contribution to the derivatives of a nodal body's forces, theory manual eq.
// (flexible-bodies.18) and (flexible-bodies.19).
#include "elastic/modal_workspace.h"
#include "elastic/nodal_factors.h"
#include "elastic/nodal_fields.h"
#include "hersey/mbd/nodal_body.h"

namespace hersey::mbd {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Adds the contribution of the nodes' response to the derivatives. The response is approximated by the columns of X:
/// onto (X^T S X)^-1 from, theory manual eq. (flexible-bodies.18) and (flexible-bodies.19).
void NodalBody::condense(const ElasticMotion& motion) {
  Workspace& w = work();
  const solver::Stage stage = stage_of(motion);
  const NodalFactor& factor = *factors_->of(stage, failure_);
  const ElasticFrame& base = motion.frames[0];
  const Matrix3 spin = 2 * skew(Vector3(base.V.head<3>()));
  MatrixXd S = factor.W;
  for (Index p = 0; p < 3; ++p)
    for (Index r = 0; r < 3; ++r)
      S += (stage.c * spin(p, r) + stage.k * w.Omega(p, r)) * factor.answers[static_cast<std::size_t>(3 * p + r)];
  const MatrixXd all = fields_->side_by_side();
  Moments by_y, by_rate, by_acc;
  for (std::size_t r = 0; r < 3; ++r) {
    const MatrixXd sums = factor.m_X[r].transpose() * all;
    by_y[r] = sums.leftCols<3>();
    by_rate[r] = sums.middleCols<3>(3);
    by_acc[r] = sums.rightCols<3>();
  }
  MatrixXd onto = forces_of_answers(factor, stage, base, by_y, by_rate, by_acc);
  if (!loads_.empty()) onto.topRows<3>() += stage.k * torque_of_loads(loads_on_nodes(motion), factor.X);
  // Columns of forces and of masses differ by many decades, and some shapes move nothing.
  const VectorXd size = factor.W.diagonal().cwiseMax(0).cwiseSqrt();
  const VectorXd scale = (size.array() > 0).select(size.cwiseInverse(), 0.0);
  const MatrixXd scaled = scale.asDiagonal() * S.transpose() * scale.asDiagonal();
  const MatrixXd answer =
      (scale.asDiagonal() * scaled.fullPivLu().solve(scale.asDiagonal() * onto.transpose())).transpose();
  add_forces_on_nodes(factor, base, by_y, by_rate, answer);
  if (!loads_.empty()) w.K.leftCols<3>().noalias() -= answer * (factor.X.transpose() * rotated_loads(motion));
}

/// Torque about frame 0 that the motion needs against `loads` on the nodes, for displacements of these, (3, columns).
MatrixXd NodalBody::torque_of_loads(const Eigen::Matrix3Xd& loads, const MatrixXd& displacements) {
  MatrixXd torque(3, displacements.cols());
  for (Index z = 0; z < displacements.cols(); ++z) {
    const Eigen::Map<const Eigen::Matrix3Xd> moved(displacements.col(z).data(), 3, loads.cols());
    torque.col(z) = -cross_moment(moved * loads.transpose());
  }
  return torque;
}

/// Returns the derivative of the load forces on the nodes by the rotation of frame 0, (3 nodes, 3); only loads in
/// ground's axes contribute.
MatrixXd NodalBody::rotated_loads(const ElasticMotion& motion) const {
  const Eigen::Matrix3Xd loads = loads_on_nodes(motion, LoadAxes::ground);
  MatrixXd rotated(3 * loads.cols(), 3);
  for (Index k = 0; k < 3; ++k) {
    const Eigen::Matrix3Xd column = skew(Vector3::Unit(k)) * loads;
    rotated.col(k) = Eigen::Map<const VectorXd>(column.data(), column.size());
  }
  return rotated;
}

/// Returns X^T times the derivatives of the forces on the nodes by (accelerations, velocities, positions) of [frame 0;
/// amplitudes], theory manual eq. (flexible-bodies.18); `answer` carries them on to the derivatives of the forces.
void NodalBody::add_forces_on_nodes(const NodalFactor& factor, const ElasticFrame& base, const Moments& by_y,
                                    const Moments& by_rate, const MatrixXd& answer) {
  Workspace& w = work();
  const Index n = data().shapes();
  const Matrix3 omega_x = skew(Vector3(base.V.head<3>()));
  MatrixXd from = MatrixXd::Zero(factor.W.rows(), 6 + n);
  const auto rotated = [&](const Matrix3& rotation, const Moments& by) {
    VectorXd sum = VectorXd::Zero(from.rows());
    for (Index r = 0; r < 3; ++r) sum += by[static_cast<std::size_t>(r)] * rotation.row(r).transpose();
    return sum;
  };
  const auto of_shapes = [&](const Matrix3& rotation) {
    MatrixXd sum = MatrixXd::Zero(from.rows(), n);
    for (Index r = 0; r < 3; ++r)
      for (Index p = 0; p < 3; ++p) sum += rotation(r, p) * factor.shapes[static_cast<std::size_t>(3 * r + p)];
    return sum;
  };
  const auto even = factor.W.leftCols<3>();
  for (Index j = 0; j < 3; ++j) from.col(j) = rotated(skew(Vector3(Vector3::Unit(j))), by_y);
  from.middleCols<3>(3) = even;
  from.rightCols(n) = factor.W.middleCols(kInertiaColumns, n);
  w.M.noalias() -= answer * from;

  for (Index j = 0; j < 3; ++j) {
    const Matrix3 unit = skew(Vector3(Vector3::Unit(j)));
    from.col(j) = rotated(unit * omega_x + omega_x * unit, by_y) + rotated(2 * unit, by_rate);
  }
  from.leftCols<3>() -= even * skew(Vector3(base.V.tail<3>()));
  from.middleCols<3>(3) = even * omega_x;
  from.rightCols(n) = of_shapes(2 * omega_x) + damping_.mass * factor.W.middleCols(kInertiaColumns, n);
  if (strain_ == Strain::finite) from.rightCols(n) += damping_.stiffness * factor.W.rightCols(n);
  w.C.noalias() -= answer * from;
  w.K.rightCols(n).noalias() -= answer * of_shapes(w.Omega);
  if (strain_ == Strain::finite) w.K.rightCols(n).noalias() -= answer * factor.W.rightCols(n);
}

/// d forces on [frame 0; amplitudes] / d answer of the nodes as a sum of columns of X, theory manual eq.
/// (flexible-bodies.19).
MatrixXd NodalBody::forces_of_answers(const NodalFactor& factor, const solver::Stage& stage, const ElasticFrame& base,
                                      const Moments& by_y, const Moments& by_rate, const Moments& by_acc) {
  const Workspace& w = work();
  const Matrix3 omega_x = skew(Vector3(base.V.head<3>()));
  const Index n = data().shapes();
  const double k = stage.k, c = stage.c, m = stage.m;
  const Matrix3 D = 2 * c * omega_x + k * w.Omega;
  const auto even = factor.W.topRows<3>();
  MatrixXd onto(6 + n, factor.W.cols());
  onto.topRows<3>() = -k * skew(w.a_true) * even;
  onto.middleRows<3>(3) = (m * Matrix3::Identity() + D) * even;
  const auto product = [](const Moments& by, Index z) {  // integral of rho (field) w^T
    Matrix3 B;
    for (Index r = 0; r < 3; ++r) B.col(r) = by[static_cast<std::size_t>(r)].row(z).transpose();
    return B;
  };
  for (Index z = 0; z < onto.cols(); ++z) {
    const Matrix3 B = product(by_y, z), B_rate = product(by_rate, z), B_acc = product(by_acc, z);
    onto.col(z).head<3>() +=
        cross_moment(k * (B + B.transpose()) * w.Omega.transpose() +
                     2 * (c * B + k * B_rate.transpose()) * omega_x.transpose() + m * B + k * B_acc.transpose());
  }
  onto.bottomRows(n) = (m + c * damping_.mass) * factor.W.middleRows(kInertiaColumns, n);
  if (strain_ == Strain::finite) onto.bottomRows(n) += (k + c * damping_.stiffness) * factor.W.bottomRows(n);
  for (Index p = 0; p < 3; ++p)
    for (Index r = 0; r < 3; ++r)
      onto.bottomRows(n) += D(p, r) * factor.shapes[static_cast<std::size_t>(3 * r + p)].transpose();
  return onto;
}

}  // namespace hersey::mbd
