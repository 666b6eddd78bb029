#pragma once

#include <stdexcept>
#include <string>

namespace hersey {

/// `text` with the first `from` in it replaced by `to`. @throws std::logic_error if it has none
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the text has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace hersey
