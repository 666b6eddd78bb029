#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hersey::workbench {

/// A process by its number and the time of its start, which no later process with the same number has.
struct ProcessId {
  int pid = 0;              ///< 0: none
  std::uint64_t start = 0;  ///< in the system's ticks since it was started
};

/// Starts `words`, the first a path of a program, in a session of its own: neither the end of this program nor a signal
/// to its terminal ends it. Its output is appended to `log`; none of this program's files stay open in it.
/// @throws std::system_error if it cannot be started
[[nodiscard]] ProcessId start_detached(const std::vector<std::string>& words, const std::filesystem::path& folder,
                                       const std::filesystem::path& log);

/// The same for a program that is of no use without this one: it is interrupted, as by Ctrl-C, when this program ends,
/// also if it is killed.
/// @throws std::system_error if it cannot be started
[[nodiscard]] ProcessId start_attached(const std::vector<std::string>& words, const std::filesystem::path& folder,
                                       const std::filesystem::path& log);

[[nodiscard]] bool is_running(const ProcessId& process);

/// Asks a process that was started by one of the above, and its children, to stop, as Ctrl-C does. @returns false if it
/// does not run, or if none of its arguments is `argument`: a number from a file could be that of any process.
bool interrupt(const ProcessId& process, const std::string& argument);

/// Runs `words` to its end. @returns its exit code, or -1 if it was killed or took more than `most_seconds`
/// @param output  what it printed, at most 64 kB
[[nodiscard]] int run_to_end(const std::vector<std::string>& words, const std::filesystem::path& folder,
                             double most_seconds, std::string& output);

}  // namespace hersey::workbench
