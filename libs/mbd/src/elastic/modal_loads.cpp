// Forces on the nodes of a modal body, theory manual eq. (flexible-bodies.23) and (flexible-bodies.24).
#include <cmath>

#include "elastic/modal_workspace.h"
#include "hersey/core/contract.h"
#include "hersey/mbd/modal_body.h"

namespace hersey::mbd {

using Eigen::Index;

namespace {

/// Returns Q, the body's axes in those of the load: f_body = Q^T f.
Matrix3 axes_of(LoadAxes axes, const Pose& X_WB) { return axes == LoadAxes::ground ? X_WB.R : Matrix3::Identity(); }

}  // namespace

void ModalBody::add_load(const NodalLoad& load) {
  const Index nodes = data_.nodes.cols(), n = data_.shapes();
  HERSEY_REQUIRE(load.forces.cols() == nodes && data_.displacements.rows() == 3 * nodes, "one force per node");
  HERSEY_REQUIRE(data_.displacements.cols() == n, "displacements of every shape");
  ProjectedLoad projected{.axes = load.axes, .force = load.forces.rowwise().sum(), .moments = {}};
  projected.moments.reserve(static_cast<std::size_t>(n) + 1);
  projected.moments.emplace_back(data_.nodes * load.forces.transpose());
  for (Index a = 0; a < n; ++a) {
    const Eigen::Map<const Eigen::Matrix3Xd> shape(data_.displacements.col(a).data(), 3, nodes);
    projected.moments.emplace_back(shape * load.forces.transpose());
  }
  loads_.push_back(std::move(projected));
}

/// The load of value 1 on [frame 0; amplitudes].
void ModalBody::project_load(const ProjectedLoad& load, const Pose& X_WB) {
  Workspace& w = *work_;
  const Matrix3 Q = axes_of(load.axes, X_WB);
  w.load_moment.setZero();
  for (std::size_t a = 0; a < load.moments.size(); ++a) {
    const auto at = static_cast<Index>(a);
    w.load_moment += w.q[at] * load.moments[a];
    if (a > 0) w.load[5 + at] = load.moments[a].cwiseProduct(Q.transpose()).sum();
  }
  w.load.head<3>() = cross_moment(w.load_moment * Q);
  w.load.segment<3>(3) = Q.transpose() * load.force;
}

void ModalBody::add_loads(const ElasticMotion& motion, bool want_tangent) {
  Workspace& w = *work_;
  const Pose& X_WB = motion.frames[0].X_WF;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const ProjectedLoad& load = loads_[i];
    const double value = motion.loads[static_cast<Index>(i)];
    project_load(load, X_WB);
    w.force -= value * w.load;
    w.magnitude += std::abs(value) * w.load.cwiseAbs();
    if (!want_tangent) continue;
    const Matrix3 Q = axes_of(load.axes, X_WB);
    for (std::size_t a = 1; a < load.moments.size(); ++a)
      w.K.col(5 + static_cast<Index>(a)).head<3>() -= value * cross_moment(load.moments[a] * Q);
    if (load.axes == LoadAxes::ground) rotate_load(load, value, Q);
  }
}

/// Adds the derivative of a load in ground axes by the rotation of frame 0.
void ModalBody::rotate_load(const ProjectedLoad& load, double value, const Matrix3& Q) {
  Workspace& w = *work_;
  for (int k = 0; k < 3; ++k) {
    const Matrix3 dQ = Q * skew(Vector3::Unit(k));
    w.K.col(k).head<3>() -= value * cross_moment(w.load_moment * dQ);
    w.K.col(k).segment<3>(3) -= value * (dQ.transpose() * load.force);
    for (std::size_t a = 1; a < load.moments.size(); ++a)
      w.K(5 + static_cast<Index>(a), k) -= value * load.moments[a].cwiseProduct(dQ.transpose()).sum();
  }
}

void ModalBody::add_load_energies(const ElasticMotion& motion, ElasticEnergy& energy) {
  Workspace& w = *work_;
  const ElasticFrame& base = motion.frames[0];
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    project_load(loads_[i], base.X_WF);
    const double value = motion.loads[static_cast<Index>(i)];
    ElasticLoad load;
    load.power = value * (w.load.head<6>().dot(base.V) + w.load.tail(data_.shapes()).dot(w.rate.tail(data_.shapes())));
    load.wrench << base.X_WF.R * (value * w.load.head<3>()), base.X_WF.R * (value * w.load.segment<3>(3));
    energy.loads.push_back(load);
  }
}

}  // namespace hersey::mbd
