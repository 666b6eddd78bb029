#include "hersey/mbd/modal_body.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <utility>

#include "elastic/modal_workspace.h"
#include "hersey/core/contract.h"
#include "tree/momentum_share.h"

namespace hersey::mbd {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The share of the force of a deformation as large as the body, counted as a magnitude too: loops that the body closes
// give its deformation as a difference of poses, with their round-off of 1e-15.
constexpr double kModalStiffnessShare = 1e-6;

}  // namespace

void set_moments(ModalBodyData& data, const Eigen::SparseMatrix<double>& nodal_mass, const Eigen::Matrix3Xd& x,
                 const MatrixXd& shapes) {
  const Index nodes = x.cols(), n = 1 + shapes.cols();
  HERSEY_REQUIRE(nodal_mass.rows() == nodes && shapes.rows() == 3 * nodes, "mass, nodes and shapes belong together");
  std::array<MatrixXd, 3> Y, MY;  // per component: points and shapes, shape (nodes, 1 + shapes)
  for (int p = 0; p < 3; ++p) {
    MatrixXd& component = Y[static_cast<std::size_t>(p)];
    component.resize(nodes, n);
    component.col(0) = x.row(p).transpose();
    for (Index a = 0; a < shapes.cols(); ++a)
      component.col(1 + a) = Eigen::Map<const VectorXd, 0, Eigen::InnerStride<3>>(shapes.col(a).data() + p, nodes);
    MY[static_cast<std::size_t>(p)] = nodal_mass * component;
  }
  data.mass = nodal_mass.sum();
  data.nodes = x;
  data.displacements = shapes;
  data.first_moment.resize(3, n);
  for (std::size_t p = 0; p < 3; ++p) {
    data.first_moment.row(static_cast<Index>(p)) = MY[p].colwise().sum();
    for (std::size_t r = 0; r < 3; ++r) data.second_moment[3 * p + r] = Y[p].transpose() * MY[r];
  }
}

ModalBodyData modal_data(const fem::ReducedBody& reduced, const RayleighDamping& damping, MatrixXd* shapes) {
  const Index n = reduced.size() - 6;
  const Index internal_first = reduced.internal_first() - 6;
  MatrixXd Phi = reduced.Phi.rightCols(n);
  VectorXd scale = VectorXd::Ones(n);
  for (Index a = internal_first; a < n; ++a) {
    const Eigen::Map<const Eigen::Matrix3Xd> moved(Phi.col(a).data(), 3, Phi.rows() / 3);
    scale[a] = 1 / moved.colwise().norm().maxCoeff();
  }
  Phi = Phi * scale.asDiagonal();
  const auto scaled = [&](const MatrixXd& A) {
    return MatrixXd(scale.asDiagonal() * A.bottomRightCorner(n, n) * scale.asDiagonal());
  };
  Eigen::Matrix3Xd x(3, static_cast<Index>(reduced.nodes.size()));
  for (Index i = 0; i < x.cols(); ++i) x.col(i) = reduced.nodes[static_cast<std::size_t>(i)];
  ModalBodyData data;
  set_moments(data, reduced.m, x, Phi);
  data.stiffness = scaled(reduced.K);
  data.damping = damping.mass * scaled(reduced.M) + damping.stiffness * data.stiffness;
  for (const fem::InterfaceFrame& frame : reduced.frames) data.rest.push_back({Matrix3::Identity(), frame.origin});
  data.rest[0] = Pose{};
  if (shapes != nullptr) *shapes = std::move(Phi);
  return data;
}

