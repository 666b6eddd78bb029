#include "option_value.h"

#include "hersey/core/input_error.h"
#include "hersey/core/units.h"

namespace hersey::cli {

double in_si(const char* option, const std::string& text, const char* unit) {
  try {
    return parse_quantity(text, unit);
  } catch (const QuantityError& error) {
    throw InputError(Fault{{"", 0, 0}, option, error.found, error.expected, error.suggestion});
  }
}

double length_unit(const std::string& text) {
  const bool has_number = text.find_first_of("0123456789") == 0;
  const double metres = in_si("--length-unit", has_number ? text : "1 " + text, "m");
  if (!(metres > 0)) throw InputError(Fault{{"", 0, 0}, "--length-unit", text, "a length > 0, such as mm", ""});
  return metres;
}

}  // namespace hersey::cli
