#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hersey/core/archive.h"

namespace hersey {

/// Puts numbers and texts into bytes, one after the other, in the machine's own order of bytes. For states that go back
/// to the program they come from; a file that other programs read has a described format instead.
/// @verified_by packer_test.cpp
class Packer {
 public:
  /// Puts a number.
  template <class Number>
  void put(const Number& number) {
    static_assert(std::is_arithmetic_v<Number>);
    put_bytes(&number, sizeof number);
  }
  void put(const std::string& text);  ///< with its length
  /// Puts a list of numbers with its length.
  template <class Number>
  void put(const std::vector<Number>& list) {
    static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
    put(static_cast<std::uint64_t>(list.size()));
    put_bytes(list.data(), list.size() * sizeof(Number));
  }
  void put(const Archive::Content& content);  ///< all that an archive contains
  /// Returns all bytes and is empty again.
  [[nodiscard]] std::vector<unsigned char> take() { return std::move(bytes_); }

 private:
  void put_bytes(const void* from, std::size_t size);
  std::vector<unsigned char> bytes_;
};

/// Takes them out again in the same order. @throws std::runtime_error where the bytes are cut off, or go on after
/// their end; a damaged length never asks for more memory than there are bytes
class Unpacker {
 public:
  /// @param bytes  have to outlive it
  Unpacker(const unsigned char* bytes, std::size_t size) : at_(bytes), left_(size) {}

  /// What comes next: a number, a text, a list with its length, or the content of an archive.
  template <class Number>
  [[nodiscard]] Number number() {
    Number number{};
    copy(&number, sizeof number);
    return number;
  }
  /// A text. @see number
  [[nodiscard]] std::string text();
  /// A list. @see number
  template <class Number>
  [[nodiscard]] std::vector<Number> list() {
    std::vector<Number> values(length(sizeof(Number)));
    copy(values.data(), values.size() * sizeof(Number));
    return values;
  }
  /// The content of an archive. @see number
  [[nodiscard]] Archive::Content content();
  /// Asserts that nothing is left.
  void require_end() const;

 private:
  [[nodiscard]] std::size_t length(std::size_t each);
  void copy(void* to, std::size_t size);
  const unsigned char* at_;
  std::size_t left_;
};

}  // namespace hersey
