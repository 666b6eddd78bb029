#include <fmt/format.h>

#include "hersey/model/read.h"
#include "hersey/model/study.h"
#include "interpret/read/reader.h"
#include "tree/tree_digest.h"

namespace hersey::model {
std::string model_fingerprint(const std::string& path) {
  std::vector<Fault> faults;
  const Node root = parse_yaml(file_text(path), path, faults).value_or(Node{});
  if (!faults.empty()) throw InputError(std::move(faults));
  Digest digest;
  for (const Entry& entry : root.entries) {
    const Node* variants = entry.key == "study" ? entry.value.find("variants") : nullptr;
    if (variants != nullptr) digest.add(*variants);
    if (entry.key == "study" || entry.key == "title" || entry.key == "description") continue;
    digest.add(entry.key);
    digest.add(entry.value);
  }
  for (const auto& [name, hash] : read(path).files) digest.add(fmt::format("{} {:016x}", name, hash));
  return digest.text();
}

}  // namespace hersey::model
