#include "answers/request.h"

#include <algorithm>
#include <cmath>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {

Json request_object(std::string_view request) {
  Json value = Json::parse(request.begin(), request.end(), nullptr, false);
  if (value.is_discarded() || !value.is_object())
    throw Refused(400, "The request is not a JSON object.", "Send {\"path\": ..., \"text\": ...}.");
  return value;
}

std::string text_in(const Json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_string())
    throw Refused(400, std::string("The request has no text '") + key + "'.", "Send it as a string.");
  return found->get<std::string>();
}

std::string text_in(const Json& request, const char* key, const char* otherwise) {
  const auto found = request.find(key);
  return found == request.end() || found->is_null() ? otherwise : text_in(request, key);
}

std::vector<std::string> texts_in(const Json& request, const char* key) {
  std::vector<std::string> texts;
  const auto found = request.find(key);
  if (found == request.end() || found->is_null()) return texts;
  const bool is_list =
      found->is_array() && std::all_of(found->begin(), found->end(), [](const Json& one) { return one.is_string(); });
  if (!is_list) throw Refused(400, std::string("'") + key + "' of the request is not a list of texts.");
  for (const Json& one : *found) texts.push_back(one.get<std::string>());
  return texts;
}

double number_in(const Json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || !found->is_number() || !std::isfinite(found->get<double>()))
    throw Refused(400, std::string("The request has no number '") + key + "'.");
  return found->get<double>();
}

std::string dumped(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

void refuse(const InputError& error) {
  const Fault& first = error.faults().front();
  throw Refused(422, (first.path.empty() ? "" : first.path + ": ") + first.found + "; expected " + first.expected,
                first.suggestion);
}

}  // namespace hersey::workbench
