#include "hersey/core/quantity_formula.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace hersey {
namespace {

constexpr int kDeepestFormula = 100;  // largest depth of nested parentheses and signs
constexpr const char* kExpected = "numbers with units, + - * / ^ and parentheses";

bool is_digit(char c) { return '0' <= c && c <= '9'; }
/// True for letters of any alphabet (µ, °, Å are several bytes of UTF-8) and the percent sign.
bool is_letter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_' || c == '%' ||
         static_cast<unsigned char>(c) >= 128;
}
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Parser by recursive descent with one method per precedence of operators.
class Formula {
 public:
  explicit Formula(std::string_view text) : text_(text) {}

  Quantity value() {
    const Quantity value = sum();
    skip_spaces();
    if (at_ != text_.size()) fail();
    return value;
  }

 private:
  Quantity sum() {
    Quantity value = product_of_factors();
    for (char sign = next(); sign == '+' || sign == '-'; sign = next()) {
      ++at_;
      Quantity summand = product_of_factors();
      if (sign == '-') summand.number = -summand.number;
      value = finite(hersey::sum(value, summand));
    }
    return value;
  }

  Quantity product_of_factors() {
    Quantity value = signed_power();
    for (char sign = next(); sign == '*' || sign == '/'; sign = next()) {
      ++at_;
      const Quantity factor = signed_power();
      value = finite(sign == '*' ? product(value, factor) : quotient(value, factor));
    }
    return value;
  }

  Quantity signed_power() {
    const Level level(*this);
    const char sign = next();
    if (sign != '+' && sign != '-') return power_of_atom();
    ++at_;
    Quantity value = signed_power();
    if (sign == '-') value.number = -value.number;
    return value;
  }

  // The exponent may have a sign, and a power of its own: 2^3^2 is 2^9.
  Quantity power_of_atom() {
    const Quantity base = atom();
    if (next() != '^') return base;
    ++at_;
    const Quantity exponent = signed_power();
    if (!exponent.unit.empty()) {
      throw QuantityError("an exponent with the unit '" + exponent.unit + "'", "a bare number");
    }
    return finite(power(base, exponent.number));
  }

  Quantity atom() {
    const char first = next();
    if (first == '(') {
      const Level level(*this);
      ++at_;
      Quantity value = sum();
      if (next() != ')') fail();
      ++at_;
      const std::string unit = take_unit();
      return unit.empty() ? value : finite(product(value, {1, unit}));
    }
    if (is_word("pi")) {
      at_ += 2;
      return {std::numbers::pi, take_unit()};
    }
    Quantity value;
    const char *begin = text_.data() + at_, *end = text_.data() + text_.size();
    if (!is_digit(first) && first != '.') fail();
    const auto [rest, error] = std::from_chars(begin, end, value.number);
    if (error == std::errc::invalid_argument) fail();
    if (error == std::errc::result_out_of_range) value.number = std::numeric_limits<double>::infinity();
    at_ += static_cast<std::size_t>(rest - begin);
    value.unit = take_unit();
    return finite(value);
  }

  /// Reads the unit at the present position, empty if there is none. The header defines where a unit ends.
  std::string take_unit() {
    const char first = next();
    const bool is_inverse =
        first == '1' && at_ + 2 < text_.size() && text_[at_ + 1] == '/' && is_letter(text_[at_ + 2]);
    if ((!is_letter(first) && !is_inverse) || is_word("pi")) return {};
    const std::size_t begin = at_;
    at_ += is_inverse ? 2 : 0;
    while (at_ < text_.size() && continue_unit()) {
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  /// Advances over the next part of a unit; returns false if there is none.
  bool continue_unit() {
    const char c = text_[at_];
    if (is_letter(c) || is_digit(c)) return ++at_, true;
    std::size_t after = at_ + 1;
    const auto letter_follows = [&] {
      return after < text_.size() && is_letter(text_[after]) && !is_word("pi", after);
    };
    if (c == '^' || ((c == '-' || c == '+') && is_letter(text_[at_ - 1]))) {  // m^2, m^-2, s-1
      if (c == '^' && after < text_.size() && (text_[after] == '-' || text_[after] == '+')) ++after;
      if (after >= text_.size() || !is_digit(text_[after])) return false;
      return at_ = after + 1, true;
    }
    if (c == '.' && letter_follows()) return at_ = after, true;
    if (c == '/' || c == '*' || is_space(c)) {
      while (is_space(c) && after < text_.size() && is_space(text_[after])) ++after;
      if (letter_follows()) return at_ = after, true;
      return c == '/' && take_group(after);
    }
    return false;
  }

  /// Advances over a group of units in the denominator, as in W/(m.K).
  bool take_group(std::size_t open) {
    if (open + 1 >= text_.size() || text_[open] != '(' || !is_letter(text_[open + 1])) return false;
    const std::size_t close = text_.find(')', open);
    if (close == std::string_view::npos || text_.find('(', open + 1) < close) return false;
    return at_ = close + 1, true;
  }

  bool is_word(std::string_view word) { return is_word(word, at_); }
  bool is_word(std::string_view word, std::size_t at) const {
    if (text_.substr(at, word.size()) != word) return false;
    const std::size_t after = at + word.size();
    return after >= text_.size() || (!is_letter(text_[after]) && !is_digit(text_[after]));
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  /// Returns the next character that is no space; 0 at the end.
  char next() {
    skip_spaces();
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  static Quantity finite(const Quantity& value) {
    if (!std::isfinite(value.number)) throw QuantityError("a value beyond all numbers", "a finite number");
    return value;
  }

  [[noreturn]] void fail() const { throw QuantityError("'" + std::string(text_) + "'", kExpected); }

  class Level {
   public:
    explicit Level(Formula& formula) : depth_(formula.depth_) {
      if (++depth_ > kDeepestFormula) {
        --depth_;
        formula.fail();
      }
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --depth_; }

   private:
    int& depth_;
  };

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// True if a word begins the next formula of a row; a unit or an operator continues the present one.
bool opens_formula(std::string_view word) {
  const bool is_inverse_unit = word.size() > 2 && word.starts_with("1/") && is_letter(word[2]);
  const char first = word.front();
  return !is_inverse_unit && (is_digit(first) || first == '.' || first == '(' || first == '+' || first == '-');
}

/// Splits at spaces outside of parentheses; words that begin no formula belong to the one before.
std::vector<std::string> split_formulas(std::string_view text) {
  std::vector<std::string> formulas;
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    for (int depth = 0; end < text.size() && (depth > 0 || !is_space(text[end])); ++end) {
      if (text[end] == '(') ++depth;
      if (text[end] == ')') --depth;
    }
    const std::string_view word = text.substr(at, end - at);
    if (formulas.empty() || opens_formula(word)) {
      formulas.emplace_back(word);
    } else {
      formulas.back() += " " + std::string(word);
    }
    at = end;
  }
  return formulas;
}

}  // namespace

Quantity evaluate_formula(std::string_view text) { return Formula(text).value(); }

std::vector<Quantity> evaluate_formulas(std::string_view text, int count) {
  if (count == 1) return {evaluate_formula(text)};
  std::vector<Quantity> values;
  for (const std::string& formula : split_formulas(text)) values.push_back(evaluate_formula(formula));
  if (static_cast<int>(values.size()) != count) {
    throw QuantityError("'" + std::string(text) + "'", std::to_string(count) + " numbers");
  }
  for (std::size_t i = values.size() - 1; i > 0; --i) {
    if (values[i - 1].unit.empty()) values[i - 1].unit = values[i].unit;
  }
  return values;
}

}  // namespace hersey
