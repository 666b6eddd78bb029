#pragma once

#include <numbers>

namespace hersey {

inline constexpr double turn = 2 * std::numbers::pi;  ///< a full turn [rad]

}  // namespace hersey
