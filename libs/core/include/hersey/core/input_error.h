#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace hersey {

/// Where in a user's file something stands; line and column count from 1, 0 means unknown.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

/// One thing wrong with the user's input, told so that it can be put right without reading the source.
struct Fault {
  SourcePosition position;
  std::string path;        ///< key path, e.g. "bearings.big_end.diameter"; may be empty
  std::string found;       ///< what stands there, e.g. "unknown key 'diamter'"
  std::string expected;    ///< what is allowed, e.g. "a length > 0, such as 45 mm"
  std::string suggestion;  ///< nearest valid name or remedy; may be empty

  /// "model.yaml:12:5: bearings.big_end: unknown key 'diamter'; did you mean 'diameter'? expected ..."
  [[nodiscard]] std::string text() const;
};

/// The user's input is wrong. Carries every fault found, not only the first.
class InputError : public std::runtime_error {
 public:
  /// Several faults at once; what() is their texts, a line each, a hundred at most.
  explicit InputError(std::vector<Fault> faults);
  /// A single one.
  explicit InputError(Fault fault);
  /// All of them, in the order they were found.
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

}  // namespace hersey
