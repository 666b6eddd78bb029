#pragma once

#include <chrono>

namespace hersey {

/// Adds the time from its making to its end to a sum of seconds: wall time of the thread it lives in.
class Stopwatch {
 public:
  /// Begins to count; `seconds` [s] outlives it.
  explicit Stopwatch(double& seconds) : seconds_(seconds), began_(Clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - began_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point began_;
};

}  // namespace hersey
