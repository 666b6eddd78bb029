#pragma once

#include <atomic>

namespace hersey::cli {

/// From now on Ctrl-C (SIGINT), SIGTERM and the end of the terminal (SIGHUP) set the flag returned; a second one ends
/// the program at once. So does the first, 1.5 s later, unless `interrupt_is_heeded` has been called: whatever computes
/// without looking at the flag, a reduction or a long step, is not waited for. Only where steps have been short, so
/// that there is no checkpoint behind each, it may take 9 s: then it is the disk that is slow. A reader of its messages
/// that goes away does not end it.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

/// What computed has seen the flag, if it is set, and has stopped: writing checkpoint, results and report may take as
/// long as the disk does.
void interrupt_is_heeded();

/// A step has ended.
void note_step();

}  // namespace hersey::cli
