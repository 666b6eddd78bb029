#pragma once

#include <span>

namespace hersey {

/// Interface of a real function of one or more real variables with derivatives; loads, drives and tables are such
/// functions.
class ScalarFunction {
 public:
  virtual ~ScalarFunction() = default;

  /// Returns the value at `x`, one entry per variable.
  [[nodiscard]] virtual double value(std::span<const double> x) const = 0;

  /// Writes d value / d x_i into `gradient`, which has the length of `x`.
  virtual void gradient(std::span<const double> x, std::span<double> gradient) const = 0;

  /// Returns d^2 value / d x_0^2, the acceleration of a drive.
  [[nodiscard]] virtual double second_derivative(std::span<const double> x) const = 0;
};

/// Constant function.
class ConstantFunction final : public ScalarFunction {
 public:
  /// Makes the function of any number of variables that equals `value` everywhere.
  explicit ConstantFunction(double value) : value_(value) {}
  [[nodiscard]] double value(std::span<const double>) const override { return value_; }
  void gradient(std::span<const double>, std::span<double> gradient) const override {
    for (double& g : gradient) g = 0;
  }
  [[nodiscard]] double second_derivative(std::span<const double>) const override { return 0; }

 private:
  double value_;
};

}  // namespace hersey
