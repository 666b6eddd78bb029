#include "hersey/session/recipes.h"

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"

namespace hersey::session {

const Recipe& recipe(const std::string& name) {
  std::vector<std::string> names;
  for (const Recipe& one : recipes()) {
    if (one.name == name) return one;
    names.emplace_back(one.name);
  }
  throw InputError(
      Fault{{"hersey recipes", 0, 0}, "", "unknown recipe '" + name + "'", one_of(names), did_you_mean(name, names)});
}

std::string title_of(const Recipe& recipe) {
  constexpr std::string_view mark = "# ";
  return std::string(recipe.text.substr(mark.size(), recipe.text.find('\n') - mark.size()));
}

}  // namespace hersey::session
