#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "hersey/core/scalar_function.h"

namespace hersey {

/// A function whose value can be prescribed from outside: an input of a simulation. Until a value is set, and after its
/// release, it returns the values of the original function bit for bit.
class SettableFunction final : public ScalarFunction {
 public:
  /// @param original  must not be null
  explicit SettableFunction(std::shared_ptr<const ScalarFunction> original) : original_(std::move(original)) {}

  /// Prescribes the value in SI units, independent of the variables, from now on.
  void set(double value) { prescribed_.emplace(value); }
  /// Returns to the original function from now on.
  void release() { prescribed_.reset(); }
  /// True if the value is prescribed.
  [[nodiscard]] bool is_set() const { return prescribed_.has_value(); }

  [[nodiscard]] double value(std::span<const double> x) const override { return now().value(x); }
  void gradient(std::span<const double> x, std::span<double> gradient) const override { now().gradient(x, gradient); }
  [[nodiscard]] double second_derivative(std::span<const double> x) const override {
    return now().second_derivative(x);
  }
  /// Returns the function whose values it has now: a constant or the original.
  [[nodiscard]] const ScalarFunction& now() const {
    if (prescribed_) return *prescribed_;
    return *original_;
  }

 private:
  std::shared_ptr<const ScalarFunction> original_;
  std::optional<ConstantFunction> prescribed_;
};

/// Returns the function whose values `function` has now: itself unless it can be set. Returns null for null.
[[nodiscard]] inline const ScalarFunction* now(const ScalarFunction* function) {
  const auto* settable = dynamic_cast<const SettableFunction*>(function);
  return settable == nullptr ? function : &settable->now();
}

}  // namespace hersey
