#include "tree/coupling.h"

#include <algorithm>
#include <cmath>

namespace hersey::mbd {

Coupling::Coupling(const CouplingSpec& spec, const Tree& tree) : output_column_(column_of(tree, spec.output)) {
  const auto q_of = [&](int column) { return tree.links[tree.columns[column].link].first_q; };
  output_q_ = q_of(output_column_);
  inputs_.reserve(spec.terms.size());
  for (const CouplingSpec::Term& term : spec.terms) {
    const int column = column_of(tree, term.input);
    inputs_.push_back({column, q_of(column), term.function});
  }
}

double Coupling::value(const solver::State& state) const {
  double value = state.q[output_q_];
  for (const Input& input : inputs_) value -= input.value(state);
  return value;
}

double Coupling::magnitude(const solver::State& state) const {
  double largest = std::abs(state.q[output_q_]);
  for (const Input& input : inputs_) largest = std::max(largest, std::abs(input.value(state)));
  return largest;
}

double Coupling::bias(const solver::State& state) const {
  double bias = 0;
  for (const Input& input : inputs_) {
    const double v = state.v[input.column];
    bias -= input.curvature(state) * v * v;
  }
  return bias;
}

}  // namespace hersey::mbd
