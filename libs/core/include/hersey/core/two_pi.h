#pragma once

#include <numbers>

namespace hersey {

inline constexpr double two_pi = 2 * std::numbers::pi;  ///< angle of a full revolution [rad]

}  // namespace hersey
