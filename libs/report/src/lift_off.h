#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hersey::report {

/// The instant at which asperities stop carrying a journal, or begin to.
struct LiftOff {
  double speed = 0;     ///< between the rows before and after it, as the contact's part of the load changes [rad/s]
  std::size_t row = 0;  ///< the first after it
};

/// Where the film lifts a journal off its asperities on the way up, and lets it down on the way down.
struct LiftOffs {
  std::optional<LiftOff> lift_off, touch_down;  ///< each at the highest speed at which it happens
};

/// Part of the load that asperities carry when a journal is taken to be lifted off [-].
inline constexpr double lifted_off = 0.05;

/// Finds them in the rows of a run in which a journal starts or stops: its speed is somewhere below a tenth of the
/// largest, and nowhere above that in the other sense. There are none in any other run, such as of a rod that swings
/// about its pin.
/// @param speed  of the journal in its shell [rad/s]
/// @param contact  part of the load that asperities carry in each row [-]
[[nodiscard]] LiftOffs find_lift_offs(const std::vector<double>& speed, const std::vector<double>& contact);

}  // namespace hersey::report
