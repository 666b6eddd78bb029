#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "hersey/model/read.h"
#include "hersey/model/study.h"
#include "interpret/reader.h"

namespace hersey::model {
namespace {

/// FNV-1a.
class Digest {
 public:
  void add(std::string_view text) {
    for (const char c : text) step(static_cast<unsigned char>(c));
    step(0);
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  void step(unsigned char byte) { value_ = (value_ ^ byte) * 0x100000001b3U; }
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

void add_tree(const Node& node, Digest& digest) {
  digest.add(fmt::format("{}", static_cast<int>(node.kind)));
  digest.add(node.text);
  for (const Node& item : node.items) add_tree(item, digest);
  for (const Entry& entry : node.entries) {
    digest.add(entry.key);
    add_tree(entry.value, digest);
  }
  digest.add("end");
}

}  // namespace

std::string model_fingerprint(const std::string& path) {
  std::vector<Fault> faults;
  const Node root = parse_yaml(file_text(path), path, faults).value_or(Node{});
  if (!faults.empty()) throw InputError(std::move(faults));
  Digest digest;
  for (const Entry& entry : root.entries) {
    const Node* variants = entry.key == "study" ? entry.value.find("variants") : nullptr;
    if (variants != nullptr) add_tree(*variants, digest);
    if (entry.key == "study" || entry.key == "title" || entry.key == "description") continue;
    digest.add(entry.key);
    add_tree(entry.value, digest);
  }
  for (const auto& [name, hash] : read(path).files) digest.add(fmt::format("{} {:016x}", name, hash));
  return digest.text();
}

}  // namespace hersey::model
