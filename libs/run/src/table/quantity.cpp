#include "table/quantity.h"

namespace hersey::run {

std::string filled_in(const std::string& text, const std::string& name) {
  const std::size_t from = text.find('<');
  if (from == std::string::npos) return text;
  return text.substr(0, from) + name + text.substr(text.find('>', from) + 1);
}

std::string below(std::string group, std::string name) {
  for (constexpr std::string_view up = "../"; name.starts_with(up); name.erase(0, up.size()))
    group.erase(group.find_last_of('/', group.size() - 2) + 1);
  return group + name;
}

}  // namespace hersey::run
