#pragma once

#include <string>

#include "hersey/core/input_error.h"

/// Things that the model file refers to by name.
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

/// True if a joint coordinate of this name is an angle.
[[nodiscard]] inline bool is_rotation(const std::string& coordinate) { return coordinate == "rotation"; }

/// Unit of its rate.
[[nodiscard]] inline std::string speed_unit(const std::string& coordinate) {
  return is_rotation(coordinate) ? "rad/s" : "m/s";
}

/// Of a load's components or direction.
enum class Axes { ground, body };

}  // namespace hersey::model
