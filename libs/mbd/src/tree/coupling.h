#pragma once

#include <memory>
#include <vector>

#include "hersey/mbd/mechanism_spec.h"
#include "hersey/solver/equations.h"
#include "tree/tree.h"

namespace hersey::mbd {

/// Connection of a coupling to the tree: the row  Phi = q_out - sum f_i(q_i) = 0  (theory manual eq. (mechanisms.19)).
class Coupling {
 public:
  Coupling(const CouplingSpec& spec, const Tree& tree);

  [[nodiscard]] double value(const solver::State& state) const;
  /// The largest coordinate it compares.
  [[nodiscard]] double magnitude(const solver::State& state) const;
  /// d2 Phi/dt2 less dPhi/dq . vdot.
  [[nodiscard]] double bias(const solver::State& state) const;
  [[nodiscard]] int output() const { return output_column_; }
  [[nodiscard]] int output_q() const { return output_q_; }

  /// Calls visit(column, dPhi/dq) for the output and each input.
  template <class Visit>
  void visit_rates(const solver::State& state, Visit visit) const {
    visit(output_column_, 1.0);
    for (const Input& input : inputs_) visit(input.column, -input.rate(state));
  }
  /// Calls visit(column, d2Phi/dq2) for each input.
  template <class Visit>
  void visit_curvatures(const solver::State& state, Visit visit) const {
    for (const Input& input : inputs_) visit(input.column, -input.curvature(state));
  }
  /// Calls visit(column) for the output and each input.
  template <class Visit>
  void visit_columns(Visit visit) const {
    visit(output_column_);
    for (const Input& input : inputs_) visit(input.column);
  }

 private:
  struct Input {
    int column = 0, q = 0;
    std::shared_ptr<const ScalarFunction> function;

    [[nodiscard]] double value(const solver::State& state) const { return function->value({&state.q[q], 1}); }
    [[nodiscard]] double rate(const solver::State& state) const {
      double rate = 0;
      function->gradient({&state.q[q], 1}, {&rate, 1});
      return rate;
    }
    [[nodiscard]] double curvature(const solver::State& state) const {
      return function->second_derivative({&state.q[q], 1});
    }
  };

  int output_column_, output_q_;
  std::vector<Input> inputs_;
};

}  // namespace hersey::mbd
