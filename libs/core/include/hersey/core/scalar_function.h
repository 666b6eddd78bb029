#pragma once

#include <span>

namespace hersey {

/// A real function of one or more real variables, with derivatives: the shape of every load, drive and table.
class ScalarFunction {
 public:
  virtual ~ScalarFunction() = default;

  /// The value at `x`, one entry per variable.
  [[nodiscard]] virtual double value(std::span<const double> x) const = 0;

  /// Writes d value / d x_i into `gradient`, which has the length of `x`.
  virtual void gradient(std::span<const double> x, std::span<double> gradient) const = 0;

  /// d^2 value / d x_0^2: a drive's acceleration.
  [[nodiscard]] virtual double second_derivative(std::span<const double> x) const = 0;
};

/// The same value everywhere.
class ConstantFunction final : public ScalarFunction {
 public:
  /// `value` at every x, of any number of variables.
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
