#pragma once

#include <atomic>

namespace hersey::cli {

/// From now on Ctrl-C (SIGINT), SIGTERM and the end of the terminal (SIGHUP) set the flag returned; a second one ends
/// the program at once. A reader of its messages that goes away does not end it.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

}  // namespace hersey::cli
