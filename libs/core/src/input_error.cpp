#include "hersey/core/input_error.h"

#include <algorithm>
#include <utility>

namespace hersey {
namespace {

// Largest number of faults that are listed.
constexpr std::size_t kMostListed = 100;

std::string join(const std::vector<Fault>& faults) {
  std::string text;
  const std::size_t listed = std::min(faults.size(), kMostListed);
  for (std::size_t i = 0; i < listed; ++i) text += (i > 0 ? "\n" : "") + faults[i].text();
  if (listed < faults.size()) text += "\nand " + std::to_string(faults.size() - listed) + " more faults";
  return text;
}

}  // namespace

std::string Fault::text() const {
  std::string text;
  if (!position.file.empty()) text += position.file + ":";
  if (position.line > 0) text += std::to_string(position.line) + ":";
  if (position.line > 0 && position.column > 0) text += std::to_string(position.column) + ":";
  if (!text.empty()) text += " ";
  if (!path.empty()) text += path + ": ";
  text += found;
  // A suggested name precedes the list of allowed values, which may be long.
  const bool is_name = suggestion.starts_with("did you mean ") && suggestion.ends_with('?');
  if (is_name) text += "; " + suggestion;
  if (!expected.empty()) text += (is_name ? " expected " : "; expected ") + expected;
  if (!is_name && !suggestion.empty()) text += "; " + suggestion;
  return text;
}

InputError::InputError(std::vector<Fault> faults) : std::runtime_error(join(faults)), faults_(std::move(faults)) {}
InputError::InputError(Fault fault) : InputError(std::vector<Fault>{std::move(fault)}) {}

}  // namespace hersey
