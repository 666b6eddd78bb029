#pragma once

namespace hersey {

/// Memory that this program may use [bytes]: the machine's, or what its control group is allowed if that is less.
/// Constant while the program runs.
[[nodiscard]] double usable_memory();

}  // namespace hersey
