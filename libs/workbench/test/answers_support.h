#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "hersey/workbench/answers.h"
#include "source_dir.h"

namespace hersey::workbench {

using Json = nlohmann::ordered_json;

inline std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline std::string examples_folder() { return std::string(source_dir()) + "/examples"; }

/// The model files of the examples, relative to their folder.
inline std::vector<std::string> example_models() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples_folder()))
    // What a command makes first is not there.
    if (entry.path().extension() == ".yaml" && entry.path().parent_path().filename() != "parts")
      files.push_back(entry.path().lexically_relative(examples_folder()).generic_string());
  return files;
}

inline Json example_request(const std::string& path) {
  return {{"path", path}, {"text", contents_of(examples_folder() + "/" + path)}};
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The text with edits of an answer made; its characters are ASCII.
inline std::string with_edits(const std::string& text, const Json& edits) {
  const auto offset = [&](int line, int column) {
    std::size_t at = 0;
    for (int i = 1; i < line; ++i) at = text.find('\n', at) + 1;
    return at + static_cast<std::size_t>(column - 1);
  };
  REQUIRE(edits.size() == 1);
  const Json& edit = edits.front();
  const std::size_t begin = offset(edit["line"], edit["column"]), end = offset(edit["endLine"], edit["endColumn"]);
  return text.substr(0, begin) + edit["text"].get<std::string>() + text.substr(end);
}

/// Status with which `ask` is refused; 0 where it is not.
template <class Ask>
int status_of(Ask ask) {
  try {
    (void)ask();
  } catch (const Refused& refused) {
    CHECK(refused.error.size() > 10);
    return refused.status;
  }
  return 0;
}

}  // namespace hersey::workbench
