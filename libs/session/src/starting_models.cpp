#include "hersey/session/starting_models.h"

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/core/write_file.h"

namespace hersey::session {

const StartingModel& starting_model(const std::string& name) {
  std::vector<std::string> names;
  for (const StartingModel& model : starting_models()) {
    if (model.name == name) return model;
    names.emplace_back(model.name);
  }
  throw InputError(
      Fault{{"hersey init", 0, 0}, "", "unknown model '" + name + "'", one_of(names), did_you_mean(name, names)});
}

std::string title_of(const StartingModel& model) {
  constexpr std::string_view key = "\ntitle: ";
  const std::size_t at = model.text.find(key) + key.size();
  return std::string(model.text.substr(at, model.text.find('\n', at) - at));
}

std::string text_for(const StartingModel& model, const std::string& file) {
  constexpr std::string_view placeholder = "NAME";
  std::string result(model.text);
  for (auto at = result.find(placeholder); at != std::string::npos; at = result.find(placeholder, at + file.size()))
    result.replace(at, placeholder.size(), file);
  return result;
}

std::filesystem::path write_starting_model(const std::string& name, std::filesystem::path file) {
  const StartingModel& model = starting_model(name);
  if (file.extension() != ".yaml" && file.extension() != ".yml") file += ".yaml";
  if (!write_new_file(file, text_for(model, file.string())))
    throw FileExists(Fault{{file.string(), 0, 0}, "", "a file that exists already", "another name", ""});
  return file;
}

}  // namespace hersey::session
