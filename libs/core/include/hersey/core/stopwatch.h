#pragma once

#include <chrono>

namespace hersey {

/// Adds the wall time between its construction and its destruction to a sum of seconds.
class Stopwatch {
 public:
  /// Starts the measurement; `seconds` [s] must outlive the stopwatch.
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
