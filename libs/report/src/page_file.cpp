#include "page_file.h"

#include <stdexcept>
#include <string>
#include <string_view>

#include "hersey/core/contract.h"
#include "hersey/core/write_file.h"
#include "hersey/results/error.h"
#include "report_page.h"

namespace hersey::report {
namespace {

using nlohmann::json;

/// Inside a script element only "<" could end it or start a comment; JSON may spell it as an escape.
std::string script_safe(const std::string& text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

void write_script(const std::string& function, const nlohmann::json& argument, const std::filesystem::path& out) {
  const std::string text = argument.dump(-1, ' ', false, json::error_handler_t::replace);
  try {
    write_file(out, {function, "(", text, ");\n"});
  } catch (const std::runtime_error& error) {
    throw results::WriteError(out, std::string("cannot write the report's fields: ") + error.what());
  }
}

void write_page(const nlohmann::json& data, const std::filesystem::path& out) {
  static constexpr std::string_view slot = R"(<script id="hersey-data" type="application/json"></script>)";
  const std::string_view page = report_page();
  const std::size_t at = page.find(slot);
  HERSEY_REQUIRE(at != std::string_view::npos, "the page has an element for its data");
  const std::size_t end_of_opening = at + slot.find("</script>");

  // Text in a results file may hold any bytes: what is not UTF-8 is replaced, not refused.
  const std::string text = script_safe(data.dump(-1, ' ', false, json::error_handler_t::replace));
  try {
    write_file(out, {page.substr(0, end_of_opening), text, page.substr(end_of_opening)});
  } catch (const std::runtime_error& error) {
    throw results::WriteError(out, std::string("cannot write the report: ") + error.what());
  }
}

}  // namespace hersey::report
