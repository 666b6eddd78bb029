#include "tree/assembly.h"
#include "tree/momentum_share.h"

namespace hersey::mbd {
namespace {

/// The matrix of D -> D x* h for a momentum h = [n; p].
Matrix6 momentum_cross(const Vector6& h) {
  Matrix6 c;
  c << -skew(h.head<3>()), -skew(h.tail<3>()), -skew(h.tail<3>()), Matrix3::Zero();
  return c;
}

/// Inertia of a link about ground's origin, in ground's axes.
Matrix6 inertia_in_world(const Link& link, const Pose& X_WL) {
  const Matrix3 c = skew(X_WL * link.com);
  Matrix6 I;
  I << X_WL.R * link.inertia * X_WL.R.transpose() - link.mass * c * c, link.mass * c, -link.mass * c,
      link.mass * Matrix3::Identity();
  return I;
}

}  // namespace

InertiaTerms::InertiaTerms(const Tree& tree)
    : I_(tree.links.size()), B_(tree.links.size()), F_(tree.links.size()), magnitude_(tree.links.size()) {}

void InertiaTerms::gather(const Assembly& assembly) {
  const Tree& tree = assembly.tree;
  const TreeMotion& motion = assembly.motion;
  const double dt = assembly.stage.dt;
  const bool wants_inertia = assembly.tangent != nullptr;
  const bool wants_coupling = wants_inertia && !assembly.is_of_inertia_alone();
  const int n = static_cast<int>(tree.links.size());
  const double momentum_share = dt > 0 ? kMomentumShare / dt : 0;
  for (int l = 0; l < n; ++l) {
    const Link& link = tree.links[l];
    if (link.mass == 0 && link.inertia.isZero(0)) {
      I_[l].setZero();
      B_[l].setZero();
      F_[l].setZero();
      magnitude_[l].setZero();
      continue;
    }
    const Vector6& V = motion.V(l);
    I_[l] = inertia_in_world(link, motion.X(l));
    const Vector6 h = I_[l] * V, Vh = cross_force(V, h), weight = I_[l] * motion.A(0);
    const Vector6 IA = I_[l] * motion.A(l);
    F_[l] = IA + Vh;
    // In free fall inertia and weight cancel, so each counts by itself; so does what a step's round-off in velocity
    // means.
    magnitude_[l] = (IA - weight).cwiseAbs() + weight.cwiseAbs() + Vh.cwiseAbs() + momentum_share * h.cwiseAbs();
    // B of (mechanisms.9).
    if (wants_coupling) B_[l] = cross_force_matrix(V) * I_[l] - I_[l] * cross_motion_matrix(V) + momentum_cross(h);
  }
  for (int l = n - 1; l > 0; --l) {
    const int p = tree.links[l].parent;
    F_[p] += F_[l];
    magnitude_[p] += magnitude_[l];
    if (wants_inertia) I_[p] += I_[l];
    if (wants_coupling) B_[p] += B_[l];
  }
}

void InertiaTerms::add(Assembly& assembly) {
  const Tree& tree = assembly.tree;
  gather(assembly);
  for (int k = 0; k < tree.nv; ++k) {
    const Vector6& J = assembly.motion.J(k);
    const int l = tree.columns[k].link;
    assembly.add_residual(k, J.dot(F_[l]), magnitude(J, magnitude_[l]));
  }
  if (assembly.tangent) add_tangent(assembly);
}

void InertiaTerms::add_tangent(Assembly& assembly) const {
  const Tree& tree = assembly.tree;
  const bool is_of_inertia_alone = assembly.is_of_inertia_alone();
  for (int j = 0; j < tree.nv; ++j) {
    const int l = tree.columns[j].link;
    if (is_of_inertia_alone) {
      const Vector6 felt = I_[l] * assembly.directions[j].E;
      for (int k : tree.path[l]) {
        const double value = assembly.motion.J(k).dot(felt);
        assembly.add_tangent(k, j, value);
        if (tree.columns[k].link != l) assembly.add_tangent(j, k, value);
      }
      continue;
    }
    const Vector6& J_j = assembly.motion.J(j);
    const Direction& d_j = assembly.directions[j];
    const Vector6 IJ = I_[l] * J_j, BJ = B_[l].transpose() * J_j;
    // Change of the wrench of subtree l when component j moves it; the wrench of the subtree rotates with it.
    const Vector6 felt = I_[l] * d_j.E + B_[l] * d_j.H + cross_force(d_j.J, F_[l]);
    for (int k : tree.path[l]) {
      const Direction& d_k = assembly.directions[k];
      assembly.add_tangent(j, k, IJ.dot(d_k.E) + BJ.dot(d_k.H));
      if (tree.columns[k].link != l) assembly.add_tangent(k, j, assembly.motion.J(k).dot(felt));
    }
  }
}

}  // namespace hersey::mbd
