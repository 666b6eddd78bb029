#include "hersey/core/expression.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace hersey {
namespace expression_test {

constexpr double kNineDigits = 1e-9;  // promised; differences of eighth order give about 1e-11 of smooth expressions

constexpr double pi = std::numbers::pi;

double value(const std::string& expression, double t) {
  return ExpressionFunction(expression, {"t"}).value(std::array{t});
}

double slope(const std::string& expression, double t) {
  std::array<double, 1> gradient{};
  ExpressionFunction(expression, {"t"}).gradient(std::array{t}, gradient);
  return gradient[0];
}

ExpressionError error_of(const std::string& expression) {
  try {
    const ExpressionFunction function(expression, {"t", "main.rotation"});
  } catch (const ExpressionError& error) {
    return error;
  }
  FAIL("'" << expression << "' was accepted");
  return {"", 0, ""};
}

TEST_CASE("Expressions_HaveTheirValue") {
  CHECK(value("100*sin(2*pi*50*t)", 0.005) == doctest::Approx(100).epsilon(1e-15));  // round-off of pi and the sine
  CHECK(value("t^2 - 3*t + e^0", 2) == -1);
  CHECK(value("t < 1 ? 5 : 7", 0.5) == 5);
  CHECK(value("t >= 1 ? 5 : 7", 0.5) == 7);
  CHECK(value("max(t, 2, 3) + min(t, 0)", 1) == 3);
  CHECK(value("1e-3*t", 2) == 0.002);
  CHECK(std::isinf(value("1/t", 0)));
  const ExpressionFunction scaled("2*t + main.rotation", {"t", "main.rotation"}, 1e5);
  CHECK(scaled.value(std::array{1.0, 3.0}) == 5e5);
}

TEST_CASE("Derivatives_AreGoodToNineDigits") {
  struct Case {
    const char* expression;
    std::function<double(double)> first, second;
    double t;
  };
  const double w = 2 * pi * 50;
  const std::vector<Case> cases = {
      {"100*sin(2*pi*50*t)", [w](double t) { return 100 * w * std::cos(w * t); },
       [w](double t) { return -100 * w * w * std::sin(w * t); }, 0.0123},
      {"100*sin(2*pi*50*t)", [w](double t) { return 100 * w * std::cos(w * t); },
       [w](double t) { return -100 * w * w * std::sin(w * t); }, 0.0},
      {"exp(-t) + 5", [](double t) { return -std::exp(-t); }, [](double t) { return std::exp(-t); }, 0.7},
      {"t^5", [](double t) { return 5 * std::pow(t, 4); }, [](double t) { return 20 * std::pow(t, 3); }, -1.3},
      {"3*t + 2", [](double) { return 3.0; }, [](double) { return 0.0; }, 1e3},
      {"1/(1 + t^2)", [](double t) { return -2 * t / std::pow(1 + t * t, 2); },
       [](double t) { return (6 * t * t - 2) / std::pow(1 + t * t, 3); }, 0.4},
  };
  for (const Case& c : cases) {
    CAPTURE(c.expression);
    CAPTURE(c.t);
    const ExpressionFunction function(c.expression, {"t"});
    std::array<double, 1> gradient{};
    function.gradient(std::array{c.t}, gradient);
    const double second = function.second_derivative(std::array{c.t});
    const double size1 = std::max(std::abs(c.first(c.t)), 1e-3), size2 = std::max(std::abs(c.second(c.t)), 1.0);
    MESSAGE("relative errors ", (gradient[0] - c.first(c.t)) / size1, " and ", (second - c.second(c.t)) / size2);
    CHECK(std::abs(gradient[0] - c.first(c.t)) < kNineDigits * size1);
    // At a zero of the second derivative only the size of f sets the scale of the round-off.
    const double scale = c.t == 0 ? 100 * w * w : size2;
    CHECK(std::abs(second - c.second(c.t)) < kNineDigits * scale);
  }
}

TEST_CASE("Derivative_IsNotFooledByARepeatingFunction") {
  // Steps of 0.1 or any multiple of 0.01 s see a 100 Hz wave as a constant.
  CHECK(slope("sin(2*pi*100*t)", 0) == doctest::Approx(200 * pi).epsilon(kNineDigits));
  CHECK(slope("sin(2*pi*5000*t)", 0.1) == doctest::Approx(1e4 * pi * std::cos(1e3 * pi)).epsilon(kNineDigits));
}

TEST_CASE("Derivative_RespectsKinks") {
  // The step stays on one side of the kink at t = 0.
  CHECK(slope("abs(t)", 1e-3) == doctest::Approx(1).epsilon(kNineDigits));
  CHECK(slope("abs(t)", -1e-3) == doctest::Approx(-1).epsilon(kNineDigits));
  CHECK(slope("t < 0.02 ? 100*t/0.02 : 100", 0.0199) == doctest::Approx(5000).epsilon(kNineDigits));
  CHECK(slope("t < 0.02 ? 100*t/0.02 : 100", 0.0201) == 0);
  CHECK(slope("7", 0.3) == 0);
  CHECK(std::isnan(slope("1/t", 0)));
}

TEST_CASE("SyntaxErrors_HaveTheirPosition") {
  const ExpressionError name = error_of("100*sim(t)");
  CHECK(std::string(name.what()) == "unknown name 'sim'");
  CHECK(name.position == 4);
  CHECK(name.token_text == "sim");
  CHECK(error_of("2*x").position == 2);
  CHECK(error_of("1 + * 2").position == 4);
  CHECK(std::string(error_of("1 + * 2").what()) == "'*' does not fit here");
  CHECK(error_of("").position == 0);
  CHECK(std::string(error_of("").what()) == "empty expression");
  CHECK(std::string(error_of("sin(t").what()) == "a parenthesis is not closed");
  CHECK(error_of("sin(t").position == 5);
  CHECK(std::string(error_of("1 +").what()) == "the expression ends too early");
  CHECK(std::string(error_of("t = 3").what()) == "'=' assigns; == compares");
  CHECK(error_of("t = 3").position == 2);
  CHECK(std::string(error_of("1, 2").what()) == "',' outside of a function's arguments");
  CHECK(std::string(error_of("sin(1, 2)").what()) == "too many arguments for 'sin'");
  CHECK(std::string(error_of("atan2(1)").what()) == "too few arguments for 'atan2'");
  CHECK(std::string(error_of("\"a\"").what()) == "text has no value");
  CHECK(error_of("2 t").position == 2);
}

TEST_CASE("Variables_AreFoundInAnExpression") {
  using Names = std::vector<std::string>;
  CHECK(variables_of("100*sin(2*pi*50*t)") == Names{"t"});
  CHECK(variables_of("main.rotation_rate*2 + t - main.rotation + t") ==
        Names{"main.rotation_rate", "t", "main.rotation"});
  CHECK(variables_of("1e5 + 2.5e-3") == Names{});
  CHECK(variables_of("") == Names{});
}

}  // namespace expression_test
}  // namespace hersey
