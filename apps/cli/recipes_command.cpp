#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "hersey/session/recipes.h"
#include "table.h"

namespace hersey::cli {
namespace {

void print_list(bool as_json) {
  if (as_json) {
    nlohmann::json list = nlohmann::json::array();
    for (const session::Recipe& recipe : session::recipes())
      list.push_back({{"name", recipe.name}, {"title", session::title_of(recipe)}, {"text", recipe.text}});
    fmt::print("{}\n", list.dump(2));
    return;
  }
  std::vector<std::vector<std::string>> lines;
  for (const session::Recipe& recipe : session::recipes())
    lines.push_back({std::string(recipe.name), session::title_of(recipe)});
  fmt::print("Tasks, step by step:\n{}\n`hersey recipes {}` prints one.\n", aligned(lines, 1),
             session::recipes().front().name);
}

}  // namespace

int recipes_command(const std::string& name, bool as_json) {
  if (name.empty())
    print_list(as_json);
  else if (as_json)
    fmt::print("{}\n", nlohmann::json{{"name", name}, {"text", session::recipe(name).text}}.dump(2));
  else
    fmt::print("{}", session::recipe(name).text);
  return kOk;
}

}  // namespace hersey::cli
