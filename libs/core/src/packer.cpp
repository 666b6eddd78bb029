#include "hersey/core/packer.h"

#include <cstring>
#include <stdexcept>

namespace hersey {

void Packer::put(const std::string& text) {
  put(static_cast<std::uint64_t>(text.size()));
  put_bytes(text.data(), text.size());
}

void Packer::put(const Archive::Content& content) {
  put(static_cast<std::uint64_t>(content.numbers.size()));
  for (const auto& [name, numbers] : content.numbers) {
    put(name);
    put(numbers.shape);
    put(numbers.values);
  }
  put(static_cast<std::uint64_t>(content.texts.size()));
  for (const auto& [name, text] : content.texts) {
    put(name);
    put(text);
  }
}

void Packer::put_bytes(const void* from, std::size_t size) {
  const auto* first = static_cast<const unsigned char*>(from);
  bytes_.insert(bytes_.end(), first, first + size);
}

std::string Unpacker::text() {
  std::string text(length(1), '\0');
  copy(text.data(), text.size());
  return text;
}

Archive::Content Unpacker::content() {
  Archive::Content content;
  for (auto left = number<std::uint64_t>(); left > 0; --left) {
    const std::string name = text();
    Archive::Numbers& numbers = content.numbers[name];
    numbers.shape = list<std::uint64_t>();
    numbers.values = list<double>();
  }
  for (auto left = number<std::uint64_t>(); left > 0; --left) {
    const std::string name = text();
    content.texts[name] = text();
  }
  return content;
}

void Unpacker::require_end() const {
  if (left_ != 0) throw std::runtime_error("stored numbers with more behind their end");
}

std::size_t Unpacker::length(std::size_t each) {
  const auto count = number<std::uint64_t>();
  if (count > left_ / each) throw std::runtime_error("stored numbers that are cut off");
  return static_cast<std::size_t>(count);
}

void Unpacker::copy(void* to, std::size_t size) {
  if (size > left_) throw std::runtime_error("stored numbers that are cut off");
  if (size > 0) std::memcpy(to, at_, size);
  at_ += size;
  left_ -= size;
}

}  // namespace hersey
