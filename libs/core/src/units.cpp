#include "hersey/core/units.h"

#include <pthread.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>

#include "hersey/core/contract.h"
#include "hersey/core/spelling.h"
#include "hersey/core/unit_database.h"

// All zeros, which is PTHREAD_MUTEX_INITIALIZER on Linux. Only the assembler can define a symbol that is unique in the
// process with every compiler.
extern "C" pthread_mutex_t hersey_udunits2_lock;
static_assert(sizeof(pthread_mutex_t) <= 64);
__asm__(
    ".pushsection .bss.hersey_udunits2_lock,\"aw\",%nobits\n"
    ".balign 16\n"
    ".type hersey_udunits2_lock,%gnu_unique_object\n"
    ".size hersey_udunits2_lock,64\n"
    "hersey_udunits2_lock: .zero 64\n"
    ".popsection\n");

namespace hersey {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

constexpr const char* kInstalled = "/usr/share/xml/udunits/udunits2.xml";

/// Several copies of this library in one process, for example those of two FMUs, share udunits2, which does not support
/// threads. They therefore share one lock: a symbol that the loader binds to the same address in all copies.
class ProcessLock {
 public:
  void lock() { ::pthread_mutex_lock(&hersey_udunits2_lock); }
  void unlock() { ::pthread_mutex_unlock(&hersey_udunits2_lock); }
};

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

struct UnitDeleter {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, UnitDeleter>;

/// Unit system of this copy of the library. Every use holds the lock, because udunits2 keeps its state and its last
/// error in global variables.
class UnitSystem {
 public:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    read();
    if (system_ == nullptr) {
      throw std::runtime_error(
          "the unit database of udunits2 cannot be read: install libudunits2-data, or set UDUNITS2_XML_PATH to its "
          "udunits2.xml");
    }
    // Spellings usual in this field that the database lacks.
    add("deg", "arc_degree");
    add("rev", "turn");
    add("cP", "0.01 poise");
    add("Nm", "N.m");
    add("Nmm", "N.mm");
  }

  [[nodiscard]] Unit parse(const std::string& text) const { return Unit(ut_parse(system_, text.c_str(), UT_UTF8)); }

  /// Parses a unit as users write it. udunits2 would also accept "3 mm" and "-4 mm" as units, which contain a number.
  [[nodiscard]] Unit parse_written(const std::string& text) const {
    const bool begins_as_number = text.find_first_of("+-.0123456789") == 0;
    if (begins_as_number && text != "1" && !text.starts_with("1/")) return nullptr;
    return parse(text);
  }

  static ProcessLock& lock() {
    static ProcessLock of_process;
    return of_process;
  }

  /// Returns the database given, otherwise that of the environment, otherwise that of the installation; see
  /// unit_database.h.
  static std::vector<std::filesystem::path> candidates() {
    std::vector<std::filesystem::path> files;
    if (!given().empty()) files.push_back(given());
    if (const char* named = std::getenv("UDUNITS2_XML_PATH"); named != nullptr && *named != '\0')
      files.emplace_back(named);
    files.emplace_back(kInstalled);
    return files;
  }

  /// Call with the lock held.
  static std::filesystem::path& given() {
    static std::filesystem::path file;
    return file;
  }
  /// Call with the lock held.
  static std::filesystem::path& in_use() {
    static std::filesystem::path file;
    return file;
  }

  /// Call with the lock held. The system exists until the process ends, since releasing it at exit has no benefit.
  static const UnitSystem& instance() {
    static const UnitSystem system;
    return system;
  }

 private:
  void read() {
    for (const std::filesystem::path& file : candidates()) {
      if ((system_ = ut_read_xml(file.c_str())) == nullptr) continue;
      in_use() = file;
      return;
    }
    system_ = ut_read_xml(nullptr);  // path compiled into another installation of udunits2
  }

  void add(const char* symbol, const char* meaning) {
    const Unit unit = parse(meaning);
    HERSEY_REQUIRE(unit != nullptr, "the unit database defines what our spellings stand for");
    ut_map_symbol_to_unit(symbol, UT_UTF8, unit.get());
  }

