#include "hersey/workbench/refused.h"

#include <utility>

namespace hersey::workbench {

Refused::Refused(int status_code, std::string error_text, std::string advice_text)
    : std::runtime_error(error_text),
      status(status_code),
      error(std::move(error_text)),
      advice(std::move(advice_text)) {}

}  // namespace hersey::workbench
