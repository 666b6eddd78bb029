#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace hersey::cli {

/// How a program that this one has started ended: exit code or signal.
struct ChildEnd {
  enum class Reason { exited, killed, not_found, took_too_long, interrupted };
  Reason reason = Reason::exited;
  int code = 0;  ///< what it returned, or the signal that ended it
};

/// Runs `words`, the first a program on PATH, in `folder` until it ends, with its output in the file `log`. Its whole
/// process group is killed after `time_limit` [s], or when `stop` becomes true; it ends with this program.
/// @throws std::system_error if no process can be created.
[[nodiscard]] ChildEnd run_program(const std::vector<std::string>& words, const std::filesystem::path& folder,
                                   const std::filesystem::path& log, double time_limit, const std::atomic<bool>& stop);

}  // namespace hersey::cli