  ut_system* system_ = nullptr;
};

/// Returns the base units of `unit`, such as "m.kg.s-2.rad", without factor and offset. Two units have the same
/// dimension if these texts are equal; udunits2's own test also accepts reciprocals (50 Hz for a time) and takes the
/// radian for 1.
std::string base_units(const ut_unit* unit) {
  std::array<char, 256> buffer{};
  const int length = ut_format(unit, buffer.data(), buffer.size(), UT_ASCII | UT_DEFINITION);
  if (length < 0 || length >= static_cast<int>(buffer.size())) return "?";
  std::string_view text(buffer.data(), static_cast<std::size_t>(length));
  text = text.substr(0, text.find(" @"));
  double factor = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), factor).ptr;
  if (end != text.data()) text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (text.starts_with(' ')) text.remove_prefix(1);
  return text == "1" ? "" : std::string(text);
}

bool measure_the_same(const ut_unit* given, const ut_unit* wanted) {
  return ut_are_convertible(given, wanted) != 0 && base_units(given) == base_units(wanted);
}

/// Base units but the radian.
std::string without_radians(const ut_unit* unit) {
  const std::string base = base_units(unit);
  std::string text;
  for (std::size_t at = 0; at < base.size();) {
    const std::size_t end = std::min(base.find('.', at), base.size());
    const std::string factor = base.substr(at, end - at);
    if (!factor.starts_with("rad")) text += (text.empty() ? "" : ".") + factor;
    at = end + 1;
  }
  return text;
}

/// A torsional stiffness per radian is commonly written N.m: the radian may be omitted there and nowhere else.
bool is_accepted(const ut_unit* given, const ut_unit* wanted, std::string_view si_unit) {
  if (measure_the_same(given, wanted)) return true;
  const bool torsional = si_unit == "N.m/rad" || si_unit == "N.m.s/rad";
  return torsional && base_units(given) + ".rad-1" == base_units(wanted);
}

/// Returns "a pressure (kPa)", or "a quantity in xyz" for dimensions without a name in `dimensions()`.
std::string name_of(const UnitSystem& system, const ut_unit* unit, const std::string& text) {
  for (const Dimension& dimension : dimensions()) {
    if (measure_the_same(unit, system.parse(dimension.si_unit).get())) return dimension.name + " (" + text + ")";
  }
  return "a quantity in " + text;
}

/// Returns a unit that may be a factor: it is known and has no offset.
Unit factor_unit(const UnitSystem& system, const std::string& text) {
  Unit unit = text.empty() ? system.parse("1") : system.parse_written(text);
  if (!unit) throw QuantityError("unknown unit " + in_quotes(text), "a unit such as mm or N/mm^2");
  std::array<char, 256> buffer{};
  const int length = ut_format(unit.get(), buffer.data(), buffer.size(), UT_ASCII | UT_DEFINITION);
  const bool is_plain =
      length >= 0 && length < static_cast<int>(buffer.size()) &&
      std::string_view(buffer.data(), static_cast<std::size_t>(length)).find_first_of("@(") == std::string_view::npos;
  if (!is_plain)
    throw QuantityError(in_quotes(text) + " in arithmetic", "a unit whose zero is zero, such as K for degC");
  return unit;
}

struct ConverterDeleter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Converter = std::unique_ptr<cv_converter, ConverterDeleter>;

/// Converters of units that have been accepted: a model has thousands of quantities in a few units, and reading a unit
/// takes twenty times as long as converting a number. Used with the lock held.
class KnownConverters {
 public:
  /// Null for units that have not been accepted before.
  [[nodiscard]] const cv_converter* find(const std::string& unit, std::string_view si_unit) const {
    const auto target = known_.find(si_unit);
    if (target == known_.end()) return nullptr;
    const auto found = target->second.find(unit);
    return found == target->second.end() ? nullptr : found->second.get();
  }
  const cv_converter* add(const std::string& unit, std::string_view si_unit, Converter converter) {
    constexpr std::size_t kMost = 1000;  // of each dimension: they come from files
    auto& units = known_[std::string(si_unit)];
    if (units.size() >= kMost) units.clear();
    return (units[unit] = std::move(converter)).get();
  }

 private:
  std::map<std::string, std::map<std::string, Converter>, std::less<>> known_;
};

/// Call with the lock held.
KnownConverters& known_converters() {
  static KnownConverters* const known = new KnownConverters;  // like the unit system never released
  return *known;
}

Converter converter_between(const ut_unit* from, const ut_unit* to) {
  Converter converter(ut_get_converter(const_cast<ut_unit*>(from), const_cast<ut_unit*>(to)));
  HERSEY_REQUIRE(converter != nullptr, "units that measure the same convert");
  return converter;
}

