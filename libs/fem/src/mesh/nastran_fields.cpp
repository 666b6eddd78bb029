#include "mesh/nastran_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mesh/mesh_text.h"

namespace hersey::fem {

void NastranFields::fail(std::string found, std::string expected, std::string suggestion) const {
  raw_.fail(location_, std::move(found), std::move(expected), std::move(suggestion));
}

long NastranFields::integer_in(std::string_view text) const {
  long value = 0;
  if (!parse_integer(text, value))
    fail(fmt::format("'{}' in {}", text.substr(0, 20), card_.name.empty() ? "SET" : card_.name.substr(0, 8)),
         "a whole number");
  return value;
}

double NastranFields::number(std::size_t field) const {
  const std::string_view text = card_.field(field);
  double value = 0;
  if (text.empty()) return 0;
  if (!parse_number(text, value))
    fail(fmt::format("'{}' in {}", text.substr(0, 20), card_.name.substr(0, 8)), "a number");
  return value;
}

std::string NastranFields::components(std::size_t field) const {
  std::string digits(card_.field(field));
  if (digits == "0") digits.clear();
  std::sort(digits.begin(), digits.end());
  const bool is_sound = std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '1' && c <= '6'; }) &&
                        std::adjacent_find(digits.begin(), digits.end()) == digits.end();
  if (!is_sound)
    fail(fmt::format("components '{}' in {}", card_.field(field).substr(0, 20), card_.name.substr(0, 8)),
         "digits from 1 to 6, each once, such as 123");
  return digits;
}

}  // namespace hersey::fem
