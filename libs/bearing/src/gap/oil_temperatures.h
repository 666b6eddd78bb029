#pragma once

namespace hersey::bearing {

/// No oil is one above: mineral and synthetic oils have cracked or burnt before [K].
inline constexpr double hottest_oil = 673.15;

/// No trial on the way to an answer is colder or hotter [K]: laws of viscosity mean nothing there.
inline constexpr double coldest_trial = 200, hottest_trial = 800;

}  // namespace hersey::bearing
