#pragma once

#include <atomic>

namespace hersey::cli {

/// Makes Ctrl-C (SIGINT), SIGTERM and the end of the terminal (SIGHUP) set the returned flag; a second signal ends the
/// program at once. The first one does so after 1.5 s unless `interrupt_is_heeded` has been called, because a
/// computation that does not check the flag, a reduction or a long step, is not waited for. If steps have been short,
/// so that there is no checkpoint after each, it may take 9 s: then the disk is slow. A closed reader of its messages
/// does not end the program.
[[nodiscard]] const std::atomic<bool>& catch_interrupts();

/// The computation has noticed the flag, if it is set, and has stopped: writing checkpoint, results and report may take
/// as long as the disk needs.
void interrupt_is_heeded();

/// A step has ended.
void note_step();

}  // namespace hersey::cli
