#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace hersey::workbench {

/// Something that is asked of the folder or its runs cannot be done.
class NotDone : public std::runtime_error {
 public:
  NotDone(int status, const std::string& error, std::string advice)
      : std::runtime_error(error), status_(status), advice_(std::move(advice)) {}
  [[nodiscard]] int status() const { return status_; }  ///< of HTTP
  [[nodiscard]] const std::string& advice() const { return advice_; }

 private:
  int status_;
  std::string advice_;
};

}  // namespace hersey::workbench
