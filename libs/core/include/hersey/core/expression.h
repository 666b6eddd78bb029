#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "hersey/core/scalar_function.h"

namespace hersey {

/// An expression cannot be parsed.
class ExpressionError : public std::runtime_error {
 public:
  /// @param offset  position of the error in the expression, counted from 0
  ExpressionError(const std::string& message, int offset, std::string token)
      : std::runtime_error(message), position(offset), token_text(std::move(token)) {}
  int position;            ///< offset of the error in the expression, counted from 0
  std::string token_text;  ///< token at this position; empty at the end of the expression
};

/// Returns the identifiers of an expression that are neither functions nor constants, in order of first appearance.
/// Identifiers consist of letters, digits, `_` and `.`, such as "main.rotation".
[[nodiscard]] std::vector<std::string> variables_of(const std::string& expression);

/// An expression in named variables, such as "100*sin(2*pi*50*t)": + - * / ^, comparisons, && || ?:, and
/// sin cos tan asin acos atan atan2 sinh cosh tanh exp ln log10 log2 sqrt cbrt abs sign rint min max sum avg; pi, e.
///
/// Derivatives are central differences of eighth order whose step is widened until truncation shows above round-off:
/// about 1e-11 relative for smooth expressions, a one-sided mean at kinks.
/// @verified_by expression_test.cpp
class ExpressionFunction final : public ScalarFunction {
 public:
  /// @param variables  names of the variables in the order of the arguments of `value`.
  /// @param scale      factor on the result (a unit).
  /// @throws ExpressionError with the position of the first syntax error or unknown name.
  ExpressionFunction(const std::string& expression, std::vector<std::string> variables, double scale = 1);
  ~ExpressionFunction() override;

  /// Returns the value at `x`, one entry per variable; infinite or NaN where the expression is. May be called from
  /// several threads.
  [[nodiscard]] double value(std::span<const double> x) const override;
  void gradient(std::span<const double> x, std::span<double> gradient) const override;
  [[nodiscard]] double second_derivative(std::span<const double> x) const override;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace hersey