ModalBody::ModalBody(ModalBodyData data) : data_(std::move(data)), work_(std::make_unique<Workspace>()) {
  const Index n = data_.shapes();
  HERSEY_REQUIRE(data_.shapes_per_frame == 6 || data_.shapes_per_frame == 12, "one of the two measures of rotation");
  HERSEY_REQUIRE(!data_.rest.empty() && coordinate_count() >= 0, "as many shapes per frame as there are for it");
  HERSEY_REQUIRE(data_.stiffness.cols() == n && data_.damping.rows() == n && data_.damping.cols() == n, "square");
  HERSEY_REQUIRE(data_.first_moment.cols() == n + 1, "first moments of positions and of every shape");
  for (const MatrixXd& G : data_.second_moment)
    HERSEY_REQUIRE(G.rows() == n + 1 && G.cols() == n + 1, "second moments of positions and of every shape");
  modal_mass_ = (data_.second_moment[0] + data_.second_moment[4] + data_.second_moment[8]).bottomRightCorner(n, n);
  round_off_ = kModalStiffnessShare * stiffness_at_size();
  Workspace& w = *work_;
  w.q = w.rate = w.acceleration = VectorXd::Zero(n + 1);
  w.interfaces.assign(data_.rest.size() - 1,
                      RelativeDeformation(data_.shapes_per_frame == 6 ? TurnMeasure::sine : TurnMeasure::matrix));
  w.H.resize(static_cast<std::size_t>(n) + 1);
  w.H_rate = w.H_acc = w.H;
  w.load = VectorXd::Zero(6 + n);
  w.K = w.C = w.M = MatrixXd::Zero(6 + n, 6 + n);
  const Index outer = 6 * frame_count(), inner = 6 + n - coordinate_count();
  w.Z = w.Z_rate_X = w.Z_acc_X = w.Z_acc_V = MatrixXd::Zero(inner, outer);
  w.Z.topLeftCorner<6, 6>().setIdentity();
}

ModalBody::~ModalBody() = default;

/// Returns the sum of the magnitudes of forces caused by a rotation of 1 rad or a shift by twice the radius of gyration
/// of every frame.
VectorXd ModalBody::stiffness_at_size() const {
  const Index per_frame = data_.shapes_per_frame, interfaces = per_frame * (frame_count() - 1);
  double square = 0;
  for (std::size_t p = 0; p < 3; ++p) square += data_.second_moment[4 * p](0, 0);
  const double size =
      2 * std::sqrt(std::max(square / data_.mass - (data_.first_moment.col(0) / data_.mass).squaredNorm(), 0.0));
  VectorXd reach = VectorXd::Zero(data_.shapes());
  for (Index i = 0; i < interfaces; ++i) reach[i] = i % per_frame < per_frame - 3 ? 1 : size;
  return data_.stiffness.cwiseAbs() * reach;
}

void ModalBody::gather_amplitudes(const ElasticMotion& motion, bool want_tangent) {
  Workspace& w = *work_;
  const Index own = coordinate_count();
  w.q[0] = 1;
  for (std::size_t i = 0; i < w.interfaces.size(); ++i) {
    RelativeDeformation& interface = w.interfaces[i];
    interface.update(motion.frames[0], motion.frames[i + 1], data_.rest[i + 1], want_tangent);
    const Index n = interface.q.size(), at = 1 + n * static_cast<Index>(i);
    w.q.segment(at, n) = interface.q;
    w.rate.segment(at, n) = interface.rate;
    w.acceleration.segment(at, n) = interface.acceleration;
  }
  w.q.tail(own) = motion.eta;
  w.rate.tail(own) = motion.eta_rate;
  w.acceleration.tail(own) = motion.eta_acceleration;
}

