#pragma once

#include <Eigen/Dense>

namespace hersey::film {

/// Rows of a wall whose temperatures follow the heat into each of its angles, all coupled with all: scale (T + rise (C
/// T - from film)) = known (thermal.37), with C the conductances between film and wall.
class WallAnswer {
 public:
  /// @param rise  shape (n_phi, n_phi) [K/W], kept alive by the caller; null: there is no such wall
  /// @param scale [W/K], of the size of C
  void set(const Eigen::MatrixXd* rise, double scale) { rise_ = rise, scale_ = scale; }
  [[nodiscard]] bool is_set() const { return rise_ != nullptr; }

  [[nodiscard]] double scale() const { return scale_; }
  /// Contribution of the balance of angle j to row i.
  [[nodiscard]] double by_balance(int i, int j) const { return scale_ * (*rise_)(i, j); }

  /// Prepares solve(). @param C  shape (n_phi) [W/K]
  void prepare(const Eigen::VectorXd& C) {
    factor_.compute(Eigen::MatrixXd::Identity(C.size(), C.size()) + *rise_ * C.asDiagonal());
  }
  /// Evaluates the rows for temperatures T [K] and balances of heat C T - from film [W].
  [[nodiscard]] Eigen::VectorXd rows(const Eigen::VectorXd& T, const Eigen::VectorXd& balance) const {
    return scale_ * (T + *rise_ * balance);
  }
  /// Solves the rows for T, with the film's temperatures known: `balance` is their contribution to C T.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& known, const Eigen::VectorXd& balance) const {
    return factor_.solve(known / scale_ - *rise_ * balance);
  }

 private:
  const Eigen::MatrixXd* rise_ = nullptr;
  double scale_ = 1;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace hersey::film
