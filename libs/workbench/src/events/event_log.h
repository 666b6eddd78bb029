#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hersey::workbench {

struct Event {
  std::uint64_t number = 0;
  std::string name;  ///< files, run, runs or reload
  std::string data;  ///< JSON on one line
};

/// The last events, numbered from 1, for several readers: a reader that reconnects gives the last number it has had and
/// gets what has come since.
/// @verified_by event_log_test.cpp
class EventLog {
 public:
  void add(const std::string& name, const std::string& data);
  [[nodiscard]] std::uint64_t last() const;
  /// Events after `number`, waited for if there are none yet. Where some of them are no longer known, the one event
  /// `reload`, with the last number.
  [[nodiscard]] std::vector<Event> after(std::uint64_t number, double most_seconds) const;

 private:
  static constexpr std::size_t kMost = 4096;  // about a minute of four runs
  static constexpr std::size_t kMostBytes = std::size_t{16} << 20;

  mutable std::mutex mutex_;
  mutable std::condition_variable added_;
  std::deque<Event> events_;
  std::uint64_t last_ = 0;
  std::size_t bytes_ = 0;  // of their data
};

}  // namespace hersey::workbench
