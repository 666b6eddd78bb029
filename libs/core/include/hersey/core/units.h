#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Quantities with units at the door: the only place where units are converted. All functions may be called from
/// several threads at once.
namespace hersey {

/// A text is not the quantity asked for. The three parts are those of a `Fault`.
class QuantityError : public std::runtime_error {
 public:
  /// what() puts the three parts into one sentence.
  QuantityError(std::string found_text, std::string expected_text, std::string suggestion_text = {});
  std::string found;           ///< "a pressure (kPa)"
  std::string expected;        ///< "a length, such as 45 mm"
  std::string suggestion;      ///< "did you mean 'mm'?"; may be empty
  bool is_about_size = false;  ///< the unit is right, the number is beyond what any machine has
};

/// What a unit measures, and how users write it.
struct Dimension {
  std::string si_unit;               ///< as the program names it, "m"
  std::string name;                  ///< with article, "a length"
  std::string example;               ///< "45 mm"
  std::vector<std::string> spelled;  ///< usual units, for suggestions and the reference
  double largest = 0;  ///< size in `si_unit` beyond which a value is a slip: far above any machine, far below overflow
};

/// Size below which a value other than 0 is a slip, in the SI unit of any dimension: products and quotients of two such
/// values still are numbers.
inline constexpr double smallest_quantity = 1e-100;

/// Every dimension the program knows.
[[nodiscard]] const std::vector<Dimension>& dimensions();

/// The dimension with the SI unit `si_unit`, spelled as in `dimensions()`.
/// @throws ContractError if there is none.
[[nodiscard]] const Dimension& dimension_of(std::string_view si_unit);

/// A number and its unit, as written.
struct Quantity {
  double number = 0;
  std::string unit;  ///< empty for a bare number
};

/// Splits "45 mm", "1e-3 1/Pa" or "500N" into number and unit.
/// @throws QuantityError unless the text begins with a finite number.
[[nodiscard]] Quantity split_quantity(std::string_view text);

/// Reads "45 mm" in the unit `si_unit` of `dimensions()`; "1" asks for a bare number (percent is allowed).
///
/// A bare 0 is any quantity. An angle is told from a bare number: 3570 rpm and 10 deg/s are angular velocities, 10 Hz
/// and 10 1/s are not; only torsional stiffness and damping may drop the radian (N.m for N.m/rad).
/// @returns the value in `si_unit`, 0 or in size between `smallest_quantity` and Dimension::largest.
/// @throws QuantityError telling what was found (an unknown unit, another dimension, no unit) and what is expected.
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view si_unit);

/// Reads `count` numbers with one unit, "0 48 0 mm", or one each, "0 48 mm 1 cm"; none for zeros or si_unit "1".
[[nodiscard]] std::vector<double> parse_quantities(std::string_view text, std::string_view si_unit, int count);

/// `number` in `unit`, converted to `si_unit`.
/// @throws QuantityError as parse_quantity.
[[nodiscard]] double convert_to_si(const Quantity& quantity, std::string_view si_unit);

/// `quantity` in `unit`, whatever both measure.
/// @throws QuantityError unless both measure the same.
[[nodiscard]] double convert(const Quantity& quantity, const std::string& unit);

/// Sum, product, quotient and power of quantities. A partner without unit leaves the other's unit as it is; otherwise
/// sums are in the unit of the first, products, quotients and powers in the SI unit of their dimension (base units
/// where `dimensions()` has none). A bare 0 adds to anything.
/// @throws QuantityError where summands do not measure the same, units are unknown or begin elsewhere than at zero
/// (degC), or a quantity with a unit is raised to no integer between -9 and 9.
[[nodiscard]] Quantity sum(const Quantity& a, const Quantity& b);
/// See sum().
[[nodiscard]] Quantity product(const Quantity& a, const Quantity& b);
/// See sum().
[[nodiscard]] Quantity quotient(const Quantity& a, const Quantity& b);
/// See sum().
[[nodiscard]] Quantity power(const Quantity& base, double exponent);

}  // namespace hersey
