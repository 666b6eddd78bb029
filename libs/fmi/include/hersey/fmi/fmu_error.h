#pragma once

#include <stdexcept>

namespace hersey::fmi {

/// Something is wrong with an FMU, or with what it answers: damaged files, missing functions, calls that fail. The text
/// is a sentence without the FMU's name.
class FmuError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hersey::fmi
