#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Conversion of quantities with units to SI numbers. No other part of the program converts units. All functions may be
/// called from several threads at once.
namespace hersey {

/// A text is not the expected quantity. The three parts are those of a `Fault`.
class QuantityError : public std::runtime_error {
 public:
  /// what() combines the three parts into one sentence.
  QuantityError(std::string found_text, std::string expected_text, std::string suggestion_text = {});
  std::string found;           ///< "a pressure (kPa)"
  std::string expected;        ///< "a length, such as 45 mm"
  std::string suggestion;      ///< "did you mean 'mm'?"; may be empty
  bool is_about_size = false;  ///< the unit is correct, but the number is larger than in any machine
};

/// Physical dimension and how users write it.
struct Dimension {
  std::string si_unit;               ///< SI unit as the program names it, "m"
  std::string name;                  ///< with article, "a length"
  std::string example;               ///< "45 mm"
  std::vector<std::string> spelled;  ///< usual units, for suggestions and the reference manual
  double largest = 0;  ///< magnitude in `si_unit` above which a value is taken for a mistake: far above that of any
                       ///< machine, far below overflow
};

/// Magnitude below which a value other than 0 is taken for a mistake, in the SI unit of any dimension: products and
/// quotients of two such values are still representable.
inline constexpr double smallest_quantity = 1e-100;

/// Returns all dimensions that the program knows.
[[nodiscard]] const std::vector<Dimension>& dimensions();

/// Returns the dimension with the SI unit `si_unit`, spelled as in `dimensions()`.
/// @throws ContractError if there is no such dimension.
[[nodiscard]] const Dimension& dimension_of(std::string_view si_unit);

/// Returns the SI unit of the dimension of `unit`, spelled as in `dimensions()`; the first one where several measure
/// the same. None if the unit is unknown, or no dimension of `dimensions()` is that of it.
[[nodiscard]] std::optional<std::string> si_unit_of(const std::string& unit);

/// True if two units measure the same where radians are left out or added freely, as other programs do: rad/s and 1/s,
/// N.m and N.m/rad. Not so for Hz, which counts turns: it measures what 1/s does, and not what rad/s does.
[[nodiscard]] bool measure_the_same_but_for_radians(const std::string& unit, const std::string& other);

/// Number and unit as written by the user.
struct Quantity {
  double number = 0;
  std::string unit;  ///< empty for a bare number
};

/// Splits "45 mm", "1e-3 1/Pa" or "500N" into number and unit.
/// @throws QuantityError unless the text begins with a finite number.
[[nodiscard]] Quantity split_quantity(std::string_view text);

/// Converts a text such as "45 mm" to the unit `si_unit` of `dimensions()`; "1" means a bare number (percent is
/// allowed). A bare 0 is valid for any quantity. Angles are distinguished from bare numbers: 3570 rpm and 10 deg/s are
/// angular velocities, 10 Hz and 10 1/s are not; the radian may be omitted only in torsional stiffness and damping (N.m
/// for N.m/rad).
/// @returns the value in `si_unit`, 0 or of a magnitude between `smallest_quantity` and Dimension::largest.
/// @throws QuantityError stating what was found (an unknown unit, another dimension, no unit) and what is expected.
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view si_unit);

/// Reads `count` numbers with a common unit, "0 48 0 mm", or a unit each, "0 48 mm 1 cm"; zeros and numbers with
/// si_unit "1" need no unit.
[[nodiscard]] std::vector<double> parse_quantities(std::string_view text, std::string_view si_unit, int count);

/// Returns the number of `quantity` converted to `si_unit`.
/// @throws QuantityError as parse_quantity.
[[nodiscard]] double convert_to_si(const Quantity& quantity, std::string_view si_unit);

/// Returns the number of `quantity` converted to `unit`.
/// @throws QuantityError unless both have the same dimension.
[[nodiscard]] double convert(const Quantity& quantity, const std::string& unit);

/// Returns the sum of two quantities. In sums, products, quotients and powers a bare number leaves the unit of the
/// other quantity unchanged; otherwise a sum is in the unit of the first quantity, and a product, quotient or power is
/// in the SI unit of its dimension (in base units if `dimensions()` has none). A bare 0 can be added to any quantity.
/// @throws QuantityError if summands differ in dimension, a unit is unknown or has an offset (degC), or the exponent of
/// a quantity with a unit is not an integer between -9 and 9.
[[nodiscard]] Quantity sum(const Quantity& a, const Quantity& b);
/// Returns the product of two quantities; see sum().
[[nodiscard]] Quantity product(const Quantity& a, const Quantity& b);
/// Returns the quotient of two quantities; see sum().
[[nodiscard]] Quantity quotient(const Quantity& a, const Quantity& b);
/// Returns a power of a quantity; see sum().
[[nodiscard]] Quantity power(const Quantity& base, double exponent);

}  // namespace hersey
