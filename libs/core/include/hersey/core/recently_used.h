#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <string>
#include <utility>

namespace hersey {

/// Keeps what takes long to make, by names, so that a program that runs for days does not fill the memory: of more than
/// `most` the one is dropped that was asked for longest ago. Clients may keep theirs on.
/// @verified_by recently_used_test.cpp
template <class T>
class RecentlyUsed {
 public:
  /// @param most  number that is kept, >= 1
  explicit RecentlyUsed(std::size_t most) : most_(most) {}

  /// What is kept under `name`, null if there is nothing.
  [[nodiscard]] std::shared_ptr<const T> find(const std::string& name) {
    const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const Named& one) { return one.first == name; });
    if (known == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, known);
    return kept_.front().second;
  }

  /// Keeps `value` in place of what had this name. @returns it
  std::shared_ptr<const T> keep(const std::string& name, std::shared_ptr<const T> value) {
    std::erase_if(kept_, [&](const Named& one) { return one.first == name; });
    kept_.emplace_front(name, value);
    if (kept_.size() > most_) kept_.pop_back();
    return value;
  }

  [[nodiscard]] std::size_t size() const { return kept_.size(); }  ///< number that is kept

 private:
  using Named = std::pair<std::string, std::shared_ptr<const T>>;

  std::size_t most_;
  std::list<Named> kept_;  // asked for last first
};

}  // namespace hersey