double converted(const ut_unit* from, const ut_unit* to, double number) {
  return cv_convert_double(converter_between(from, to).get(), number);
}

std::string expectation(const Dimension& dimension) { return dimension.name + ", such as " + dimension.example; }

std::string expectation_of_several(const Dimension& dimension, int count) {
  const std::string numbers = std::to_string(count) + " numbers";
  if (dimension.si_unit == "1") return numbers + ", such as 0 0 1";
  const std::string bare_name = dimension.name.substr(dimension.name.find(' ') + 1);
  return numbers + " and a unit of " + bare_name + ", such as 0 0 " + dimension.example;
}

/// Reads one number at the front of `text` and removes it; a digit group that belongs to a unit (the 1 of "1/Pa") is
/// left alone. Returns false if there is no number.
bool take_number(std::string_view& text, double& number) {
  std::string_view rest = trimmed(text);
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::invalid_argument) return false;
  if (end != rest.data() + rest.size() && *end == '/') return false;
  if (error == std::errc::result_out_of_range) number = std::numeric_limits<double>::infinity();
  text = std::string_view(end, static_cast<std::size_t>(rest.data() + rest.size() - end));
  return true;
}

void require_finite(double number, std::string_view text) {
  if (!std::isfinite(number)) throw QuantityError(in_quotes(text), "a finite number");
}

/// Returns a value and its unit for messages, such as "1e+308 m".
std::string shown(double value, const std::string& unit) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%g", value);
  return unit == "1" ? buffer.data() : buffer.data() + (" " + unit);
}

/// A value larger than in any machine is taken for a mistake: computations with it overflow or do not end.
void require_meant(double value, const Dimension& dimension) {
  const double size = std::abs(value);
  if (value == 0 || (size >= smallest_quantity && size <= dimension.largest)) return;
  const bool is_large = size > dimension.largest;
  QuantityError error(shown(value, dimension.si_unit),
                      dimension.name + (is_large ? " of at most " : ", 0 or of at least ") +
                          shown(is_large ? dimension.largest : smallest_quantity, dimension.si_unit) + " in size");
  error.is_about_size = true;
  throw error;
}

void reject_decimal_comma(std::string_view unit, std::string_view text) {
  if (!unit.starts_with(',')) return;
  std::string remedy(text);
  remedy[remedy.find(',')] = '.';
  throw QuantityError(in_quotes(text), "a decimal point", "write " + remedy);
}

/// Removes the words of a unit from the front of `text`, up to the next number.
std::string take_unit(std::string_view& text) {
  std::string unit;
  bool may_be_number = text.empty() || text.front() == ' ' || text.front() == '\t';
  for (text = trimmed(text); !text.empty(); text = trimmed(text), may_be_number = true) {
    std::string_view probe = text;
    double number = 0;
    if (may_be_number && take_number(probe, number)) break;
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    unit += (unit.empty() ? "" : " ") + std::string(word);
    text.remove_prefix(word.size());
  }
  return unit;
}

/// Splits "0 -2500 N 0 N" or "0 48 0 mm" into numbers with units; a number without unit takes the next one given.
/// @throws QuantityError unless the text is `count` finite numbers; `expected` is the second part of its message.
std::vector<Quantity> split_quantities(std::string_view given, int count, const std::string& expected) {
  const std::string_view text = trimmed(given);
  std::vector<Quantity> parts;
  for (std::string_view rest = text; !rest.empty();) {
    Quantity part;
    if (!take_number(rest, part.number)) throw QuantityError(in_quotes(text), expected);
    require_finite(part.number, text);
    part.unit = take_unit(rest);
    reject_decimal_comma(part.unit, text);
    parts.push_back(std::move(part));
  }
  if (static_cast<int>(parts.size()) != count) throw QuantityError(in_quotes(text), expected);
  for (std::size_t i = parts.size() - 1; i > 0; --i) {
    if (parts[i - 1].unit.empty()) parts[i - 1].unit = parts[i].unit;
  }
  return parts;
}

}  // namespace

void use_unit_database(const std::filesystem::path& database) {
  std::error_code ignored;
  if (!std::filesystem::exists(database, ignored)) return;
  const std::lock_guard guard(UnitSystem::lock());
  if (UnitSystem::in_use().empty()) UnitSystem::given() = database;
}

