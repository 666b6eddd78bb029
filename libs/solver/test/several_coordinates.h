#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hersey/solver/equations.h"

namespace hersey::solver::test {

/// M a + f(q, v, t) + G(q)^T lambda = 0 and phi(q, t) = 0 of a few coordinates, by the functions a test gives; what it
/// leaves out is zero. Whether a state is in the domain, and when what is condensed is solved, is the test's as well.
class SeveralCoordinates final : public Equations {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  explicit SeveralCoordinates(Matrix mass_matrix, Index constraint_rows = 0)
      : mass(std::move(mass_matrix)), rows(constraint_rows), scales(Vector::Ones(mass.rows())) {}

  Matrix mass;
  Index rows;  ///< of constraints
  std::function<Vector(const Vector& q, const Vector& v, double t)> force;
  std::function<Matrix(const Vector&q, const Vector&v, double t)> force_by_q, force_by_v;
  std::function<Vector(const Vector& q, double t)> phi;
  std::function<Matrix(const Vector& q, double t)> G;
  std::function<Vector(const Vector& q, double t)> phi_t;
  std::function<Vector(const Vector& q, const Vector& v, double t)> bias;
  std::function<Matrix(const Vector& q, const Vector& lambda)> constraint_force_by_q;  ///< d(G^T lambda)/dq
  std::function<std::string(const State& state)> outside;  ///< why the state is outside of the domain, or nothing
  Vector scales;
  std::vector<std::string> names;  ///< of rows; empty: by their numbers
  double least_scale = 1;          ///< of the terms that a row balances
  int unsolved = 0;                ///< assemblies after which what is condensed is solved
  bool whole_tangent = true;
  bool condenses = false;
  int stands_after = 0;           ///< number of repeated attempts of a step
  std::function<void()> changed;  ///< what happens to the equations each of these times
  int begun = 0, accepted = 0, assembled = 0;

  [[nodiscard]] Index nq() const override { return mass.rows(); }
  [[nodiscard]] Index nv() const override { return mass.rows(); }
  [[nodiscard]] Index nlambda() const override { return rows; }
  void retract(const Vector& q0, const Vector& dq, Vector& q) const override { q = q0 + dq; }

  void assemble(const State& s, const Stage& stage, Vector& residual, Vector& scale, SparseMatrix* tangent) override {
    ++assembled;
    if (unsolved > 0) --unsolved;
    failure_ = outside ? outside(s) : "";
    const Index n = nv();
    const Vector f = force ? force(s.q, s.v, s.t) : Vector::Zero(n);
    const Matrix jacobian = jacobian_at(s);
    residual.resize(n + rows);
    residual << mass * s.vdot + f + jacobian.transpose() * s.lambda, phi_at(s);
    scale.setConstant(n + rows, least_scale);
    scale.head(n) +=
        mass.cwiseAbs() * s.vdot.cwiseAbs() + f.cwiseAbs() + jacobian.cwiseAbs().transpose() * s.lambda.cwiseAbs();
    if (!tangent) return;
    Matrix J = stage.m * mass;
    if (force_by_v) J += stage.c * force_by_v(s.q, s.v, s.t);
    if (force_by_q) J += stage.k * force_by_q(s.q, s.v, s.t);
    if (constraint_force_by_q) J += stage.k * constraint_force_by_q(s.q, s.lambda);
    fill(J, jacobian, stage.k, *tangent);
  }

  void constraints(const State& s, Vector& value, Vector& scale, SparseMatrix* jacobian) override {
    value = phi_at(s);
    scale = Vector::Ones(rows);
    if (jacobian) *jacobian = jacobian_at(s).sparseView(1, 0);
  }
  void constraint_rates(const State& s, Vector& velocity, Vector& gamma) override {
    velocity = jacobian_at(s) * s.v;
    if (phi_t) velocity += phi_t(s.q, s.t);
    gamma = bias ? bias(s.q, s.v, s.t) : Vector::Zero(rows);
  }

  [[nodiscard]] Vector position_scales() const override { return scales; }
  [[nodiscard]] std::string name_of_row(Index row) const override {
    if (!names.empty()) return names[static_cast<std::size_t>(row)];
    return row < nv() ? "coordinate " + std::to_string(row) : "constraint " + std::to_string(row - nv());
  }
  void begin_step(const State&, double) override { ++begun; }
  void accept_step(const State&) override { ++accepted; }
  [[nodiscard]] bool has_condensed_unknowns() const override { return condenses; }
  [[nodiscard]] double internal_residual() const override { return unsolved > 0 ? 1 : 0; }
  [[nodiscard]] std::string name_of_internal_residual() const override { return "what is condensed"; }
  [[nodiscard]] bool is_step_consistent() override {
    if (stands_after == 0) return true;
    --stands_after;
    changed();
    return false;
  }
  [[nodiscard]] std::string domain_error() const override { return failure_; }
  [[nodiscard]] bool has_whole_tangent() const override { return whole_tangent; }

  /// State at q and v, without accelerations and multipliers.
  [[nodiscard]] State at(const Vector& q, const Vector& v) const {
    return {.t = 0, .q = q, .v = v, .vdot = Vector::Zero(nv()), .lambda = Vector::Zero(rows)};
  }
  [[nodiscard]] State at(const Vector& q) const { return at(q, Vector::Zero(nv())); }

 private:
  [[nodiscard]] Vector phi_at(const State& s) const { return phi ? phi(s.q, s.t) : Vector::Zero(rows); }
  [[nodiscard]] Matrix jacobian_at(const State& s) const { return G ? G(s.q, s.t) : Matrix::Zero(rows, nv()); }

  /// [J, G^T; k G, D = 0], with every entry stored whatever its value: the pattern never changes.
  void fill(const Matrix& J, const Matrix& jacobian, double k, SparseMatrix& tangent) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto n = static_cast<int>(nv()), m = static_cast<int>(rows);
    for (int column = 0; column < n; ++column) {
      for (int row = 0; row < n; ++row) entries.emplace_back(row, column, J(row, column));
      for (int row = 0; row < m; ++row) {
        entries.emplace_back(n + row, column, k * jacobian(row, column));
        entries.emplace_back(column, n + row, jacobian(row, column));
      }
    }
    for (int row = n; row < n + m; ++row) entries.emplace_back(row, row, 0.0);  // of rows that may be switched off
    tangent.resize(n + m, n + m);
    tangent.setFromTriplets(entries.begin(), entries.end());
    tangent.makeCompressed();
  }

  std::string failure_;
};

}  // namespace hersey::solver::test
