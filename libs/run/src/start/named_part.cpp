#include "hersey/run/named_part.h"

#include <array>
#include <string>
#include <utility>

namespace hersey::run {

std::string path_of_named_part(const std::string& message) {
  const std::string of_circuit = "circuit: ", of_pump = of_circuit + "pump ";
  if (const std::size_t pump = message.find(of_pump); pump != std::string::npos) {
    const std::size_t name = pump + of_pump.size();
    return "circuit.elements." + message.substr(name, message.find(' ', name) - name);
  }
  if (message.find(of_circuit) != std::string::npos) return "circuit";
  const std::array<std::pair<const char*, const char*>, 6> sections{{{"joint ", "joints."},
                                                                     {"drive ", "drives."},
                                                                     {"coupling ", "couplings."},
                                                                     {"contact ", "contacts."},
                                                                     {"bearing ", "bearings."},
                                                                     {"body ", "bodies."}}};
  std::size_t first = std::string::npos;
  std::string path;
  for (const auto& [word, section] : sections) {
    const std::size_t at = message.find(word);
    if (at >= first) continue;
    first = at;
    const std::size_t name = at + std::string(word).size();
    path = section + message.substr(name, message.find_first_of(",: ", name) - name);
  }
  return path;
}

std::optional<NamedPart> named_part(const std::string& message,
                                    const std::map<std::string, SourcePosition>& positions) {
  // A part within a part, such as a pad, may have no key of its own; a section alone is no part.
  for (std::string path = path_of_named_part(message); path.find('.') != std::string::npos;
       path.resize(path.find_last_of('.'))) {
    const auto found = positions.find(path);
    if (found != positions.end() && found->second.line > 0) return NamedPart{path, found->second};
  }
  return std::nullopt;
}

}  // namespace hersey::run
