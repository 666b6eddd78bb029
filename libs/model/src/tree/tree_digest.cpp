#include "tree/tree_digest.h"

#include <fmt/format.h>

namespace hersey::model {

void Digest::add(std::string_view text) {
  for (const char c : text) step(static_cast<unsigned char>(c));
  step(0);
}

void Digest::add(const Node& node) {
  add(fmt::format("{}", static_cast<int>(node.kind)));
  add(node.text);
  for (const Node& item : node.items) add(item);
  for (const Entry& entry : node.entries) {
    add(entry.key);
    add(entry.value);
  }
  add("end");
}

std::string Digest::text() const { return fmt::format("{:016x}", value_); }

}  // namespace hersey::model
