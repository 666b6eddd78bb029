#include "hersey/core/input_error.h"

#include <utility>

namespace hersey {
namespace {

std::string join(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + fault.text();
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
  // A name that was likely meant comes before a list, however long, of all that would do.
  const bool is_name = suggestion.starts_with("did you mean ") && suggestion.ends_with('?');
  if (is_name) text += "; " + suggestion;
  if (!expected.empty()) text += (is_name ? " expected " : "; expected ") + expected;
  if (!is_name && !suggestion.empty()) text += "; " + suggestion;
  return text;
}

InputError::InputError(std::vector<Fault> faults) : std::runtime_error(join(faults)), faults_(std::move(faults)) {}
InputError::InputError(Fault fault) : InputError(std::vector<Fault>{std::move(fault)}) {}

}  // namespace hersey
