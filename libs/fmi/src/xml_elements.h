#pragma once

#include <map>
#include <string>
#include <vector>

namespace hersey::fmi {

/// An element of an XML text with its attributes and the elements inside; text between them is left out.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;

  /// The value of an attribute; empty if there is none.
  [[nodiscard]] std::string attribute(const std::string& key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string() : found->second;
  }
  /// The first element inside of that name; null if there is none.
  [[nodiscard]] const Element* child(const std::string& called) const {
    for (const Element& one : children)
      if (one.name == called) return &one;
    return nullptr;
  }
};

/// Reads an XML text. Declarations of document types are refused: no FMU has one, and their entities can grow without
/// bound.
/// @returns the root element
/// @throws FmuError with the line if the text is not well-formed
[[nodiscard]] Element read_xml(const std::string& text);

}  // namespace hersey::fmi
