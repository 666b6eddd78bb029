#include "check/members.h"

namespace hersey::model {

double number_of(const Value& parent, const std::string& key) {
  const Value* value = parent.find(key);
  return value != nullptr ? value->number : 0;
}

int integer_of(const Value& parent, const std::string& key) { return static_cast<int>(number_of(parent, key)); }

std::string text_of(const Value& parent, const std::string& key) {
  const Value* value = parent.find(key);
  return value != nullptr ? value->text : "";
}

Vector3 vector_of(const Value& parent, const std::string& key) {
  const Value* value = parent.find(key);
  if (value == nullptr || value->numbers.size() != 3) return Vector3::Zero();
  return {value->numbers[0], value->numbers[1], value->numbers[2]};
}

const std::vector<Member>& section(const Value& root, const std::string& key) {
  static const std::vector<Member> empty;
  const Value* value = root.find(key);
  return value != nullptr ? value->members : empty;
}

std::vector<std::string> names_in(const Value& root, const std::string& key) {
  std::vector<std::string> names;
  for (const auto& [name, value] : section(root, key)) names.push_back(name);
  return names;
}

}  // namespace hersey::model