std::filesystem::path unit_database() {
  const std::lock_guard guard(UnitSystem::lock());
  if (!UnitSystem::in_use().empty()) return UnitSystem::in_use();
  std::error_code ignored;
  for (const std::filesystem::path& file : UnitSystem::candidates())
    if (std::filesystem::exists(file, ignored)) return file;
  return {};
}

std::optional<std::string> si_unit_of(const std::string& unit) {
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const Unit given = system.parse_written(unit);
  if (given == nullptr || unit.empty()) return std::nullopt;
  for (const Dimension& dimension : dimensions())
    if (measure_the_same(given.get(), system.parse(dimension.si_unit).get())) return dimension.si_unit;
  return std::nullopt;
}

bool measure_the_same_but_for_radians(const std::string& unit, const std::string& other) {
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const Unit a = system.parse_written(unit), b = system.parse_written(other);
  if (a == nullptr || b == nullptr || unit.empty() || other.empty()) return false;
  const bool counts_turns = unit.find("Hz") != std::string::npos || other.find("Hz") != std::string::npos;
  return counts_turns ? measure_the_same(a.get(), b.get()) : without_radians(a.get()) == without_radians(b.get());
}

QuantityError::QuantityError(std::string found_text, std::string expected_text, std::string suggestion_text)
    : std::runtime_error("found " + found_text + "; expected " + expected_text +
                         (suggestion_text.empty() ? "" : "; " + suggestion_text)),
      found(std::move(found_text)),
      expected(std::move(expected_text)),
      suggestion(std::move(suggestion_text)) {}

const std::vector<Dimension>& dimensions() {
  static const std::vector<Dimension> all = {
      {"1", "a number without unit", "0.5", {}, 1e15},
      {"m", "a length", "45 mm", {"m", "cm", "mm", "um", "nm", "in"}, 1e6},
      {"m^2", "an area", "4418 mm^2", {"m^2", "cm^2", "mm^2"}, 1e12},
      {"m^3", "a volume", "450 cm^3", {"m^3", "cm^3", "mm^3", "l"}, 1e15},
      {"m^4", "a second moment of area", "12 cm^4", {"m^4", "cm^4", "mm^4"}, 1e18},
      {"kg", "a mass", "5 kg", {"kg", "g", "t"}, 1e15},
      {"s", "a time", "0.1 ms", {"s", "ms", "us", "min"}, 1e12},
      {"rad", "an angle", "90 deg", {"deg", "rad", "rev"}, 1e12},
      {"rad/s", "an angular velocity", "3570 rpm", {"rpm", "rad/s", "deg/s", "rev/s"}, 1e9},
      {"rad/s^2", "an angular acceleration", "10 rad/s^2", {"rad/s^2", "rpm/s", "deg/s^2"}, 1e15},
      {"m/s", "a velocity", "2 m/s", {"m/s", "mm/s", "km/h"}, 1e7},
      {"m/s^2", "an acceleration", "9.81 m/s^2", {"m/s^2", "mm/s^2"}, 1e12},
      {"N", "a force", "500 N", {"N", "kN", "mN", "lbf"}, 1e18},
      {"N.m", "a torque", "5 N.m", {"N.m", "kN.m", "N.mm"}, 1e21},
      {"Pa", "a pressure", "2 bar", {"Pa", "kPa", "MPa", "GPa", "bar", "N/mm^2", "psi"}, 1e20},
      {"Pa.s", "a dynamic viscosity", "15 mPa.s", {"Pa.s", "mPa.s", "cP"}, 1e12},
      {"m^2/s", "a kinematic viscosity", "20 cSt", {"m^2/s", "mm^2/s", "cSt"}, 1e9},
      {"1/Pa", "an inverse pressure", "1.28e-8 1/Pa", {"1/Pa", "1/MPa", "1/GPa"}, 1e6},
      {"J/m^3", "an energy density", "1e13 J/m^3", {"J/m^3", "J/mm^3"}, 1e25},
      {"kg/m^3", "a density", "850 kg/m^3", {"kg/m^3", "g/cm^3"}, 1e9},
      {"kg/m", "a mass per length", "9.4 kg/m", {"kg/m", "g/mm"}, 1e12},
      {"kg.m", "a moment of inertia per length", "0.02 kg.m", {"kg.m", "kg.mm"}, 1e15},
      {"kg.m^2", "a moment of inertia", "0.01 kg.m^2", {"kg.m^2", "g.m^2", "kg.mm^2"}, 1e21},
      {"N/m", "a stiffness", "1e5 N/m", {"N/m", "N/mm", "kN/m", "N/um"}, 1e25},
      {"N.s/m", "a damping", "10 N.s/m", {"N.s/m", "N.s/mm"}, 1e21},
      {"N.m/rad", "a torsional stiffness", "100 N.m/rad", {"N.m/rad", "N.m/deg"}, 1e25},
      {"N.m.s/rad", "a torsional damping", "0.1 N.m.s/rad", {"N.m.s/rad"}, 1e21},
      {"m^3/s", "a flow", "0.5 l/min", {"m^3/s", "l/min", "mm^3/s"}, 1e9},
      {"Pa.s/m^3", "a flow resistance", "3e11 Pa.s/m^3", {"Pa.s/m^3", "bar.min/l"}, 1e25},
      {"m^3/s/Pa", "a flow over pressure", "12 l/min/bar", {"m^3/s/Pa", "l/min/bar"}, 1e9},
      {"m^3/Pa", "a volume over pressure", "1 mm^3/bar", {"m^3/Pa", "mm^3/bar", "cm^3/bar"}, 1e12},
      {"s/m", "an inverse velocity", "0.5 s/m", {"s/m", "s/mm"}, 1e12},
      {"Hz", "a frequency", "50 Hz", {"Hz", "kHz", "1/s"}, 1e12},
      {"K", "a temperature", "60 degC", {"degC", "K"}, 1e6},
      {"1/s", "a shear rate", "1e6 1/s", {"1/s"}, 1e15},
      {"1/K", "an inverse temperature", "0.034 1/K", {"1/K"}, 1e6},
      {"J/kg/K", "a specific heat", "2000 J/kg/K", {"J/kg/K", "kJ/kg/K"}, 1e12},
      {"W/m/K", "a thermal conductivity", "0.13 W/m/K", {"W/m/K"}, 1e12},
      {"W/m^2/K", "a heat transfer coefficient", "80 W/m^2/K", {"W/m^2/K"}, 1e15},
      {"J/K", "a heat capacity", "500 J/K", {"J/K", "kJ/K"}, 1e18},
      {"W/K", "a thermal conductance", "5 W/K", {"W/K"}, 1e18},
      {"W", "a power", "2 kW", {"W", "kW"}, 1e18},
  };
  return all;
}

