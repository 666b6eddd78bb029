#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "exit_code.h"
#include "hersey/model/schema.h"
#include "hersey/session/starting_models.h"
#include "table.h"

namespace hersey::cli {
namespace {

int list_models() {
  std::vector<std::vector<std::string>> lines;
  for (const session::StartingModel& model : session::starting_models())
    lines.push_back({std::string(model.name), session::title_of(model)});
  fmt::print(
      "Models to begin with:\n{}\n`hersey init big_end my_rod` writes my_rod.yaml and says what to do with it.\n",
      aligned(lines, 1));
  return kOk;
}

}  // namespace

int init_command(const InitArguments& arguments) {
  if (arguments.model.empty()) return list_models();
  const std::filesystem::path file =
      session::write_starting_model(arguments.model, arguments.name.empty() ? arguments.model : arguments.name);
  const std::string_view text = session::starting_model(arguments.model).text;
  const bool is_bearing_alone = text.find("\nsimulation:") == std::string_view::npos;
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
