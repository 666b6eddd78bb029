#include "hersey/workbench/answers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "answers/kept.h"
#include "answers/repairs.h"
#include "answers/request.h"
#include "hersey/core/units.h"
#include "hersey/model/schema.h"
#include "hersey/model/text_map.h"

namespace hersey::workbench {

Answers::Answers(const std::filesystem::path& folder) : kept_(std::make_unique<Kept>(folder)) {}
Answers::~Answers() = default;

std::string Answers::schema() const { return model::schema_json(); }

std::string Answers::explain(std::string_view request) const {
  const std::string key = text_in(request_object(request), "key");
  try {
    const std::vector<model::KeyExplanation> found = model::key_explanations(key);
    if (found.empty()) return dumped({{"title", ""}, {"text", ""}, {"plain", model::explanation(key)}});
    const model::KeyExplanation& first = found.front();
    Json answer{{"title", first.path},  {"condition", first.condition},  {"text", first.text},
                {"kind", first.kind},   {"value", first.value},          {"unit", first.unit},
                {"units", first.units}, {"default", first.default_text}, {"required", first.is_required}};
    answer["allowed"] = Json::array();
    for (const auto& [word, meaning] : first.allowed)
      answer["allowed"].push_back({{"text", word}, {"meaning", meaning}});
    answer["keys"] = Json::array();
    for (const auto& [name, meaning] : first.keys) answer["keys"].push_back({{"name", name}, {"meaning", meaning}});
    answer["example"] = model::example_value(key);
    answer["plain"] = model::explanation(key);
    return dumped(answer);
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    throw Refused(404, fault.found, fault.suggestion.empty() ? fault.expected : fault.suggestion);
  }
}

namespace {

/// The usual units of the dimension that `quantity` has; none if it is not known.
std::vector<std::string> usual_units(const Quantity& quantity) {
  for (const Dimension& dimension : dimensions()) {
    if (dimension.si_unit == "1") continue;
    try {
      (void)convert({1, quantity.unit}, dimension.si_unit);
      return dimension.spelled;
    } catch (const QuantityError&) {
      continue;
    }
  }
  return {};
}

/// "0 48 0 mm" or "1 mm 2 cm": numbers with a unit behind the last, or behind each. @throws QuantityError
std::vector<Quantity> quantities_in(const std::string& text) {
  std::vector<Quantity> parts;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    // "1/s" is a unit.
    const bool is_number =
        std::string_view("0123456789+-.").find(word.front()) != std::string_view::npos && !word.starts_with("1/");
    if (is_number) {
      parts.push_back(split_quantity(word));
    } else if (!parts.empty()) {
      std::string& unit = parts.back().unit;
      unit += (unit.empty() ? "" : " ") + word;
    } else {
      break;
    }
  }
  if (parts.empty()) throw QuantityError("'" + text + "'", "a number with a unit, such as 45 mm");
  for (std::size_t i = parts.size() - 1; i > 0; --i)
    if (parts[i - 1].unit.empty()) parts[i - 1].unit = parts[i].unit;
  return parts;
}

/// The value of a quantity in `unit` with as few digits as lead back to it, to nine of them.
std::string converted_number(const Quantity& quantity, const std::string& unit) {
  constexpr double kSame = 1e-9;  // relative: numbers are written by people
  const double value = hersey::convert(quantity, unit);
  std::array<char, 32> buffer{};
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    const double back = hersey::convert({std::strtod(buffer.data(), nullptr), unit}, quantity.unit);
    if (std::abs(back - quantity.number) <= kSame * std::abs(quantity.number)) break;
  }
  return buffer.data();
}

}  // namespace

std::string Answers::convert(std::string_view request) const {
  const Json given = request_object(request);
  const std::string text = text_in(given, "text"), unit = text_in(given, "unit", "");
  try {
    const std::vector<Quantity> parts = quantities_in(text);
    Json answer;
    answer["units"] = usual_units(parts.back());
    if (unit.empty()) {
      answer["text"] = text;
      return dumped(answer);
    }
    std::string converted;
    for (const Quantity& part : parts) converted += converted_number(part, unit) + " ";
    answer["text"] = converted + unit;
    return dumped(answer);
  } catch (const QuantityError& error) {
    throw Refused(422, error.found + " instead of " + error.expected, error.suggestion);
  }
}

std::string Answers::set_value(std::string_view request) const {
  const Json given = request_object(request);
  const std::string text = text_in(given, "text"), file = kept_->file(text_in(given, "path"));
  const std::string key = text_in(given, "key");
  const auto value = given.find("value");
  if (value == given.end())
    throw Refused(400, "The request has no 'value'.", "Send a text, or null to remove the key.");
  try {
    const model::TextMap map(text, file);
    const std::vector<model::TextEdit> edits =
        value->is_null() ? map.remove(key) : map.set(key, text_in(given, "value"));
    map.require_nothing_else(key, edits, value->is_null());
    return dumped({{"text", model::with_edits(text, edits)}, {"edits", json_of(edits, TextColumns(text))}});
  } catch (const InputError& error) {
    refuse(error);
  }
}

}  // namespace hersey::workbench
