#pragma once

#include <string>
#include <string_view>

#include "mesh/nastran_card.h"
#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Fields of an entry as numbers. @throws InputError naming entry and line where one is none
class NastranFields {
 public:
  NastranFields(const RawMesh& raw, int file, const NastranCard& card)
      : raw_(raw), card_(card), location_{file, card.line} {}

  [[nodiscard]] long integer(std::size_t field) const { return integer_in(card_.field(field)); }
  /// Empty: none given.
  [[nodiscard]] long integer_or(std::size_t field, long none) const {
    return card_.field(field).empty() ? none : integer(field);
  }
  [[nodiscard]] double number(std::size_t field) const;  ///< empty: zero
  [[nodiscard]] long integer_in(std::string_view text) const;
  /// Digits from 1 to 6, as in "123", each once; "" and "0": none.
  [[nodiscard]] std::string components(std::size_t field) const;
  [[nodiscard]] FileLocation location() const { return location_; }
  [[noreturn]] void fail(std::string found, std::string expected, std::string suggestion = {}) const;

 private:
  const RawMesh& raw_;
  const NastranCard& card_;
  FileLocation location_;
};

}  // namespace hersey::fem