/// Amplitudes and sums over shapes at a motion.
void ModalBody::gather(const ElasticMotion& motion, bool want_tangent) {
  gather_amplitudes(motion, want_tangent);
  Workspace& w = *work_;
  w.S = data_.first_moment * w.q;
  w.S_rate = data_.first_moment * w.rate;
  w.S_acc = data_.first_moment * w.acceleration;
  for (std::size_t i = 0; i < 9; ++i) {
    w.h[i].noalias() = data_.second_moment[i] * w.q;
    w.h_rate[i].noalias() = data_.second_moment[i] * w.rate;
    w.h_acc[i].noalias() = data_.second_moment[i] * w.acceleration;
    const auto row = static_cast<Index>(i / 3), column = static_cast<Index>(i % 3);
    for (std::size_t a = 0; a < w.H.size(); ++a) {
      const auto at = static_cast<Index>(a);
      w.H[a](row, column) = w.h[i][at];
      w.H_rate[a](row, column) = w.h_rate[i][at];
      w.H_acc[a](row, column) = w.h_acc[i][at];
    }
    w.Gamma(row, column) = w.q.dot(w.h[i]);
    w.Gamma_rate(row, column) = w.q.dot(w.h_rate[i]);
    w.Gamma_acc(row, column) = w.q.dot(w.h_acc[i]);
  }
}

/// Theory manual eq. (flexible-bodies.4) to (flexible-bodies.6).
void ModalBody::add_inertia(const ElasticFrame& base) {
  Workspace& w = *work_;
  const Vector3 omega = base.V.head<3>(), alpha = base.A.head<3>();
  const Matrix3 omega_x = skew(omega);
  w.a_true = base.A.tail<3>() + omega.cross(base.V.tail<3>());
  w.Omega = skew(alpha) + omega_x * omega_x;
  const auto amplitudes = data_.shapes();
  w.force.setZero(6 + amplitudes);
  w.magnitude.setZero(6 + amplitudes);
  const Matrix3 centrifugal = w.Gamma * w.Omega.transpose(), coriolis = 2 * w.Gamma_rate * omega_x.transpose();
  const Vector3 moment = cross_moment(centrifugal + coriolis + w.Gamma_acc);
  w.force.head<3>() = w.S.cross(w.a_true) + moment;
  w.force.segment<3>(3) = data_.mass * w.a_true + w.Omega * w.S + 2 * omega.cross(w.S_rate) + w.S_acc;
  w.magnitude.head<3>() = Vector3::Constant(w.S.norm() * w.a_true.norm()) + cross_moment(centrifugal).cwiseAbs() +
                          cross_moment(coriolis).cwiseAbs() + cross_moment(w.Gamma_acc).cwiseAbs();
  w.magnitude.segment<3>(3) = data_.mass * w.a_true.cwiseAbs() + (w.Omega * w.S).cwiseAbs() + w.S_acc.cwiseAbs();
  auto force = w.force.tail(amplitudes);
  force.noalias() = data_.first_moment.rightCols(amplitudes).transpose() * w.a_true;
  w.magnitude.tail(amplitudes) = force.cwiseAbs();
  for (std::size_t i = 0; i < 9; ++i) {
    const auto row = static_cast<Index>(i / 3), column = static_cast<Index>(i % 3);
    force += w.Omega(row, column) * w.h[i].tail(amplitudes) + 2 * omega_x(row, column) * w.h_rate[i].tail(amplitudes);
    if (row == column) force += w.h_acc[i].tail(amplitudes);
  }
  w.magnitude.tail(amplitudes) += force.cwiseAbs();
}

