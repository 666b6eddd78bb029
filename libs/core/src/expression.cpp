#include "hersey/core/expression.h"

#include <muParser.h>

#include <cctype>
#include <limits>
#include <mutex>
#include <set>

#include "hersey/core/contract.h"
#include "numerical_derivative.h"

namespace hersey {
namespace {

constexpr const char* name_characters = "0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.";

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }
bool starts_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// muParser reads "t = 3" as an assignment to the variable and "1, 2" as two results; neither is a function.
void reject_statements(const std::string& expression) {
  int depth = 0;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const char c = expression[i];
    const char before = i > 0 ? expression[i - 1] : ' ';
    const char after = i + 1 < expression.size() ? expression[i + 1] : ' ';
    if (c == '(') ++depth;
    if (c == ')') --depth;
    const bool compares = after == '=' || before == '=' || before == '<' || before == '>' || before == '!';
    if (c == '=' && !compares) {
      throw ExpressionError("'=' assigns; == compares", static_cast<int>(i), "=");
    }
    if (c == ',' && depth <= 0) {
      throw ExpressionError("',' outside of a function's arguments", static_cast<int>(i), ",");
    }
    if (c == '"') throw ExpressionError("text has no value", static_cast<int>(i), "\"");
  }
}

void define_constants(mu::Parser& parser) {
  parser.DefineNameChars(name_characters);
  parser.DefineConst("pi", 3.14159265358979323846);
  parser.DefineConst("e", 2.71828182845904523536);
}

/// Converts muParser's errors: removes "at position n" from the message and limits the position to the expression.
ExpressionError translated(const mu::Parser::exception_type& error, const std::string& expression) {
  const std::string token = error.GetToken();
  const int length = static_cast<int>(expression.size());
  // For some errors muParser returns a position behind the token or beyond the end; use that of the token if it can be
  // found.
  int position = error.GetPos();
  if (!token.empty()) {
    const auto last = expression.rfind(token, static_cast<std::size_t>(std::clamp(position, 0, length)));
    if (last != std::string::npos) position = static_cast<int>(last);
  }
  position = std::clamp(position, 0, length);
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return {"unknown name '" + token + "'", position, token};
    case mu::ecEMPTY_EXPRESSION:
      return {"empty expression", 0, ""};
    case mu::ecUNEXPECTED_EOF:
      return {"the expression ends too early", length, ""};
    case mu::ecMISSING_PARENS:
      return {"a parenthesis is not closed", length, ""};
    case mu::ecTOO_MANY_PARAMS:
      return {"too many arguments for '" + token + "'", position, token};
    case mu::ecTOO_FEW_PARAMS:
      return {"too few arguments for '" + token + "'", position, token};
    default:
      return {"'" + token + "' does not fit here", position, token};
  }
}

}  // namespace

std::vector<std::string> variables_of(const std::string& expression) {
  mu::Parser parser;
  define_constants(parser);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < expression.size();) {
    const bool inside_number = i > 0 && is_name_character(expression[i - 1]);
    if (!starts_name(expression[i]) || inside_number) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < expression.size() && is_name_character(expression[end])) ++end;
    std::string name = expression.substr(i, end - i);
    const bool known = parser.GetFunDef().contains(name) || parser.GetConst().contains(name) ||
                       std::find(names.begin(), names.end(), name) != names.end();
    if (!known) names.push_back(std::move(name));
    i = end;
  }
  return names;
}

/// muParser evaluates in its own buffers and reads the variables from fixed addresses; hence one evaluation at a time.
struct ExpressionFunction::Parser {
  mu::Parser parser;
  std::vector<double> arguments;
  std::mutex lock;
  double scale = 1;

  double evaluate(std::span<const double> x, std::size_t replaced, double replacement) {
    const std::lock_guard guard(lock);
    std::copy(x.begin(), x.end(), arguments.begin());
    if (replaced < arguments.size()) arguments[replaced] = replacement;
    return scale * parser.Eval();
  }
};

ExpressionFunction::ExpressionFunction(const std::string& expression, std::vector<std::string> variables, double scale)
    : parser_(std::make_unique<Parser>()) {
  HERSEY_REQUIRE(std::isfinite(scale), "a scale is a unit's factor");
  reject_statements(expression);
  parser_->scale = scale;
  parser_->arguments.assign(variables.size(), 0.0);
  try {
    define_constants(parser_->parser);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      parser_->parser.DefineVar(variables[i], &parser_->arguments[i]);
    }
    parser_->parser.SetExpr(expression);
    (void)parser_->parser.Eval();  // muParser parses at the first evaluation
  } catch (const mu::Parser::exception_type& error) {
    throw translated(error, expression);
  }
}

ExpressionFunction::~ExpressionFunction() = default;

double ExpressionFunction::value(std::span<const double> x) const {
  HERSEY_REQUIRE(x.size() == parser_->arguments.size(), "one argument per variable");
  return parser_->evaluate(x, x.size(), 0);
}

void ExpressionFunction::gradient(std::span<const double> x, std::span<double> gradient) const {
  HERSEY_REQUIRE(x.size() == parser_->arguments.size() && gradient.size() == x.size(), "one argument per variable");
  for (std::size_t i = 0; i < x.size(); ++i) {
    gradient[i] = derivative<1>([&](double xi) { return parser_->evaluate(x, i, xi); }, x[i]);
  }
}

double ExpressionFunction::second_derivative(std::span<const double> x) const {
  HERSEY_REQUIRE(x.size() == parser_->arguments.size(), "one argument per variable");
  if (x.empty()) return 0;
  return derivative<2>([&](double x0) { return parser_->evaluate(x, 0, x0); }, x[0]);
}

}  // namespace hersey
