#pragma once

namespace hersey {

/// Returns the memory that this program may use [bytes]: that of the machine, or the limit of its control group if that
/// is less. Constant while the program runs.
[[nodiscard]] double usable_memory();

}  // namespace hersey
