#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::python {

/// A model as checked, and the text it came from, so that it can be read again with other values.
struct CheckedModel {
  std::string text, file;
  std::vector<std::string> overrides;
  model::Model model;
};

}  // namespace hersey::python