/// Derivatives of the same: mass matrix, gyroscopic terms, and the change of both with the shape.
void ModalBody::differentiate_inertia(const ElasticFrame& base) {
  Workspace& w = *work_;
  const Vector3 omega = base.V.head<3>(), s = base.V.tail<3>();
  const Matrix3 omega_x = skew(omega), S_x = skew(w.S);
  const double m = data_.mass;
  const Index n = data_.shapes();
  w.K.setZero();
  w.C.setZero();
  w.M.setZero();
  w.M.block<3, 3>(0, 0) = w.Gamma.trace() * Matrix3::Identity() - w.Gamma;
  w.M.block<3, 3>(0, 3) = S_x;
  w.M.block<3, 3>(3, 0) = -S_x;
  w.M.block<3, 3>(3, 3) = m * Matrix3::Identity();
  w.M.bottomRightCorner(n, n) = modal_mass_;
  w.C.block<3, 3>(0, 3) = S_x * omega_x;
  w.C.block<3, 3>(3, 3) = m * omega_x;
  for (int k = 0; k < 3; ++k) {
    const Vector3 unit = Vector3::Unit(k), da = unit.cross(s);
    const Matrix3 unit_x = skew(unit), dOmega = unit_x * omega_x + omega_x * unit_x;
    w.C.block<3, 1>(0, k) =
        w.S.cross(da) + cross_moment(w.Gamma * dOmega.transpose() + 2 * w.Gamma_rate * unit_x.transpose());
    w.C.block<3, 1>(3, k) = m * da + dOmega * w.S + 2 * unit.cross(w.S_rate);
    auto column = w.C.col(k).tail(n);
    column.noalias() = data_.first_moment.rightCols(n).transpose() * da;
    for (std::size_t i = 0; i < 9; ++i)
      column += dOmega(static_cast<Index>(i / 3), static_cast<Index>(i % 3)) * w.h[i].tail(n) +
                2 * unit_x(static_cast<Index>(i / 3), static_cast<Index>(i % 3)) * w.h_rate[i].tail(n);
  }
  w.C.bottomRows(n).middleCols<3>(3).noalias() = data_.first_moment.rightCols(n).transpose() * omega_x;
  for (Index a = 1; a <= n; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const Vector3 S_a = data_.first_moment.col(a);
    const Matrix3 &H = w.H[i], Ht = H.transpose();
    const Vector3 lever = cross_moment(Ht);
    w.M.block<3, 1>(0, 5 + a) = lever;
    w.M.block<1, 3>(5 + a, 0) = lever.transpose();
    w.M.block<3, 1>(3, 5 + a) = S_a;
    w.M.block<1, 3>(5 + a, 3) = S_a.transpose();
    w.C.block<3, 1>(0, 5 + a) = 2 * cross_moment(Ht * omega_x.transpose());
    w.C.block<3, 1>(3, 5 + a) = 2 * omega.cross(S_a);
    w.K.block<3, 1>(0, 5 + a) = S_a.cross(w.a_true) + cross_moment((H + Ht) * w.Omega.transpose() +
                                                                   2 * w.H_rate[i] * omega_x.transpose() + w.H_acc[i]);
    w.K.block<3, 1>(3, 5 + a) = w.Omega * S_a;
  }
  for (std::size_t i = 0; i < 9; ++i) {
    const auto row = static_cast<Index>(i / 3), column = static_cast<Index>(i % 3);
    const auto G = data_.second_moment[i].bottomRightCorner(n, n);
    w.K.bottomRightCorner(n, n) += w.Omega(row, column) * G;
    if (row != column) w.C.bottomRightCorner(n, n) += 2 * omega_x(row, column) * G;
  }
}

void ModalBody::add_elasticity(bool want_tangent) {
  Workspace& w = *work_;
  const Index n = data_.shapes();
  w.elastic.noalias() = data_.stiffness * w.q.tail(n);
  w.viscous.noalias() = data_.damping * w.rate.tail(n);
  w.force.tail(n) += w.elastic + w.viscous;
  w.magnitude.tail(n) += w.elastic.cwiseAbs() + w.viscous.cwiseAbs() + round_off_;
  if (!want_tangent) return;
  w.K.bottomRightCorner(n, n) += data_.stiffness;
  w.C.bottomRightCorner(n, n) += data_.damping;
}

