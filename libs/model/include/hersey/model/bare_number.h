#pragma once

#include <string>

namespace hersey::model {

/// A number without unit where the format asks for a quantity.
struct BareNumber {
  std::string path;       ///< key path, "bearings.main.width", "gravity.2"
  std::string unit;       ///< SI unit of the quantity: the first that the format allows there
  std::string parameter;  ///< where it comes from one parameter, that one's name; else empty
};

}  // namespace hersey::model
