#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::session {

/// A commented model to begin with, from libs/session/starting_models; `text` has the word NAME where its file is
/// named.
struct StartingModel {
  std::string_view name, text;
};

/// All of them, in the order in which they are listed.
[[nodiscard]] const std::vector<StartingModel>& starting_models();

/// The model called `name`. @throws InputError for another name, with the nearest one
[[nodiscard]] const StartingModel& starting_model(const std::string& name);

/// The title that its text gives it.
[[nodiscard]] std::string title_of(const StartingModel& model);

/// Its text for the file `file`.
[[nodiscard]] std::string text_for(const StartingModel& model, const std::string& file);

/// The file that is to be written is there, and stays as it is.
class FileExists : public InputError {
 public:
  using InputError::InputError;
};

/// Writes the model called `name` to `file`, with the ending .yaml if that has none. @returns the file
/// @throws InputError for an unknown model, FileExists; std::runtime_error if it cannot be written
std::filesystem::path write_starting_model(const std::string& name, std::filesystem::path file);

}  // namespace hersey::session
