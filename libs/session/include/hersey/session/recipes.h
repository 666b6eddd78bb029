#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hersey::session {

/// A task of users from its model to what is looked at, from docs/recipes: Markdown, whose blocks ```sh are commands
/// that the tests run as they stand.
struct Recipe {
  std::string_view name, text;
};

/// All of them, in the order in which they are listed.
[[nodiscard]] const std::vector<Recipe>& recipes();

/// The recipe called `name`. @throws InputError for another name, with the nearest one
[[nodiscard]] const Recipe& recipe(const std::string& name);

/// Its first line.
[[nodiscard]] std::string title_of(const Recipe& recipe);

}  // namespace hersey::session
