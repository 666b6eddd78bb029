#include "answers/examples.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

namespace hersey::workbench {
namespace {

using std::filesystem::path;

constexpr std::uintmax_t kLargestExample = std::uintmax_t{1} << 20;  // [B]: longer texts are no examples
constexpr std::size_t kMostExamples = 500;

/// The value of `title:` at the start of a line; empty if there is none.
std::string title_in(const std::string& text) {
  constexpr std::string_view key = "\ntitle: ";
  const std::size_t at = text.find(key);
  if (at == std::string::npos) return "";
  std::string title = text.substr(at + key.size(), text.find('\n', at + 1) - at - key.size());
  std::erase(title, '"');
  while (!title.empty() && title.back() <= ' ') title.pop_back();
  return title;
}

bool holds_examples(const path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / "slider_crank" / "model.yaml", error);
}

}  // namespace

path examples_folder_of_program() {
  std::error_code error;
  if (const char* named = std::getenv("HERSEY_EXAMPLES")) return std::filesystem::absolute(named, error);
  const path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const path folder = program.parent_path();
  // Installed: bin and share are neighbours. In the sources: build/release is two folders deep.
  constexpr std::array<const char*, 3> places{"../share/doc/hersey/examples", "../share/hersey/examples",
                                              "../../examples"};
  for (const char* place : places)
    if (const path found = (folder / place).lexically_normal(); holds_examples(found)) return found;
  return {};
}

std::vector<Example> examples_in(const path& folder) {
  std::vector<Example> examples;
  std::error_code error;
  if (folder.empty()) return examples;
  for (std::filesystem::recursive_directory_iterator walk(folder, error), end; !error && walk != end;
       walk.increment(error)) {
    if (walk.depth() > 2) walk.disable_recursion_pending();
    // Parts of examples read what a command makes first.
    if (walk->path().parent_path().filename() == "parts") continue;
    if (walk->path().extension() != ".yaml" || walk->file_size(error) > kLargestExample) continue;
    std::ifstream stream(walk->path(), std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    Example example{walk->path().lexically_relative(folder).generic_string(), title_in(text.str()), text.str()};
    if (!example.title.empty()) examples.push_back(std::move(example));
    if (examples.size() >= kMostExamples) break;
  }
  std::sort(examples.begin(), examples.end(), [](const Example& a, const Example& b) { return a.name < b.name; });
  return examples;
}

}  // namespace hersey::workbench
