#include "tree/assembly.h"

namespace hersey::mbd {
namespace {

// Share of the sum of force magnitudes that counts as a magnitude of their resultant, whose round-off is 1e-15 of it.
constexpr double kSummedShare = 1e-6;

/// Returns the magnitude of a wrench about ground's origin whose forces act around a point.
Vector6 sizes(const Vector6& W, const ForceResponse& response, const Vector3& at) {
  Vector6 size = W.cwiseAbs();
  size.head<3>().array() += kSummedShare * response.summed * (at.norm() + response.arm);
  size.tail<3>().array() += kSummedShare * response.summed;
  return size;
}

/// Change of the relative acceleration (mechanisms.29), in ground's axes at its origin, by an increment of a column
/// between the frames of a pair: theory manual eq. (mechanisms.30).
Vector6 acceleration_change(const Assembly& assembly, const Pair& pair, const SignedColumn& col) {
  const TreeMotion& motion = assembly.motion;
  const Direction& d = assembly.directions[col.column];
  const Vector6 &V_a = motion.V(pair.a.link), &V_b = motion.V(pair.b.link);
  const auto velocity = [&](const Vector6& V) { return Vector6(cross_motion(d.J, V) + d.H); };
  const auto acceleration = [&](const Vector6& V, const Vector6& A) {
    return Vector6(cross_motion(d.J, A) + cross_motion(d.H, V) + d.E);
  };
  if (col.sign > 0) return acceleration(V_b, motion.A(pair.b.link)) - cross_motion(V_a, velocity(V_b));
  const Vector6 V_ab = V_b - V_a, dV_a = velocity(V_a);
  const Vector6 relative = motion.A(pair.b.link) - motion.A(pair.a.link) - cross_motion(V_a, V_ab);
  return -cross_motion(d.J, relative) - acceleration(V_a, motion.A(pair.a.link)) - cross_motion(dV_a, V_ab) +
         cross_motion(V_a, dV_a);
}

}  // namespace

void compute_directions(const Tree& tree, const TreeMotion& motion, const solver::Stage& stage,
                        std::vector<Direction>& directions) {
  if (stage.k == 0 && stage.c == 0) {
    for (std::size_t k = 0; k < directions.size(); ++k) directions[k] = {.E = stage.m * motion.J(static_cast<int>(k))};
    return;
  }
  for (std::size_t l = 1; l < tree.links.size(); ++l) {
    const Link& link = tree.links[l];
    const Vector6 &V_p = motion.V(link.parent), &A_p = motion.A(link.parent), &V_c = motion.V(static_cast<int>(l));
    Matrix3 T = Matrix3::Identity();
    if (link.motion == Motion::ball && stage.dq.size() > 0) T = rotation_exp_tangent(stage.dq.segment<3>(link.first_v));
    for (int c = 0; c < link.columns; ++c) {
      const Vector6& J = motion.J(link.first_v + c);
      Vector6 rotated = J;
      if (link.columns == 3) {
        rotated.setZero();
        for (int i = 0; i < 3; ++i) rotated += T(i, c) * motion.J(link.first_v + i);
      }
      const Vector6 D = cross_motion(V_p, rotated);
      Direction& d = directions[link.first_v + c];
      d.J = stage.k * rotated;
      d.H = stage.k * D + stage.c * J;
      d.E = stage.k * (-cross_motion(rotated, A_p) - cross_motion(D, V_p)) + stage.c * cross_motion(V_c + V_p, J) +
            stage.m * J;
    }
  }
}

void add_pair_force(Assembly& assembly, const Pair& pair, const ForceResponse& response) {
  const TreeMotion& motion = assembly.motion;
  const Pose X_WA = motion.pose(pair.a);
  const Vector6 W = moved_force(X_WA, response.W_B_A), size = sizes(W, response, X_WA.r);
  for (const SignedColumn& row : pair.columns) {
    const Vector6& J = motion.J(row.column);
    assembly.add_residual(row.column, -row.sign * J.dot(W), magnitude(J, size));
  }
  const bool has_inertia = !response.dW_dA.isZero(0);
  if (!assembly.tangent || (assembly.is_of_inertia_alone() && !has_inertia)) return;

  const Matrix6 to_A = motion_transform(X_WA.inverse());
  const Matrix6 K = to_A.transpose() * response.dW_dX * to_A;
  const bool is_damped = !response.dW_dV.isZero(0);  // that of a constraint is not
  Matrix6 D, M;
  if (is_damped) D = to_A.transpose() * response.dW_dV * to_A;
  if (has_inertia) M = to_A.transpose() * response.dW_dA * to_A;
  const double c = assembly.stage.c;
  for (const SignedColumn& col : pair.columns) {
    // A column that moves b alone changes the relative pose by +J and the relative velocity by J x (V_b - V_p);
    // one that moves a alone by the negative of both, and rotates the wrench with a.
    const Vector6& J_k = assembly.directions[col.column].J;
    const Link& link = assembly.tree.links[assembly.tree.columns[col.column].link];
    Vector6 dW = col.sign * (K * J_k);
    if (is_damped)
      dW += col.sign *
            (D * (cross_motion(J_k, motion.V(pair.b.link) - motion.V(link.parent)) + c * motion.J(col.column)));
    if (has_inertia) dW += M * acceleration_change(assembly, pair, col);
    if (col.sign < 0) dW += cross_force(J_k, W);
    for (const SignedColumn& row : pair.columns) {
      const Vector6& J_j = motion.J(row.column);
      double value = J_j.dot(dW);
      if (assembly.tree.moves(col.column, assembly.tree.columns[row.column].link))
        value += cross_motion(J_k, J_j).dot(W);
      assembly.add_tangent(row.column, col.column, -row.sign * value);
    }
  }
}

}  // namespace hersey::mbd
