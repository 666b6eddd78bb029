// libFuzzer target: whatever the text, every way to read a quantity gives finite numbers or throws QuantityError, and a
// quantity that is read is the same in its SI unit. The first byte chooses what is asked for.
// seeds: libs/core/fuzz/seeds/quantities
// longest: 256
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "hersey/core/quantity_formula.h"
#include "hersey/core/units.h"

namespace {

void require(bool good) {
  if (!good) std::abort();
}

template <class Reading>
void attempt(Reading read) {
  try {
    read();
  } catch (const hersey::QuantityError&) {
    // the expected answer to nearly every input
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto& dimensions = hersey::dimensions();
  const std::string unit = dimensions[data[0] % dimensions.size()].si_unit;
  const std::string text(data + 1, data + size);
  attempt([&] {
    const double value = hersey::parse_quantity(text, unit);
    require(std::isfinite(value));
    require(hersey::convert_to_si({value, unit == "1" ? "" : unit}, unit) == value);
  });
  attempt([&] {
    for (const double value : hersey::parse_quantities(text, unit, 3)) require(std::isfinite(value));
  });
  attempt([&] { (void)hersey::convert(hersey::split_quantity(text), unit); });
  attempt([&] {
    const hersey::Quantity value = hersey::evaluate_formula(text);
    require(std::isfinite(value.number));
    (void)hersey::convert_to_si(value, unit);
  });
  attempt([&] { require(hersey::evaluate_formulas(text, 3).size() == 3); });
  return 0;
}
