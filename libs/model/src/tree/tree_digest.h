#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tree/source_tree.h"

namespace hersey::model {

/// A digest of texts and trees (FNV-1a, 64 bits): two that are equal, in the same order, have one digest. It detects
/// whether a file has changed; it is not cryptographic.
class Digest {
 public:
  /// Adds a text and its end.
  void add(std::string_view text);
  /// Adds structure and texts of a tree, without their locations in the file.
  void add(const Node& node);
  /// Sixteen hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  void step(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3U; }
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace hersey::model
