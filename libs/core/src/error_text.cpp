#include "hersey/core/error_text.h"

#include <new>
#include <stdexcept>

#include "hersey/core/contract.h"

namespace hersey {
namespace {

/// Returns "libs/film/src/grid.cpp:12" for ".../libs/film/src/grid.cpp:12": the folder of the build is omitted.
std::string path_in_source(const std::string& path) {
  for (const char* root : {"libs/", "apps/"}) {
    const std::size_t at = path.rfind(root);
    if (at != std::string::npos) return path.substr(at);
  }
  return path.substr(path.find_last_of('/') + 1);
}

/// Returns "film_solver, libs/film/src/grid.cpp:12" for "film_solver: condition does not hold: why (path:12)", the text
/// of a ContractError.
std::string location_of(const ContractError& error) {
  const std::string text = error.what();
  const std::size_t open = text.rfind(" (");
  if (open == std::string::npos || text.back() != ')') return text;
  const std::string function = text.substr(0, text.find(':'));
  return function + ", " + path_in_source(text.substr(open + 2, text.size() - open - 3));
}

}  // namespace

bool is_bug(const std::exception& error) {
  const bool is_expected = dynamic_cast<const std::runtime_error*>(&error) != nullptr ||
                           dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return !is_expected;
}

std::string error_text(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "the machine's memory does not suffice";
  if (!is_bug(error)) return error.what();
  const auto* const contract = dynamic_cast<const ContractError*>(&error);
  return "internal error, please report it with the model and the next line\n  at " +
         (contract != nullptr ? location_of(*contract) : std::string(error.what()));
}

}  // namespace hersey
