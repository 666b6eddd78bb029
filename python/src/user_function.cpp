#include "user_function.h"

#include <fmt/format.h>
#include <pybind11/complex.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace hersey::python {
namespace {

namespace py = pybind11;

// Steps of differences: truncation and round-off balance at the third and fourth root of eps, of the argument's own
// size or, near zero, of a hundredth of its SI unit.
constexpr double kSmallest = 1e-2;
double step(double x, double root) {
  return std::pow(std::numeric_limits<double>::epsilon(), 1 / root) * std::max(std::abs(x), kSmallest);
}

constexpr double kComplexStep = 1e-30;  // its square is lost beside any value: the derivative has no truncation error

std::string text_of(const py::handle& object) { return py::repr(object).cast<std::string>(); }

py::tuple arguments_of(std::span<const double> x) {
  py::tuple arguments(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) arguments[i] = x[i];
  return arguments;
}

}  // namespace

UserFunction::UserFunction(py::object function, py::object derivative, double scale, std::shared_ptr<UserCalls> calls)
    : function_(std::move(function)), derivative_(std::move(derivative)), scale_(scale), calls_(std::move(calls)) {
  if (!py::isinstance<py::str>(derivative_)) {
    kind_ = Derivative::given;
  } else if (derivative_.cast<std::string>() == "complex") {
    kind_ = Derivative::complex_step;
  }
}

UserFunction::~UserFunction() {
  const py::gil_scoped_acquire lock;
  function_ = py::object();
  derivative_ = py::object();
}

void UserFunction::refuse(const std::string& found) const {
  const std::lock_guard guard(calls_->mutex);
  if (calls_->fault.empty()) calls_->fault = found;
  throw std::runtime_error("the Python function of " + calls_->name + " " + found);
}

// Holds the interpreter's lock, counts, and keeps what is raised: the solver's threads have no use for it.
template <class Work>
auto UserFunction::in_python(Work work) const {
  const auto began = std::chrono::steady_clock::now();
  const py::gil_scoped_acquire lock;
  ++calls_->calls;
  try {
    auto result = work();
    calls_->seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return result;
  } catch (py::error_already_set& error) {
    if (!calls_->exception) calls_->exception = error.value();
    const std::string raised =
        error.type().attr("__name__").cast<std::string>() + ": " + py::str(error.value()).cast<std::string>();
    refuse("raised " + raised);
  }
}

double UserFunction::value(std::span<const double> x) const {
  return in_python([&] {
    const py::object result = function_(*arguments_of(x));
    double value = 0;
    try {
      value = py::float_(result);
    } catch (const py::error_already_set&) {
      refuse("gave " + text_of(result) + ": expected one finite number");
    }
    if (!std::isfinite(value)) refuse("gave " + text_of(result) + ": expected a finite number");
    return scale_ * value;
  });
}

double UserFunction::difference(std::span<const double> x, std::size_t i) const {
  std::vector<double> beside(x.begin(), x.end());
  const double d = step(x[i], 3);
  beside[i] = x[i] + d;
  const double above = value(beside);
  beside[i] = x[i] - d;
  return (above - value(beside)) / (2 * d);
}

double UserFunction::complex_step(std::span<const double> x, std::size_t i) const {
  return in_python([&] {
    py::tuple arguments = arguments_of(x);
    arguments[i] = std::complex<double>(x[i], kComplexStep);
    const py::object result = function_(*arguments);
    // A real number may be a constant, or a function that has dropped the imaginary part: abs, float, math.
    if (!PyComplex_Check(result.ptr()) && !py::hasattr(result, "imag"))
      refuse("gave " + text_of(result) +
             " of a complex argument: expected a complex number, or derivative='difference'");
    if (PyFloat_CheckExact(result.ptr()) != 0 && x.size() == 1)
      refuse("gave the real number " + text_of(result) +
             " of a complex argument: expected a complex number, or "
             "derivative='difference'");
    const double slope = result.attr("imag").cast<double>() / kComplexStep;
    if (!std::isfinite(slope)) refuse("gave " + text_of(result) + " of a complex argument: expected a finite number");
    return scale_ * slope;
  });
}

void UserFunction::gradient(std::span<const double> x, std::span<double> gradient) const {
  if (kind_ != Derivative::given) {
    for (std::size_t i = 0; i < x.size(); ++i)
      gradient[i] = kind_ == Derivative::complex_step ? complex_step(x, i) : difference(x, i);
    return;
  }
  (void)in_python([&] {
    const py::object result = derivative_(*arguments_of(x));
    const bool is_list = py::isinstance<py::sequence>(result) || py::hasattr(result, "__len__");
    if (is_list ? py::len(result) != x.size() : x.size() != 1)
      refuse(fmt::format("has the derivative {}: expected {} numbers", text_of(result), x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) {
      const py::object entry = is_list ? py::object(result[py::int_(i)]) : result;
      gradient[i] = scale_ * py::float_(entry).cast<double>();
      if (!std::isfinite(gradient[i])) refuse("has the derivative " + text_of(result) + ": expected finite numbers");
    }
    return 0;
  });
}

double UserFunction::second_derivative(std::span<const double> x) const {
  std::vector<double> beside(x.begin(), x.end()), slopes(x.size());
  if (kind_ == Derivative::difference) {
    const double d = step(x[0], 4);
    beside[0] = x[0] + d;
    const double above = value(beside);
    beside[0] = x[0] - d;
    return (above - 2 * value(x) + value(beside)) / (d * d);
  }
  const double d = step(x[0], 3);
  beside[0] = x[0] + d;
  gradient(beside, slopes);
  const double above = slopes[0];
  beside[0] = x[0] - d;
  gradient(beside, slopes);
  return (above - slopes[0]) / (2 * d);
}

}  // namespace hersey::python
