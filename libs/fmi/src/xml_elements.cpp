#include "xml_elements.h"

#include <expat.h>
#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <memory>

#include "hersey/fmi/fmu_error.h"

namespace hersey::fmi {
namespace {

constexpr std::size_t kMostParts =
    4'000'000;  // elements and attributes, each about 150 bytes: 100,000 variables have two million
constexpr std::size_t kDeepest = 64;  // elements inside each other; descriptions of FMUs have fewer than ten

/// The elements that are open while expat walks through a text. The last one is the innermost.
struct Reading {
  XML_Parser parser = nullptr;
  Element outside;  ///< its child is the root
  std::vector<Element*> open;
  std::size_t parts = 0;
  std::string refusal;

  void stop(const char* why) {
    refusal = why;
    XML_StopParser(parser, XML_FALSE);
  }
};

void on_start(void* data, const char* name, const char** attributes) {
  auto& reading = *static_cast<Reading*>(data);
  if (reading.open.size() > kDeepest) return reading.stop("elements nested too deep");
  // Siblings that follow move no element that is open.
  Element& element = reading.open.back()->children.emplace_back();
  element.name = name;
  for (; *attributes != nullptr; attributes += 2, ++reading.parts) element.attributes[attributes[0]] = attributes[1];
  if (++reading.parts > kMostParts) return reading.stop("more elements and attributes than 4 million");
  reading.open.push_back(&element);
}

void on_end(void* data, const char* /*name*/) { static_cast<Reading*>(data)->open.pop_back(); }

void on_document_type(void* data, const char*, const char*, const char*, int) {
  static_cast<Reading*>(data)->stop("a declaration of a document type");
}

/// Returns the line that the parser has come to; from expat 2.9 on the function of the old name is deprecated.
std::uint64_t line_of(XML_Parser parser) {
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return XML_GetCurrentLineNumber64(parser);
#else
  return XML_GetCurrentLineNumber(parser);
#endif
}

}  // namespace

Element read_xml(const std::string& text) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), XML_ParserFree);
  if (parser == nullptr) throw std::bad_alloc();
  Reading reading;
  reading.parser = parser.get();
  reading.open = {&reading.outside};
  XML_SetUserData(parser.get(), &reading);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_document_type);
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw FmuError("modelDescription.xml is larger than 2 GB");
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) != XML_STATUS_OK) {
    const std::string why = reading.refusal.empty() ? XML_ErrorString(XML_GetErrorCode(parser.get())) : reading.refusal;
    throw FmuError(fmt::format("modelDescription.xml, line {}: {}", line_of(parser.get()), why));
  }
  return std::move(reading.outside.children.front());
}

}  // namespace hersey::fmi
