#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/write_file.h"
#include "hersey/model/schema.h"
#include "init_models.h"
#include "table.h"

namespace hersey::cli {
namespace {

/// Text after "title: ".
std::string title_of(std::string_view text) {
  constexpr std::string_view key = "\ntitle: ";
  const std::size_t at = text.find(key) + key.size();
  return std::string(text.substr(at, text.find('\n', at) - at));
}

std::string with_name(std::string_view text, const std::string& file) {
  constexpr std::string_view placeholder = "NAME";
  std::string result(text);
  for (auto at = result.find(placeholder); at != std::string::npos; at = result.find(placeholder, at + file.size()))
    result.replace(at, placeholder.size(), file);
  return result;
}

int list_models() {
  std::vector<std::vector<std::string>> lines;
  for (const InitModel& model : init_models()) lines.push_back({std::string(model.name), title_of(model.text)});
  fmt::print(
      "Models to begin with:\n{}\n`hersey init big_end my_rod` writes my_rod.yaml and says what to do with it.\n",
      aligned(lines, 2));
  return kOk;
}

const InitModel& model_called(const std::string& name) {
  std::vector<std::string> names;
  for (const InitModel& model : init_models()) {
    if (model.name == name) return model;
    names.emplace_back(model.name);
  }
  throw InputError(
      Fault{{"hersey init", 0, 0}, "", "unknown model '" + name + "'", one_of(names), did_you_mean(name, names)});
}

}  // namespace

int init_command(const InitArguments& arguments) {
  if (arguments.model.empty()) return list_models();
  const InitModel& model = model_called(arguments.model);
  std::filesystem::path file = arguments.name.empty() ? arguments.model : arguments.name;
  if (file.extension() != ".yaml" && file.extension() != ".yml") file += ".yaml";
  if (std::filesystem::exists(file) || std::filesystem::is_symlink(file))
    throw InputError(Fault{{file.string(), 0, 0}, "", "a file that exists already", "another name", ""});
  const std::string text = with_name(model.text, file.string());
  write_file(file, {text});
  const bool is_bearing_alone = text.find("\nsimulation:") == std::string::npos;
  const char* command = is_bearing_alone ? "bearing" : "run";
  fmt::print("{}: written. Change its numbers, then\n  hersey check {}\n  hersey {} {}\n", file.string(), file.string(),
             command, file.string());
  return kOk;
}

int explain_command(const std::string& path) {
  fmt::print("{}", model::explanation(path));
  return kOk;
}

}  // namespace hersey::cli