const Dimension& dimension_of(std::string_view si_unit) {
  for (const Dimension& dimension : dimensions()) {
    if (dimension.si_unit == si_unit) return dimension;
  }
  throw ContractError("no dimension has the SI unit '" + std::string(si_unit) + "'");
}

Quantity split_quantity(std::string_view text) { return split_quantities(text, 1, "a number and a unit").front(); }

double convert_to_si(const Quantity& quantity, std::string_view si_unit) {
  const Dimension& wanted = dimension_of(si_unit);
  if (quantity.unit.empty()) {
    if (quantity.number != 0 && si_unit != "1") throw QuantityError("a number without unit", expectation(wanted));
    require_meant(quantity.number, wanted);
    return quantity.number;
  }
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const cv_converter* converter = known_converters().find(quantity.unit, si_unit);
  if (converter == nullptr) {
    const Unit given = system.parse_written(quantity.unit);
    if (!given) {
      throw QuantityError("unknown unit " + in_quotes(quantity.unit), expectation(wanted),
                          did_you_mean(quantity.unit, wanted.spelled));
    }
    const Unit target = system.parse(wanted.si_unit);
    if (!is_accepted(given.get(), target.get(), si_unit)) {
      throw QuantityError(name_of(system, given.get(), quantity.unit), expectation(wanted));
    }
    converter = known_converters().add(quantity.unit, si_unit, converter_between(given.get(), target.get()));
  }
  const double value = cv_convert_double(converter, quantity.number);
  require_finite(value, std::to_string(quantity.number) + " " + quantity.unit);
  require_meant(value, wanted);
  return value;
}

double parse_quantity(std::string_view text, std::string_view si_unit) {
  return parse_quantities(text, si_unit, 1).front();
}

std::vector<double> parse_quantities(std::string_view text, std::string_view si_unit, int count) {
  const Dimension& wanted = dimension_of(si_unit);
  const std::string what = count == 1 ? expectation(wanted) : expectation_of_several(wanted, count);
  std::vector<double> values;
  for (const Quantity& part : split_quantities(text, count, what)) values.push_back(convert_to_si(part, si_unit));
  return values;
}

