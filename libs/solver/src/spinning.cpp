#include "hersey/solver/spinning.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hersey::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Increment of positions for derivatives of the spin, rad or m: of fourth order, it leaves 1e-12 of smooth functions,
// and of their round-off likewise.
constexpr double kIncrement = 2e-3;
constexpr int kStepsOfASpin = 64;  // of order four, for angles of about a radian

MatrixXd motions_of(const Equations::SparseMatrix& tangent, Index nv) {
  return MatrixXd(tangent).topLeftCorner(nv, nv);
}

}  // namespace

SpinningEquations::Turning SpinningEquations::turning_at(const VectorXd& q) const {
  Turning turning;
  turning.xi = spin_.velocities(q);
  const Index n = nv();
  turning.by_position.setZero(n, n);
  std::size_t most = 0;
  for (const auto& group : spin_.groups) most = std::max(most, group.size());
  VectorXd moved;
  for (std::size_t k = 0; k < most; ++k) {
    VectorXd change = VectorXd::Zero(n), direction = VectorXd::Zero(n);
    for (const auto& group : spin_.groups)
      if (k < group.size()) direction[group[k]] = 1;
    for (const auto& [steps, weight] : {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
      inner_.retract(q, steps * kIncrement * direction, moved);
      change += weight / (12 * kIncrement) * spin_.velocities(moved);
    }
    for (const auto& group : spin_.groups)
      if (k < group.size())
        for (const Index row : group) turning.by_position(row, group[k]) = change[row];
  }
  // (rotors.8): where velocities belong to axes that rotate, what is carried along rotates in them, too.
  turning.carried = turning.by_position;
  for (const Index first : spin_.rotations_in_space) {
    const Eigen::Vector3d omega = turning.xi.segment<3>(first);
    Eigen::Matrix3d turned;
    turned << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
    turning.carried.block<3, 3>(first, first) -= turned;
  }
  return turning;
}

// (rotors.7)
State SpinningEquations::inner_state(const State& state, const Turning& turning) const {
  State inner = state;
  inner.v = turning.xi + state.v;
  inner.vdot = state.vdot + (turning.by_position + turning.carried) * state.v + turning.by_position * turning.xi;
  return inner;
}

State SpinningEquations::inner_state(const State& state) const { return inner_state(state, turning_at(state.q)); }

State SpinningEquations::spun(const State& state, double time) const {
  State later = state;
  later.t += time;
  const double dt = time / kStepsOfASpin;
  VectorXd at = state.q;
  for (int i = 0; i < kStepsOfASpin; ++i) {
    // Runge and Kutta's method on increments of the position: their rates are the velocities to the order that counts.
    const auto rate = [&](const VectorXd& increment) {
      VectorXd q, own;
      inner_.retract(at, increment, q);
      inner_.increment_rate(increment, spin_.velocities(q), own);
      return own;
    };
    const VectorXd none = VectorXd::Zero(nv());
    const VectorXd k1 = rate(none), k2 = rate(dt / 2 * k1), k3 = rate(dt / 2 * k2), k4 = rate(dt * k3);
    VectorXd next;
    inner_.retract(at, dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4), next);
    at = std::move(next);
  }
  later.q = at;
  return later;
}

void SpinningEquations::assemble(const State& state, const Stage& stage, VectorXd& residual, VectorXd& scale,
                                 SparseMatrix* tangent) {
  const Turning turning = turning_at(state.q);
  const State inner = inner_state(state, turning);
  if (tangent == nullptr) return inner_.assemble(inner, stage, residual, scale, nullptr);
  const Index n = nv();
  const MatrixXd &B = turning.by_position, &A = turning.carried;
  MatrixXd added = MatrixXd::Zero(n, n);
  SparseMatrix part;
  VectorXd unused_residual, unused_scale;
  inner_.assemble(inner, {.dt = stage.dt, .k = 0, .c = 1, .m = 0, .dq = {}}, unused_residual, unused_scale, &part);
  added += motions_of(part, n) * (stage.k * B);
  inner_.assemble(inner, {.dt = stage.dt, .k = 0, .c = 0, .m = 1, .dq = {}}, unused_residual, unused_scale, &part);
  added += motions_of(part, n) * (stage.c * (A + B) + stage.k * A * B);  // (rotors.9)
  inner_.assemble(inner, stage, residual, scale, &part);
  added += motions_of(part, n);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n * n + part.nonZeros()));
  for (Index column = 0; column < n; ++column)
    for (Index row = 0; row < n; ++row) entries.emplace_back(row, column, added(row, column));
  for (Index column = 0; column < part.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(part, column); entry; ++entry)
      if (entry.row() >= n || column >= n) entries.emplace_back(entry.row(), column, entry.value());
  tangent->resize(part.rows(), part.cols());
  tangent->setFromTriplets(entries.begin(), entries.end());
}

}  // namespace hersey::solver
