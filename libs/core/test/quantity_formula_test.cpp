#include "hersey/core/quantity_formula.h"

#include <doctest/doctest.h>

#include <limits>
#include <numbers>
#include <string>

namespace hersey {
namespace quantity_formula_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// In SI; products and conversions round a few times.
bool is(const std::string& formula, const std::string& si_unit, double value) {
  return std::abs(convert_to_si(evaluate_formula(formula), si_unit) - value) <= 8 * eps * std::abs(value);
}

std::string error_of(const std::string& formula) {
  try {
    (void)evaluate_formula(formula);
  } catch (const QuantityError& error) {
    return error.what();
  }
  return "none";
}

TEST_CASE("Signs_MeanWhatTheyMeanInArithmetic") {
  CHECK(is("2-(-3)*1", "1", 5));
  CHECK(is("(-3)^2", "1", 9));
  CHECK(is("-3^2", "1", -9));
  CHECK(is("10-(-3)^2", "1", 1));
  CHECK(is("6/(1+2)", "1", 2));
  CHECK(is("-(-3)", "1", 3));
  CHECK(is("--3", "1", 3));
  CHECK(is("+(3)", "1", 3));
  CHECK(is("2^3^2", "1", 512));
  CHECK(is("2^-1", "1", 0.5));
  CHECK(is("8/2/2*3-1-1", "1", 4));
  CHECK(is("2*pi", "1", 2 * std::numbers::pi));
}

TEST_CASE("Units_AreWorkedOut") {
  CHECK(is("(3) mm", "m", 3e-3));
  CHECK(is("-(3 mm)", "m", -3e-3));
  CHECK(is("(50 mm)/2 - 3*(0.1 mm)", "m", 24.7e-3));
  CHECK(is("1 m + 1 mm", "m", 1.001));
  CHECK(is("(100 N)*(30 mm)", "N.m", 3));
  CHECK(is("(100 N)/(2 mm)^2", "Pa", 25e6));
  CHECK(is("(3 mm)/(1.5 mm)", "1", 2));
  CHECK(is("(6 mm)/(2 m)", "1", 3e-3));
  CHECK(is("3 m/s*2", "m/s", 6));
  CHECK(is("10 N/mm^2*2", "Pa", 20e6));
  CHECK(is("2*(1.28e-8 1/Pa)", "1/Pa", 2.56e-8));
  CHECK(is("(50 rpm)*2", "rad/s", 100 * std::numbers::pi / 30));
  CHECK(is("(10 rad/s)*(2 m)/1 rad", "m/s", 20));
  CHECK(is("4 kg m^2/s^2 / 2", "N.m", 2));
  CHECK(is("2*(3 kg.m^2)", "kg.m^2", 6));
  CHECK(is("(200 W/(m.K))*(2 m)*(5 K)", "W", 2000));
  CHECK(is("0 + (3 mm)", "m", 3e-3));
  CHECK(is("50 % * 3 mm", "m", 1.5e-3));
}

TEST_CASE("Rows_AreSplitAtSpaces") {
  const std::vector<Quantity> row = evaluate_formulas("0 -(2500 N) 2*(3)", 3);
  CHECK(row[0].number == 0);
  CHECK(row[1].number == -2500);
  CHECK(row[1].unit == "N");
  CHECK(row[2].number == 6);
  const std::vector<Quantity> shared = evaluate_formulas("0 (3) 1 mm", 3);
  CHECK(shared[1].unit == "mm");
  CHECK_THROWS_AS((void)evaluate_formulas("0 1", 3), QuantityError);
}

TEST_CASE("InvalidFormula_IsReported") {
  CHECK(error_of("(3 mm") == "found '(3 mm'; expected numbers with units, + - * / ^ and parentheses");
  CHECK(error_of("2*t").starts_with("found '2*t'"));
  CHECK(error_of("").starts_with("found ''"));
  CHECK(error_of("1 2").starts_with("found '1 2'"));
  CHECK(error_of("(3 mm) + (2 s)").starts_with("found a time (s); expected a length (mm)"));
  CHECK(error_of("3 mm + 2").starts_with("found "));
  CHECK(error_of("2*(60 degC)") ==
        "found 'degC' in arithmetic; expected a unit whose zero is zero, such as K for degC");
  CHECK(error_of("2^(3 mm)").starts_with("found an exponent with the unit 'mm'"));
  CHECK(error_of("(3 mm)^0.5").starts_with("found the power 0.5"));
  CHECK(error_of("1/0").starts_with("found a value beyond all numbers"));
  CHECK(error_of("2*(3 mmm)").starts_with("found unknown unit 'mmm'"));
  CHECK(error_of(std::string(5000, '(')).starts_with("found '(((("));
  CHECK(error_of(std::string(5000, '-') + "1").starts_with("found '----"));
}

}  // namespace quantity_formula_test
}  // namespace hersey
