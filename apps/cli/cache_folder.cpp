#include "cache_folder.h"

#include <cstdlib>
#include <string>

namespace hersey::cli {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

}  // namespace

std::filesystem::path cache_folder() {
  const std::string own = variable("HERSEY_CACHE"), caches = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (own == "off") return {};
  if (!own.empty()) return own;
  // The XDG specification has relative paths ignored.
  if (std::filesystem::path(caches).is_absolute()) return std::filesystem::path(caches) / "hersey";
  return home.empty() ? std::filesystem::path() : std::filesystem::path(home) / ".cache" / "hersey";
}

}  // namespace hersey::cli
