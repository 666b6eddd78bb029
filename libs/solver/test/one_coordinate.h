#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "hersey/solver/equations.h"

namespace hersey::solver::test {

/// m a + f(q, v, t) = 0 for one coordinate, perhaps with a prescribed motion q = d(t); records how it is called.
class OneCoordinate final : public Equations {
 public:
  double mass = 1;
  std::function<double(double q, double v, double t)> force = [](double, double, double) { return 0.0; };
  std::function<double(double q, double v, double t)> force_by_q = [](double, double, double) { return 0.0; };
  std::function<double(double q, double v, double t)> force_by_v = [](double, double, double) { return 0.0; };
  int copies_of_constraint = 0;  ///< rows q = 0
  double lowest = -1e300;        ///< q at and below this is outside the domain
  double internal = 0;           ///< internal residual reported
  bool condenses = false;        ///< condensed unknowns are reported
  bool needs = false;            ///< these move with the tangent only
  int begun = 0, accepted = 0, assembled = 0, tangents = 0;

  [[nodiscard]] Index nq() const override { return 1; }
  [[nodiscard]] Index nv() const override { return 1; }
  [[nodiscard]] Index nlambda() const override { return copies_of_constraint; }
  void retract(const Eigen::VectorXd& q0, const Eigen::VectorXd& dq, Eigen::VectorXd& q) const override { q = q0 + dq; }

  void assemble(const State& s, const Stage& stage, Eigen::VectorXd& residual, Eigen::VectorXd& scale,
                SparseMatrix* tangent) override {
    ++assembled;
    const Index n = 1 + copies_of_constraint;
    residual.setZero(n);
    scale.setOnes(n);
    outside_ = s.q[0] <= lowest;
    const double f = outside_ ? std::nan("") : force(s.q[0], s.v[0], s.t);
    residual[0] = mass * s.vdot[0] + f + s.lambda.sum();
    scale[0] = 1 + std::abs(mass * s.vdot[0]) + std::abs(f) + s.lambda.cwiseAbs().sum();
    residual.tail(copies_of_constraint).setConstant(s.q[0]);
    if (!tangent) return;
    ++tangents;
    tangent->resize(n, n);
    tangent->insert(0, 0) =
        stage.m * mass + stage.c * force_by_v(s.q[0], s.v[0], s.t) + stage.k * force_by_q(s.q[0], s.v[0], s.t);
    for (Index i = 1; i < n; ++i) {
      tangent->insert(0, i) = 1;
      tangent->insert(i, 0) = stage.k;
    }
    tangent->makeCompressed();
  }

  void constraints(const State& s, Eigen::VectorXd& phi, Eigen::VectorXd& scale, SparseMatrix* jacobian) override {
    phi = Eigen::VectorXd::Constant(copies_of_constraint, s.q[0]);
    scale = Eigen::VectorXd::Ones(copies_of_constraint);
    if (!jacobian) return;
    jacobian->resize(copies_of_constraint, 1);
    for (int i = 0; i < copies_of_constraint; ++i) jacobian->insert(i, 0) = 1;
    jacobian->makeCompressed();
  }
  void constraint_rates(const State& s, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) override {
    velocity = Eigen::VectorXd::Constant(copies_of_constraint, s.v[0]);
    bias = Eigen::VectorXd::Zero(copies_of_constraint);
  }

  [[nodiscard]] std::string name_of_row(Index row) const override {
    return row == 0 ? "mass" : "stop " + std::to_string(row);
  }
  void begin_step(const State&, double) override { ++begun; }
  void accept_step(const State&) override { ++accepted; }
  [[nodiscard]] bool has_condensed_unknowns() const override { return condenses; }
  [[nodiscard]] bool needs_tangent() const override { return needs; }
  [[nodiscard]] double internal_residual() const override { return internal; }
  [[nodiscard]] std::string name_of_internal_residual() const override { return "film of the fake"; }
  [[nodiscard]] std::string domain_error() const override { return outside_ ? "gap closed" : ""; }

  /// A start at q0, v0.
  [[nodiscard]] State at(double q0, double v0) const {
    State s;
    s.q = Eigen::VectorXd::Constant(1, q0);
    s.v = Eigen::VectorXd::Constant(1, v0);
    s.vdot = Eigen::VectorXd::Constant(1, copies_of_constraint > 0 ? 0.0 : -force(q0, v0, 0) / mass);
    s.lambda = Eigen::VectorXd::Zero(copies_of_constraint);
    return s;
  }

 private:
  bool outside_ = false;
};

}  // namespace hersey::solver::test
