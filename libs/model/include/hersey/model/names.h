#pragma once

#include <string>

#include "hersey/core/input_error.h"

/// What the model file calls by name.
namespace hersey::model {

/// A frame fixed on a body; `frame` is empty for the body's own frame.
struct FrameName {
  std::string body;  ///< a body's name, or "ground"
  std::string frame;
  SourcePosition position;
};

/// A scalar joint coordinate.
struct CoordinateName {
  std::string joint, coordinate;
};

/// Of a load's components or direction.
enum class Axes { ground, body };

}  // namespace hersey::model
