#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "instance.h"

namespace hersey::fmu {
namespace {

std::size_t count_of(const Variables& variables, const std::vector<unsigned>& references) {
  std::size_t count = 0;
  for (const unsigned reference : references) count += size_of(variables.list[reference - 1]);
  return count;
}

}  // namespace

// The derivatives of all outputs by one input; null where it has not acted yet.
const std::vector<std::vector<double>>* Instance::derivatives_by(unsigned known) {
  return has_stepped_ ? &simulation_->derivative(variable(known).source) : nullptr;
}

CallStatus Instance::derivative(bool is_adjoint, const std::vector<unsigned>& unknowns,
                                const std::vector<unsigned>& knowns, const double* seed, std::size_t seed_count,
                                double* found, std::size_t found_count) {
  if (const CallStatus refused = refuse_in_update(); refused != CallStatus::ok) return refused;
  if (phase_ != Phase::initialisation && phase_ != Phase::stepping && phase_ != Phase::terminated)
    return error("derivatives are there in the initialisation and between steps, and not behind a failure");
  if (phase_ == Phase::initialisation && !simulation_) build();
  if (const std::string why = run::why_no_derivatives(simulation_->model()); !why.empty())
    return error("derivatives of this model are not provided: they need " + why);
  for (const unsigned reference : unknowns)
    if (variable(reference).kind != Variable::Kind::output)
      return error(variable(reference).name + " is no output: derivatives are of outputs");
  for (const unsigned reference : knowns)
    if (variable(reference).kind != Variable::Kind::input)
      return error(variable(reference).name + " is no input: derivatives are with respect to inputs");
  const std::size_t rows = count_of(variables_, unknowns), columns = knowns.size();
  if (seed_count != (is_adjoint ? rows : columns) || found_count != (is_adjoint ? columns : rows))
    return error(fmt::format("{} seeds and room for {} derivatives of {} outputs with respect to {} inputs", seed_count,
                             found_count, rows, columns));
  std::vector<double> sums(found_count, 0.0);
  for (std::size_t column = 0; column < columns; ++column) {
    if (!is_adjoint && seed[column] == 0) continue;
    const auto* const by_input = derivatives_by(knowns[column]);
    if (by_input == nullptr) continue;
    std::size_t row = 0;
    for (const unsigned reference : unknowns) {
      const Variable& one = variable(reference);
      const std::vector<double>& values = (*by_input)[outputs_[reference - 1]];
      for (std::size_t k = 0; k < size_of(one); ++k, ++row) {
        const double value = values.at(one.size > 0 ? k : one.column);
        if (is_adjoint)
          sums[column] += value * seed[row];
        else
          sums[row] += value * seed[column];
      }
    }
  }
  std::copy(sums.begin(), sums.end(), found);
  return CallStatus::ok;
}

CallStatus Instance::directional_derivative(const unsigned* unknowns, std::size_t unknown_count, const unsigned* knowns,
                                            std::size_t known_count, const double* seed, std::size_t seed_count,
                                            double* derivative_of, std::size_t derivative_count) {
  if (unknowns == nullptr || knowns == nullptr || seed == nullptr || derivative_of == nullptr)
    return error("no variables, no seed or no room for derivatives");
  return guarded([&] {
    return derivative(false, {unknowns, unknowns + unknown_count}, {knowns, knowns + known_count}, seed, seed_count,
                      derivative_of, derivative_count);
  });
}

CallStatus Instance::adjoint_derivative(const unsigned* unknowns, std::size_t unknown_count, const unsigned* knowns,
                                        std::size_t known_count, const double* seed, std::size_t seed_count,
                                        double* derivative_of, std::size_t derivative_count) {
  if (unknowns == nullptr || knowns == nullptr || seed == nullptr || derivative_of == nullptr)
    return error("no variables, no seed or no room for derivatives");
  return guarded([&] {
    return derivative(true, {unknowns, unknowns + unknown_count}, {knowns, knowns + known_count}, seed, seed_count,
                      derivative_of, derivative_count);
  });
}

void Instance::update_intermediately(IntermediateUpdate update, const unsigned* references, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    if (references[k] != 0 && variable(references[k]).kind != Variable::Kind::output)
      throw std::runtime_error(variable(references[k]).name + " is no output: intermediate updates are of outputs");
  update_ = std::move(update);
}

}  // namespace hersey::fmu
