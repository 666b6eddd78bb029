#pragma once

#include <atomic>

namespace hersey::cli {

/// From now on Ctrl-C (SIGINT) and SIGTERM set the flag returned; a second one ends the program at once.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

}  // namespace hersey::cli
