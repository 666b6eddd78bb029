#pragma once

#include <functional>
#include <vector>

#include "hersey/solver/equations.h"

namespace hersey::solver {

/// How bodies spin: each about an axis of its own, which it carries along.
struct Spin {
  /// Velocities with which all bodies spin in a configuration and their axes keep still, shape (nv).
  std::function<Eigen::VectorXd(const Eigen::VectorXd& q)> velocities;
  /// Velocity components of which those of one group depend on the configuration by their own positions alone.
  std::vector<std::vector<Equations::Index>> groups;
  /// First of each three velocity components that are an angular velocity in axes that rotate.
  std::vector<Equations::Index> rotations_in_space;
};

/// Equations of a machine whose shafts spin while their axes move, for motions of these axes: theory manual eqs.
/// (rotors.6) to (rotors.9). Positions are those of a machine that does not spin, velocities and accelerations what is
/// added to the spin. Shafts that are the same at every angle on supports that are not, such as films, have steady
/// motions and small motions of constant coefficients in them, in axes that do not rotate. Use them with
/// `find_equilibrium` and `linearise`, not for steps in time: the derivative by positions is that at rest.
class SpinningEquations final : public Equations {
 public:
  /// @param inner  outlives this
  SpinningEquations(Equations& inner, Spin spin) : inner_(inner), spin_(std::move(spin)) {}

  /// Returns the state of the inner equations that belongs to `state`.
  [[nodiscard]] State inner_state(const State& state) const;
  /// Returns the state at which all bodies have spun on from `state` over `time`, their axes where they are.
  [[nodiscard]] State spun(const State& state, double time) const;

  [[nodiscard]] Index nq() const override { return inner_.nq(); }
  [[nodiscard]] Index nv() const override { return inner_.nv(); }
  [[nodiscard]] Index nlambda() const override { return inner_.nlambda(); }
  void retract(const Eigen::VectorXd& q0, const Eigen::VectorXd& dq, Eigen::VectorXd& q) const override {
    inner_.retract(q0, dq, q);
  }
  void assemble(const State& state, const Stage& stage, Eigen::VectorXd& residual, Eigen::VectorXd& scale,
                SparseMatrix* tangent) override;
  void constraints(const State& state, Eigen::VectorXd& phi, Eigen::VectorXd& scale, SparseMatrix* jacobian) override {
    inner_.constraints(state, phi, scale, jacobian);
  }
  void constraint_rates(const State& state, Eigen::VectorXd& velocity, Eigen::VectorXd& bias) override {
    inner_.constraint_rates(inner_state(state), velocity, bias);
  }
  [[nodiscard]] Eigen::VectorXd position_scales() const override { return inner_.position_scales(); }
  [[nodiscard]] std::string name_of_row(Index row) const override { return inner_.name_of_row(row); }
  [[nodiscard]] bool has_whole_tangent() const override { return inner_.has_whole_tangent(); }
  [[nodiscard]] bool has_condensed_unknowns() const override { return inner_.has_condensed_unknowns(); }
  [[nodiscard]] bool needs_tangent() const override { return inner_.needs_tangent(); }
  [[nodiscard]] double internal_residual() const override { return inner_.internal_residual(); }
  [[nodiscard]] std::string name_of_internal_residual() const override { return inner_.name_of_internal_residual(); }
  [[nodiscard]] bool is_step_consistent() override { return inner_.is_step_consistent(); }
  [[nodiscard]] std::string domain_error() const override { return inner_.domain_error(); }
  void begin_step(const State& start, double dt) override { inner_.begin_step(inner_state(start), dt); }
  void accept_step(const State& end) override { inner_.accept_step(inner_state(end)); }

 private:
  /// The spin in a configuration, its derivative by positions, and the rate at which it carries velocities along.
  struct Turning {
    Eigen::VectorXd xi;
    Eigen::MatrixXd by_position, carried;
  };
  [[nodiscard]] Turning turning_at(const Eigen::VectorXd& q) const;
  [[nodiscard]] State inner_state(const State& state, const Turning& turning) const;

  Equations& inner_;
  Spin spin_;
};

}  // namespace hersey::solver
