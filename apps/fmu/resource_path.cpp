#include "resource_path.h"

#include <cctype>
#include <stdexcept>

namespace hersey::fmu {

std::filesystem::path path_of_uri(const std::string& uri) {
  std::string rest = uri;
  if (rest.starts_with("file:")) {
    rest.erase(0, 5);
    if (rest.starts_with("//")) rest.erase(0, rest.find('/', 2) == std::string::npos ? 2 : rest.find('/', 2));
  } else if (rest.find("://") != std::string::npos) {
    throw std::runtime_error("resources at '" + uri + "': expected a file URI");
  } else {
    return rest;
  }
  std::string path;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const bool is_code = rest[i] == '%' && i + 2 < rest.size() &&
                         std::isxdigit(static_cast<unsigned char>(rest[i + 1])) != 0 &&
                         std::isxdigit(static_cast<unsigned char>(rest[i + 2])) != 0;
    path += is_code ? static_cast<char>(std::stoi(rest.substr(i + 1, 2), nullptr, 16)) : rest[i];
    if (is_code) i += 2;
  }
  return path;
}

}  // namespace hersey::fmu
