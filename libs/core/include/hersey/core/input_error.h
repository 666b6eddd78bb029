#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace hersey {

/// Location in a user's file; line and column are counted from 1, and 0 means unknown.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

/// A fault of the user's input, described so that the user can correct it without reading the source.
struct Fault {
  SourcePosition position;
  std::string path;        ///< key path, e.g. "bearings.big_end.diameter"; may be empty
  std::string found;       ///< text found there, e.g. "unknown key 'diamter'"
  std::string expected;    ///< allowed values, e.g. "a length > 0, such as 45 mm"
  std::string suggestion;  ///< nearest valid name or remedy; may be empty

  /// "model.yaml:12:5: bearings.big_end: unknown key 'diamter'; did you mean 'diameter'? expected ..."
  [[nodiscard]] std::string text() const;
};

/// The user's input is wrong. The exception carries every fault found, not only the first.
class InputError : public std::runtime_error {
 public:
  /// Reports several faults; what() is their texts, one line each, at most a hundred.
  explicit InputError(std::vector<Fault> faults);
  /// Reports a single fault.
  explicit InputError(Fault fault);
  /// Returns all faults in the order in which they were found.
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace hersey