double convert(const Quantity& quantity, const std::string& unit) {
  if (quantity.unit == unit) return quantity.number;
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const Unit from = quantity.unit.empty() ? system.parse("1") : system.parse_written(quantity.unit);
  const Unit to = unit.empty() ? system.parse("1") : system.parse_written(unit);
  if (!from) throw QuantityError("unknown unit " + in_quotes(quantity.unit), "a unit like " + unit);
  if (!to) throw QuantityError("unknown unit " + in_quotes(unit), "a unit like " + quantity.unit);
  const bool zero = quantity.number == 0 && quantity.unit.empty();
  if (zero) return 0;
  if (!measure_the_same(from.get(), to.get())) {
    throw QuantityError(name_of(system, from.get(), quantity.unit), name_of(system, to.get(), unit));
  }
  return converted(from.get(), to.get(), quantity.number);
}

namespace {

/// Returns the SI units of `dimensions()` by the text of their base units; of two units of the same dimension the later
/// one, 1/s for Hz.
std::map<std::string, std::string> si_units_by_base(const UnitSystem& system) {
  std::map<std::string, std::string> spelled;
  for (const Dimension& dimension : dimensions()) {
    if (dimension.si_unit != "1") spelled[base_units(system.parse(dimension.si_unit).get())] = dimension.si_unit;
  }
  return spelled;
}

/// Converts `number` in `unit` to the SI unit of its dimension, or to base units if the dimension has no name in
/// `dimensions()`.
Quantity in_si_units(const UnitSystem& system, double number, const Unit& unit) {
  if (!unit) throw QuantityError("units that do not multiply", "units such as mm or N/mm^2");
  const std::string base = base_units(unit.get());
  const Unit target = system.parse(base.empty() ? "1" : base);
  if (!target || ut_are_convertible(unit.get(), target.get()) == 0) {
    throw QuantityError("a unit beyond measure", "units such as mm or N/mm^2");
  }
  static const std::map<std::string, std::string> spelled = si_units_by_base(system);
  const auto known = spelled.find(base);
  return {converted(unit.get(), target.get(), number), known == spelled.end() ? base : known->second};
}

}  // namespace

Quantity sum(const Quantity& a, const Quantity& b) {
  const auto is_bare_zero = [](const Quantity& q) { return q.number == 0 && q.unit.empty(); };
  if (is_bare_zero(a)) return b;
  if (is_bare_zero(b)) return a;
  {
    const std::lock_guard guard(UnitSystem::lock());
    for (const Quantity* q : {&a, &b}) (void)factor_unit(UnitSystem::instance(), q->unit);
  }
  return {a.number + convert(b, a.unit), a.unit};
}

Quantity product(const Quantity& a, const Quantity& b) {
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const Unit unit_a = factor_unit(system, a.unit), unit_b = factor_unit(system, b.unit);
  if (a.unit.empty() || b.unit.empty()) return {a.number * b.number, a.unit + b.unit};
  return in_si_units(system, a.number * b.number, Unit(ut_multiply(unit_a.get(), unit_b.get())));
}

Quantity quotient(const Quantity& a, const Quantity& b) {
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const Unit unit_a = factor_unit(system, a.unit), unit_b = factor_unit(system, b.unit);
  if (b.unit.empty()) return {a.number / b.number, a.unit};
  if (a.unit == b.unit) return {a.number / b.number, ""};
  return in_si_units(system, a.number / b.number, Unit(ut_divide(unit_a.get(), unit_b.get())));
}

Quantity power(const Quantity& base, double exponent) {
  if (base.unit.empty()) return {std::pow(base.number, exponent), ""};
  constexpr double highest = 9;
  if (exponent != std::round(exponent) || std::abs(exponent) > highest) {
    throw QuantityError("the power " + std::to_string(exponent) + " of a quantity in " + base.unit,
                        "an integer from -9 to 9 as its exponent");
  }
  const std::lock_guard guard(UnitSystem::lock());
  const UnitSystem& system = UnitSystem::instance();
  const Unit unit = factor_unit(system, base.unit);
  return in_si_units(system, std::pow(base.number, exponent), Unit(ut_raise(unit.get(), static_cast<int>(exponent))));
}

}  // namespace hersey
