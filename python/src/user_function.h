#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "hersey/core/scalar_function.h"

namespace hersey::python {

/// What a function given from Python has cost, and what went wrong with it first.
struct UserCalls {
  std::string name;  ///< key path it was given for
  std::atomic<long> calls{0};
  std::atomic<double> seconds{0};  ///< inside the interpreter, waiting for it included
  std::mutex mutex;
  std::string fault;           ///< empty: none
  pybind11::object exception;  ///< that it raised; null otherwise
};

/// A function of the model that is evaluated by Python, in whatever thread asks for it.
class UserFunction final : public ScalarFunction {
 public:
  /// @param function    of as many floats as the model's function has variables (SI)
  /// @param derivative  "difference", "complex", or a function that gives one derivative per variable
  /// @param scale       what one unit of its value is in SI
  UserFunction(pybind11::object function, pybind11::object derivative, double scale, std::shared_ptr<UserCalls> calls);
  UserFunction(const UserFunction&) = delete;
  UserFunction& operator=(const UserFunction&) = delete;
  ~UserFunction() override;

  /// The value at `x`. @throws std::runtime_error where Python raised or gave no finite number; UserCalls has it then.
  [[nodiscard]] double value(std::span<const double> x) const override;
  void gradient(std::span<const double> x, std::span<double> gradient) const override;
  [[nodiscard]] double second_derivative(std::span<const double> x) const override;

 private:
  enum class Derivative { difference, complex_step, given };
  template <class Work>
  auto in_python(Work work) const;
  [[nodiscard]] double difference(std::span<const double> x, std::size_t i) const;
  [[nodiscard]] double complex_step(std::span<const double> x, std::size_t i) const;
  [[noreturn]] void refuse(const std::string& found) const;

  pybind11::object function_, derivative_;
  Derivative kind_ = Derivative::difference;
  double scale_ = 1;
  std::shared_ptr<UserCalls> calls_;
};

}  // namespace hersey::python