/// d[frame 0; amplitudes that follow from frames] / d[all frames]: Z of theory manual eq. (flexible-bodies.11).
void ModalBody::fill_transformations(bool want_tangent) {
  Workspace& w = *work_;
  for (std::size_t i = 0; i < w.interfaces.size(); ++i) {
    const RelativeDeformation& interface = w.interfaces[i];
    const auto put = [&](MatrixXd& to, const RelativeDeformation::ByTwists& block) {
      const auto row = 6 + block.rows() * static_cast<Index>(i), column = 6 + 6 * static_cast<Index>(i);
      to.block(row, 0, block.rows(), 6) = block.leftCols<6>();
      to.block(row, column, block.rows(), 6) = block.rightCols<6>();
    };
    put(w.Z, interface.B);
    if (!want_tangent) continue;
    put(w.Z_rate_X, interface.rate_dX);
    put(w.Z_acc_X, interface.accel_dX);
    put(w.Z_acc_V, interface.accel_dV);
  }
}

void ModalBody::find_shapes(const ElasticMotion& motion, bool want_tangent, ShapeMotion& shapes) {
  gather_amplitudes(motion, want_tangent);
  const Workspace& w = *work_;
  const Index n = data_.shapes();
  shapes.value = w.q.tail(n);
  shapes.rate = w.rate.tail(n);
  if (!want_tangent) return;
  fill_transformations(true);
  shapes.by_frames = w.Z.bottomRows(w.Z.rows() - 6);
  shapes.rate_by_frames = w.Z_rate_X.bottomRows(w.Z.rows() - 6);
}

/// From [frame 0; amplitudes] to [all frames; own coordinates], theory manual eq. (flexible-bodies.11). The last of the
/// amplitudes are the own coordinates, so that only the leading blocks change.
void ModalBody::reduce_to_frames(bool want_tangent, ElasticResponse& response) {
  Workspace& w = *work_;
  fill_transformations(want_tangent);
  const Index inner = w.Z.rows(), outer = w.Z.cols(), own = coordinate_count();
  response.force.resize(outer + own);
  response.force.head(outer).noalias() = w.Z.transpose() * w.force.head(inner);
  response.force.tail(own) = w.force.tail(own);
  response.magnitude.resize(outer + own);
  response.magnitude.head(outer).noalias() = w.Z.cwiseAbs().transpose() * w.magnitude.head(inner);
  response.magnitude.tail(own) = w.magnitude.tail(own);
  if (!want_tangent) return;
  // With `product` what the frames change: A' = [Z^T product_top, Z^T A_top,own; product_bottom, A_own,own].
  const auto reduce = [&](const MatrixXd& A, MatrixXd& reduced) {
    reduced.resize(outer + own, outer + own);
    reduced.topLeftCorner(outer, outer).noalias() = w.Z.transpose() * w.product.topRows(inner);
    reduced.bottomLeftCorner(own, outer) = w.product.bottomRows(own);
    reduced.topRightCorner(outer, own).noalias() = w.Z.transpose() * A.topRightCorner(inner, own);
    reduced.bottomRightCorner(own, own) = A.bottomRightCorner(own, own);
  };
  w.product.noalias() = w.K.leftCols(inner) * w.Z;
  w.product.noalias() += w.C.leftCols(inner) * w.Z_rate_X;
  w.product.noalias() += w.M.leftCols(inner) * w.Z_acc_X;
  reduce(w.K, response.K);
  w.product.noalias() = w.C.leftCols(inner) * w.Z;
  w.product.noalias() += w.M.leftCols(inner) * w.Z_acc_V;
  reduce(w.C, response.C);
  w.product.noalias() = w.M.leftCols(inner) * w.Z;
  reduce(w.M, response.M);
  for (std::size_t i = 0; i < w.interfaces.size(); ++i) {
    const Index at = 6 + 6 * static_cast<Index>(i), n = w.interfaces[i].q.size();
    const Matrix12 G = w.interfaces[i].geometric(w.force.segment(6 + n * static_cast<Index>(i), n));
    response.K.block<6, 6>(0, 0) += G.topLeftCorner<6, 6>();
    response.K.block<6, 6>(0, at) += G.topRightCorner<6, 6>();
    response.K.block<6, 6>(at, 0) += G.bottomLeftCorner<6, 6>();
    response.K.block<6, 6>(at, at) += G.bottomRightCorner<6, 6>();
  }
}

