#pragma once

#include <stdexcept>
#include <string>

namespace hersey::workbench {

/// A request that has no answer; the three parts are the status and the body of the response.
class Refused : public std::runtime_error {
 public:
  /// @param status  of HTTP: 400 a request that cannot be read, 404 something unknown, 409 a file that exists,
  ///                422 a model or value that is wrong
  Refused(int status, std::string error, std::string advice = {});
  int status = 0;
  std::string error;   ///< a sentence: what is wrong
  std::string advice;  ///< what to do about it; may be empty
};

}  // namespace hersey::workbench
