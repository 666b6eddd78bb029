#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

namespace hersey::film {

class FlowBalance;

/// The part of a film's Jacobian J that features behind restrictors add to the pattern of neighbouring nodes
/// (hydrostatic.5): the matrix J0 in the pattern has a given pressure in every feature; the pressures p of restricted
/// ones are its border. A system in J is one in J0 for each right-hand side, and one more for each restricted feature.
class PortBorder {
 public:
  /// Takes the border at the state of which the Jacobian has been assembled.
  void take(const FlowBalance& balance);
  /// J0 has another factor than when it was last solved with.
  void forget_answers() { answers_.resize(0, 0); }
  [[nodiscard]] bool is_empty() const { return nodes_.empty(); }

  /// Replaces each column b by the solution of J x = b.
  /// @param solve  replaces each column of a matrix by the solution with J0
  template <class Solve>
  void solve(Eigen::Ref<Eigen::MatrixXd> columns, const Solve& solve_given) {
    if (is_empty()) return solve_given(columns);
    find_answers(solve_given);
    const Eigen::MatrixXd balances = take_rows(columns);
    solve_given(columns);
    columns -= answers_ * ports_.solve(rows_.transpose() * columns - balances);
  }

  /// Replaces each column b by the solution of J^T x = b.
  /// @param solve_given  solves with J0
  /// @param solve_transposed  solves with J0^T
  template <class Solve, class SolveTransposed>
  void solve_transposed(Eigen::Ref<Eigen::MatrixXd> columns, const Solve& solve_given,
                        const SolveTransposed& solve_with_transposed) {
    if (is_empty()) return solve_with_transposed(columns);
    find_answers(solve_given);
    const Eigen::MatrixXd z = ports_.transpose().solve(answers_.transpose() * columns);
    columns -= rows_ * z;
    solve_with_transposed(columns);
    put_rows(z, columns);
  }

  /// Entries of a vector in the rows of ports.
  [[nodiscard]] Eigen::VectorXd at_ports(const Eigen::VectorXd& y) const;
  /// Turns y - J0 x into y - J x.
  /// @param before  at_ports() of y
  void subtract_product(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::VectorXd& before,
                        Eigen::VectorXd& y) const;

 private:
  template <class Solve>
  void find_answers(const Solve& solve_given) {
    if (answers_.cols() != 0) return;
    Eigen::MatrixXd answers = columns_;
    solve_given(answers);
    answers_ = std::move(answers);
    factorise_ports();
  }
  [[nodiscard]] Eigen::MatrixXd take_rows(Eigen::Ref<Eigen::MatrixXd> columns) const;
  void put_rows(const Eigen::MatrixXd& z, Eigen::Ref<Eigen::MatrixXd> columns) const;
  void factorise_ports();

  std::vector<int> nodes_;
  Eigen::MatrixXd rows_, columns_;              ///< FlowBalance::find_restricted()
  Eigen::MatrixXd answers_;                     ///< J0^{-1} columns_; empty: not yet found
  Eigen::PartialPivLU<Eigen::MatrixXd> ports_;  ///< of rows_^T answers_
  double least_conductance_ = 0;                ///< [m^3/(Pa s)]
};

}  // namespace hersey::film