/// Adds the force that corresponds to the round-off of velocities within a step to the magnitudes; see inertia.cpp.
void ModalBody::add_momentum_share(const ElasticFrame& base, double dt) {
  if (dt == 0) return;
  Workspace& w = *work_;
  const Vector3 omega = base.V.head<3>(), s = base.V.tail<3>();
  const double share = kMomentumShare / dt;
  w.magnitude.head<3>() += share * (w.S.cross(s) + w.Gamma.trace() * omega - w.Gamma * omega).cwiseAbs();
  w.magnitude.segment<3>(3) += share * (data_.mass * s + omega.cross(w.S)).cwiseAbs();
  w.viscous.noalias() = modal_mass_ * w.rate.tail(data_.shapes());
  w.magnitude.tail(data_.shapes()) += share * w.viscous.cwiseAbs();
}

void ModalBody::evaluate(const ElasticMotion& motion, bool want_tangent, ElasticResponse& response) {
  gather(motion, want_tangent);
  add_inertia(motion.frames[0]);
  add_momentum_share(motion.frames[0], motion.stage.dt);
  if (want_tangent) differentiate_inertia(motion.frames[0]);
  add_elasticity(want_tangent);
  add_nodes(motion, want_tangent);
  add_loads(motion, want_tangent);
  if (motion.shape_forces.size() > 0) {
    work_->force.tail(data_.shapes()) -= motion.shape_forces;
    work_->magnitude.tail(data_.shapes()) += motion.shape_force_sizes;
  }
  reduce_to_frames(want_tangent, response);
}

VectorXd ModalBody::displacements(const ElasticMotion& motion, const MatrixXd& shapes) {
  return shapes * amplitudes(motion);
}

VectorXd ModalBody::amplitudes(const ElasticMotion& motion) {
  gather(motion, false);
  return work_->q.tail(data_.shapes());
}

ElasticEnergy ModalBody::energy(const ElasticMotion& motion, const Vector3& gravity) {
  gather(motion, false);
  Workspace& w = *work_;
  ElasticEnergy e;
  const ElasticFrame& base = motion.frames[0];
  const Pose& X = base.X_WF;
  const Vector3 omega = base.V.head<3>(), s = base.V.tail<3>();
  const Index n = data_.shapes();
  const auto q = w.q.tail(n), rate = w.rate.tail(n);
  const Matrix3 inertia = w.Gamma.trace() * Matrix3::Identity() - w.Gamma;
  const Vector3 spin = inertia * omega + cross_moment(w.Gamma_rate);  // about frame 0's origin, it being at rest
  const Vector3 p = data_.mass * s + omega.cross(w.S) + w.S_rate, H = spin + w.S.cross(s);
  e.kinetic = 0.5 * (p.dot(s) + H.dot(omega) + w.S_rate.dot(s) + omega.dot(cross_moment(w.Gamma_rate)) +
                     rate.dot(modal_mass_ * rate));
  e.strain = 0.5 * q.dot(data_.stiffness * q);
  e.strain_rate = rate.dot(data_.stiffness * q);
  e.dissipation = rate.dot(data_.damping * rate);
  const Vector3 g = X.R.transpose() * gravity;
  e.potential = -gravity.dot(data_.mass * X.r + X.R * w.S);
  e.gravity = g.dot(p);
  e.momentum = X.R * p;
  e.angular_momentum = X.R * H + X.r.cross(e.momentum);
  add_load_energies(motion, e);
  // The power of all inertia forces, gravity among them, is the rate of the kinetic energy less that of gravity.
  add_inertia(base);
  e.kinetic_rate = w.force.head<6>().dot(base.V) + w.force.tail(n).dot(rate) + e.gravity;
  return e;
}

}  // namespace hersey::mbd
