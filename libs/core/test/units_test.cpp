#include "hersey/core/units.h"

#include <doctest/doctest.h>

#include <numbers>
#include <thread>

namespace hersey {
namespace units_test {

constexpr double pi = std::numbers::pi;
// The database's factors are decimal fractions converted in two or three roundings.
constexpr double rounding = 1e-14;

void check_quantity(const char* text, const char* si_unit, double expected) {
  CAPTURE(text);
  CHECK(parse_quantity(text, si_unit) == doctest::Approx(expected).epsilon(rounding));
}

QuantityError error_of(const std::string& text, const std::string& si_unit) {
  try {
    (void)parse_quantity(text, si_unit);
  } catch (const QuantityError& error) {
    return error;
  }
  FAIL("'" << text << "' was accepted");
  return {"", ""};
}

TEST_CASE("SiUnit_IsThatOfTheDimension") {
  CHECK(si_unit_of("rpm") == "rad/s");
  CHECK(si_unit_of("kg.m-1.s-2") == "Pa");
  CHECK(si_unit_of("degC") == "K");
  CHECK(si_unit_of("percent") == "1");
  CHECK(si_unit_of("kg.m2.s-2") == si_unit_of("N.m"));
  CHECK(!si_unit_of("T"));
  CHECK(!si_unit_of("bananas"));
  CHECK(!si_unit_of(""));
}

TEST_CASE("Units_MeasureTheSameWithRadiansLeftOutButForHz") {
  CHECK(measure_the_same_but_for_radians("rad/s", "s-1"));
  CHECK(measure_the_same_but_for_radians("1/s", "rpm"));
  CHECK(measure_the_same_but_for_radians("N.m", "kg.m2.s-2.rad-1"));
  CHECK(measure_the_same_but_for_radians("rad", "1"));
  CHECK(measure_the_same_but_for_radians("Hz", "1/s"));
  CHECK(!measure_the_same_but_for_radians("Hz", "rad/s"));
  CHECK(!measure_the_same_but_for_radians("N.m", "N"));
  CHECK(!measure_the_same_but_for_radians("rad/s", "s"));
  CHECK(!measure_the_same_but_for_radians("bananas", "bananas"));
  CHECK(!measure_the_same_but_for_radians("", ""));
}

TEST_CASE("SizesThatNoMachineHas_AreRefusedInEveryDimension") {
  for (const Dimension& dimension : dimensions()) {
    CAPTURE(dimension.name);
    const std::string unit = dimension.si_unit == "1" ? "" : " " + dimension.si_unit;
    for (const std::string number : {"1e300", "-1e300", "1e-300", "-1e-300"}) {
      if (dimension.si_unit == "K" && number.find("e-") != std::string::npos) continue;  // an offset drowns it
      const QuantityError error = error_of(number + unit, dimension.si_unit);
      CHECK(error.is_about_size);
      CHECK(error.expected.find(dimension.name) == 0);
    }
    CHECK(parse_quantity("0" + unit, dimension.si_unit) == 0);
    // Usual values are thousands of times smaller than refused ones.
    CHECK(parse_quantity(dimension.example, dimension.si_unit) < 1e-3 * dimension.largest);
  }
  CHECK(error_of("1e308 mm", "m").found == "1e+305 m");
  CHECK(error_of("1e308 mm", "m").expected == "a length of at most 1e+06 m in size");
  CHECK(error_of("-1e-200 N", "N").expected == "a force, 0 or of at least 1e-100 N in size");
}

TEST_CASE("Quantities_AreConvertedToSI") {
  check_quantity("45 mm", "m", 0.045);
  check_quantity("34um", "m", 34e-6);
  check_quantity("34 µm", "m", 34e-6);
  check_quantity("15 mPa.s", "Pa.s", 0.015);
  check_quantity("4 mm²", "m^2", 4e-6);
  check_quantity("5 N·m", "N.m", 5);
  check_quantity("5 kg m^2", "kg.m^2", 5);
  check_quantity("15 cP", "Pa.s", 0.015);
  check_quantity("1.28e-10 1/Pa", "1/Pa", 1.28e-10);
  check_quantity("1e-3 1/MPa", "1/Pa", 1e-9);
  check_quantity("20 cSt", "m^2/s", 20e-6);
  check_quantity("2 bar", "Pa", 2e5);
  check_quantity("57 N/mm^2", "Pa", 57e6);
  check_quantity("5 N.m", "N.m", 5);
  check_quantity("5 Nm", "N.m", 5);
  check_quantity("-2500 N", "N", -2500);
  check_quantity("+1 kN", "N", 1000);
  check_quantity("850 kg/m^3", "kg/m^3", 850);
  check_quantity("0.5 l/min", "m^3/s", 0.5e-3 / 60);
  check_quantity("20 bar.min/l", "Pa.s/m^3", 20 * 1e5 * 60 * 1e3);
  check_quantity("60 degC", "K", 333.15);
  check_quantity("0.25", "1", 0.25);
  check_quantity("25 %", "1", 0.25);
  check_quantity("  7 s ", "s", 7);
}

TEST_CASE("Rotations_CountTheRadian") {
  check_quantity("3570 rpm", "rad/s", 3570 * 2 * pi / 60);  // 373.85 rad/s
  check_quantity("60 rev/min", "rad/s", 2 * pi);
  check_quantity("180 deg/s", "rad/s", pi);
  check_quantity("720 deg", "rad", 4 * pi);
  check_quantity("2 rev", "rad", 4 * pi);
  check_quantity("1.5 rad", "rad", 1.5);
  check_quantity("1 N.m/deg", "N.m/rad", 180 / pi);
  check_quantity("3 N.m", "N.m/rad", 3);
  check_quantity("3 N.m.s", "N.m.s/rad", 3);
  // A frequency is not an angular velocity: 10 Hz would silently become 10 rad/s instead of 62.8.
  CHECK(error_of("10 Hz", "rad/s").found == "a frequency (Hz)");
  CHECK(error_of("10 1/s", "rad/s").found == "a frequency (1/s)");
  CHECK(error_of("50 Hz", "s").found == "a frequency (Hz)");  // not its reciprocal
  CHECK(error_of("3570 rpm", "Hz").found == "an angular velocity (rpm)");
  CHECK(error_of("5 deg", "1").found == "an angle (deg)");
}

TEST_CASE("BareZero_IsAnyQuantity") {
  check_quantity("0", "m", 0);
  check_quantity("0.0", "K", 0);
  CHECK(parse_quantities("0 0 0", "m", 3) == std::vector<double>{0, 0, 0});
}

TEST_CASE("Vectors_ShareOneUnit") {
  CHECK(parse_quantities("0 48 -1e3 mm", "m", 3) == std::vector<double>{0, 0.048, -1});
  CHECK(parse_quantities("0 0 1", "1", 3) == std::vector<double>{0, 0, 1});
  CHECK(parse_quantities("0 -2500 N 0 N", "N", 3) == std::vector<double>{0, -2500, 0});
  CHECK(parse_quantities("1 m 2 3 mm", "m", 3) == std::vector<double>{1, 0.002, 0.003});
  CHECK_THROWS_AS((void)parse_quantities("1 m 2 mm 3", "m", 3), QuantityError);
  CHECK_THROWS_WITH_AS((void)parse_quantities("0 48 mm", "m", 3),
                       "found '0 48 mm'; expected 3 numbers and a unit of length, such as 0 0 45 mm", QuantityError);
  CHECK_THROWS_WITH_AS((void)parse_quantities("0 48 0 1 mm", "m", 3),
                       "found '0 48 0 1 mm'; expected 3 numbers and a unit of length, such as 0 0 45 mm",
                       QuantityError);
  CHECK_THROWS_WITH_AS((void)parse_quantities("1 0", "1", 3), "found '1 0'; expected 3 numbers, such as 0 0 1",
                       QuantityError);
  CHECK_THROWS_WITH_AS((void)parse_quantities("0 1 0", "m", 3),
                       "found a number without unit; expected a length, such as 45 mm", QuantityError);
}

TEST_CASE("WrongQuantities_AreNamed") {
  const QuantityError pressure = error_of("45 kPa", "m");
  CHECK(pressure.found == "a pressure (kPa)");
  CHECK(pressure.expected == "a length, such as 45 mm");
  CHECK(error_of("45", "m").found == "a number without unit");
  CHECK(error_of("45 kg.K", "m").found == "a quantity in kg.K");
  const QuantityError unknown = error_of("45 mn", "m");
  CHECK(unknown.found == "unknown unit 'mn'");
  CHECK(unknown.suggestion == "did you mean 'mm'?");
  CHECK(error_of("2 mpa", "Pa").suggestion == "did you mean 'MPa'?");
  CHECK(error_of("wide", "m").found == "'wide'");
  CHECK(error_of("", "m").found == "''");
  CHECK(error_of("nan m", "m").expected == "a finite number");
  CHECK(error_of("inf m", "m").expected == "a finite number");
  CHECK(error_of("1e999 m", "m").expected == "a finite number");
  CHECK(error_of("1e300 Pm", "m").expected == "a finite number");  // overflows in the conversion only
  CHECK(error_of("45 3 mm", "m").found == "'45 3 mm'");            // udunits2 takes "3 mm" for a unit
  CHECK(error_of("3-4 mm", "m").found == "unknown unit '-4 mm'");
  CHECK(error_of("1,5 mm", "m").suggestion == "write 1.5 mm");
}

TEST_CASE("EveryDimension_ReadsItsOwnExampleAndUnits") {
  for (const Dimension& dimension : dimensions()) {
    CAPTURE(dimension.si_unit);
    CHECK_NOTHROW((void)parse_quantity(dimension.example, dimension.si_unit));
    for (const std::string& unit : dimension.spelled)
      CHECK_NOTHROW((void)parse_quantity("1 " + unit, dimension.si_unit));
    if (dimension.si_unit != "1") CHECK(parse_quantity("1 " + dimension.si_unit, dimension.si_unit) == 1);
  }
}

TEST_CASE("Conversion_BetweenUnitsOfOneDimension") {
  CHECK(convert({1, "kN"}, "N") == doctest::Approx(1000).epsilon(rounding));
  CHECK(convert({34, "um"}, "mm") == doctest::Approx(0.034).epsilon(rounding));
  CHECK(convert({3, ""}, "") == 3);
  CHECK_THROWS_WITH_AS((void)convert({1, "N"}, "mm"), "found a force (N); expected a length (mm)", QuantityError);
  CHECK_THROWS_AS((void)convert({1, "nosuch"}, "mm"), QuantityError);
}

TEST_CASE("Products_AreSpelledInTheUnitOfTheirDimension") {
  const auto unit_of = [](const char* a, const char* b) { return product(split_quantity(a), split_quantity(b)).unit; };
  CHECK(unit_of("60 rad/s", "0.5 s") == "rad");
  CHECK(unit_of("2 kN", "30 mm") == "N.m");
  CHECK(unit_of("3 mm", "1 kg") == "kg.m");
  CHECK(quotient(split_quantity("10 rev"), split_quantity("2 s")).unit == "rad/s");
  CHECK(quotient(split_quantity("1 m/s"), split_quantity("1 mm")).unit == "1/s");
  CHECK(power(split_quantity("2 mm"), 5).unit == "m5");  // no dimension of ours
  for (const Dimension& dimension : dimensions()) {
    if (dimension.si_unit == "1") continue;
    CAPTURE(dimension.si_unit);
    const Quantity once = power({3, dimension.si_unit}, 1);
    CHECK(once.number == 3);
    CHECK(convert_to_si(once, dimension.si_unit) == 3);
  }
}

TEST_CASE("Units_AreReadFromSeveralThreads") {
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  threads.reserve(wrong.size());
  for (int& count : wrong) {
    threads.emplace_back([&count] {
      for (int i = 0; i < 200; ++i) {
        if (std::abs(parse_quantity("45 mm", "m") - 0.045) > 1e-15) ++count;
        try {
          (void)parse_quantity("45 nosuch", "m");
          ++count;
        } catch (const QuantityError& error) {
          if (error.found != "unknown unit 'nosuch'") ++count;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) CHECK(count == 0);
}

}  // namespace units_test
}  // namespace hersey
