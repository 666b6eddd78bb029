#include "events/event_log.h"

#include <chrono>

namespace hersey::workbench {

void EventLog::add(const std::string& name, const std::string& data) {
  {
    const std::lock_guard lock(mutex_);
    events_.push_back({++last_, name, data});
    bytes_ += data.size();
    while (events_.size() > kMost || (bytes_ > kMostBytes && events_.size() > 1)) {
      bytes_ -= events_.front().data.size();
      events_.pop_front();
    }
  }
  added_.notify_all();
}

std::uint64_t EventLog::last() const {
  const std::lock_guard lock(mutex_);
  return last_;
}

std::vector<Event> EventLog::after(std::uint64_t number, double most_seconds) const {
  std::unique_lock lock(mutex_);
  added_.wait_for(lock, std::chrono::duration<double>(most_seconds), [&] { return last_ != number; });
  if (last_ == number) return {};
  const std::uint64_t first = last_ - events_.size() + 1;
  // A number above the last is one of another server.
  if (number > last_ || number + 1 < first) return {{last_, "reload", "{}"}};
  return {events_.begin() + static_cast<std::ptrdiff_t>(number + 1 - first), events_.end()};
}

}  // namespace hersey::workbench
