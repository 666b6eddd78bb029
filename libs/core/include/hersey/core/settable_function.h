#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "hersey/core/scalar_function.h"

namespace hersey {

/// A function that can be held at a number from outside: an input of a simulation. Until it is set, and after release,
/// it is the function that it was made with, bit for bit.
class SettableFunction final : public ScalarFunction {
 public:
  /// Stands for `given`, never null.
  explicit SettableFunction(std::shared_ptr<const ScalarFunction> given) : interface_wrench_(std::move(given)) {}

  /// From now on this number, in SI, whatever the variables are.
  void set(double value) { held_.emplace(value); }
  /// From now on what was given.
  void release() { held_.reset(); }
  /// Whether it is held at a number.
  [[nodiscard]] bool is_set() const { return held_.has_value(); }

  [[nodiscard]] double value(std::span<const double> x) const override { return now().value(x); }
  void gradient(std::span<const double> x, std::span<double> gradient) const override { now().gradient(x, gradient); }
  [[nodiscard]] double second_derivative(std::span<const double> x) const override {
    return now().second_derivative(x);
  }
  /// The function whose values it has now.
  [[nodiscard]] const ScalarFunction& now() const {
    if (held_) return *held_;
    return *interface_wrench_;
  }

 private:
  std::shared_ptr<const ScalarFunction> interface_wrench_;
  std::optional<ConstantFunction> held_;
};

/// The function whose values `function` has now: itself, unless it can be set. Null where it is.
[[nodiscard]] inline const ScalarFunction* now(const ScalarFunction* function) {
  const auto* settable = dynamic_cast<const SettableFunction*>(function);
  return settable == nullptr ? function : &settable->now();
}

}  // namespace hersey
