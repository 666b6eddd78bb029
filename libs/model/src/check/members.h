#pragma once

#include <string>
#include <vector>

#include "check/check.h"
#include "hersey/core/spatial.h"

namespace hersey::model {

// Members of a checked mapping by key; zero, empty or null where missing or broken.
[[nodiscard]] double number_of(const Value& parent, const std::string& key);
[[nodiscard]] int integer_of(const Value& parent, const std::string& key);
[[nodiscard]] std::string text_of(const Value& parent, const std::string& key);
[[nodiscard]] Vector3 vector_of(const Value& parent, const std::string& key);
/// The named things in the section `key` of the file, in its order.
[[nodiscard]] const std::vector<Member>& section(const Value& root, const std::string& key);
[[nodiscard]] std::vector<std::string> names_in(const Value& root, const std::string& key);

}  // namespace hersey::model
