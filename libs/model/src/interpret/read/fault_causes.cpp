#include "interpret/read/fault_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace hersey::model {
namespace {

/// A key and what it is meant to be.
struct Misspelling {
  SourcePosition position;
  std::string key, meant;
};

bool is_same_place(const SourcePosition& a, const SourcePosition& b) {
  return a.line == b.line && a.column == b.column && a.file == b.file;
}

/// What stands between two words of a message; empty where they are not there.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + before.size(), end = text.find(after, begin);
  return end == std::string::npos ? "" : text.substr(begin, end - begin);
}

std::vector<Misspelling> misspellings_in(const std::vector<Fault>& faults) {
  std::vector<Misspelling> found;
  for (const Fault& fault : faults) {
    if (!fault.found.starts_with("unknown key '")) continue;
    std::string key = between(fault.found, "unknown key '", "'");
    std::string meant = between(fault.suggestion, "did you mean '", "'?");
    if (!key.empty() && !meant.empty()) found.push_back({fault.position, std::move(key), std::move(meant)});
  }
  return found;
}

/// Renames the key where the mapping does not have what is meant already.
void rename_keys(Node& node, const std::vector<Misspelling>& misspellings) {
  for (std::size_t i = 0; i < node.entries.size(); ++i) {
    for (const Misspelling& wrong : misspellings)
      if (node.entries[i].key == wrong.key && is_same_place(node.entries[i].position, wrong.position) &&
          node.find(wrong.meant) == nullptr)
        node.entries[i].key = wrong.meant;
    rename_keys(node.entries[i].value, misspellings);
  }
  for (Node& item : node.items) rename_keys(item, misspellings);
}

/// "a length > 0" of "a length > 0, such as 20 mm".
std::string without_example(const std::string& expected) { return expected.substr(0, expected.find(", such as")); }

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

}  // namespace

std::vector<Fault> without_consequences(std::vector<Fault> faults, const Node& root,
                                        const std::function<std::vector<Fault>(const Node&)>& faults_of) {
  const std::vector<Misspelling> misspellings = misspellings_in(faults);
  if (misspellings.empty() || faults.size() < 2) return faults;
  Node meant = root;
  rename_keys(meant, misspellings);
  std::set<std::string> left;
  for (const Fault& fault : faults_of(meant)) left.insert(fault.text());
  std::erase_if(faults, [&](const Fault& fault) {
    return !fault.found.starts_with("unknown key '") && !left.contains(fault.text());
  });
  return faults;
}

void lead_to_parameters(const std::string& text, const Node& root, std::vector<Fault>& faults) {
  const Node* parameters = root.find("parameters");
  if (parameters == nullptr) return;
  for (const Entry& parameter : parameters->entries) {
    const std::string origin = fmt::format(" (from parameter {} in line {})", parameter.key, parameter.position.line);
    const auto is_of_it = [&](const Fault& fault) {
      return fault.position.file == parameter.position.file && fault.found.ends_with(origin);
    };
    const auto first = std::find_if(faults.begin(), faults.end(), is_of_it);
    if (first == faults.end()) continue;
    // Where another use takes the value, or others expect something else, the use is as likely to be wrong.
    const auto count = static_cast<std::size_t>(std::count_if(faults.begin(), faults.end(), is_of_it));
    const bool is_one = std::all_of(first, faults.end(), [&](const Fault& fault) {
      return !is_of_it(fault) || without_example(fault.expected) == without_example(first->expected);
    });
    if (!is_one || count != count_of(text, "${" + parameter.key + "}")) continue;
    Fault cause = *first;
    cause.found.resize(cause.found.size() - origin.size());
    cause.found += fmt::format(", used in line {} by {}", first->position.line, first->path);
    if (count > 1) cause.found += fmt::format(" and at {} more {}", count - 1, count > 2 ? "places" : "place");
    cause.path = "parameters." + parameter.key;
    cause.position = parameter.value.position;
    std::erase_if(faults, is_of_it);
    faults.push_back(std::move(cause));
  }
}

}  // namespace hersey::model
