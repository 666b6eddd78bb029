#pragma once

#include <string_view>
#include <vector>

namespace hersey::cli {

/// A model to begin with, from apps/cli/init.
struct InitModel {
  std::string_view name, text;
};

/// All of them.
[[nodiscard]] const std::vector<InitModel>& init_models();

}  // namespace hersey::cli
