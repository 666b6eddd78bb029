#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hersey::workbench {

/// An example that came with the program.
struct Example {
  std::string name;  ///< of its model, below the folder of the examples: slider_crank/model.yaml
  std::string title;
  std::string text;
};

/// The folder of the examples: the one that the environment variable HERSEY_EXAMPLES names, else the one that was
/// installed with the program, or that of the sources which it was built in; empty if there is none.
[[nodiscard]] std::filesystem::path examples_folder_of_program();

/// All models with a title below a folder, by name.
[[nodiscard]] std::vector<Example> examples_in(const std::filesystem::path& folder);

}  // namespace hersey::workbench
