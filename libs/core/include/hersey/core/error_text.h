#pragma once

#include <exception>
#include <string>

#include "hersey/core/contract.h"

namespace hersey {

/// What to tell a user of an exception: a broken contract is a bug of the program, whatever the model is.
[[nodiscard]] inline std::string error_text(const std::exception& error) {
  const bool is_bug = dynamic_cast<const ContractError*>(&error) != nullptr;
  return (is_bug ? "internal error, please report it with the model: " : "") + std::string(error.what());
}

}  // namespace hersey
