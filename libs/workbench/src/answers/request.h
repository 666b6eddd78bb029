#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::workbench {

using Json = nlohmann::json;

/// The object that a request is. @throws Refused with the status 400 for any other text
[[nodiscard]] Json request_object(std::string_view request);

/// A text of a request. @throws Refused with the status 400 where it is missing or none
[[nodiscard]] std::string text_in(const Json& request, const char* key);
/// The same, or `otherwise` where it is missing.
[[nodiscard]] std::string text_in(const Json& request, const char* key, const char* otherwise);

/// A list of texts of a request; empty where it is missing. @throws Refused with the status 400 for anything else
[[nodiscard]] std::vector<std::string> texts_in(const Json& request, const char* key);

/// A number of a request. @throws Refused with the status 400 where it is missing or none
[[nodiscard]] double number_in(const Json& request, const char* key);

/// Text of a JSON value; bytes that are no UTF-8 are replaced, numbers that are not finite become null.
[[nodiscard]] std::string dumped(const Json& value);

/// Throws Refused with the status 422 for faults of an input, the first in words.
[[noreturn]] void refuse(const InputError& error);

}  // namespace hersey::workbench
