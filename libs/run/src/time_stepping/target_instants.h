#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace hersey::run {

/// The instants that steps have to hit, ascending [s]: a list, or equal intervals, which take no memory whatever their
/// number.
class TargetInstants {
 public:
  TargetInstants() = default;
  explicit TargetInstants(std::vector<double> list) : list_(std::move(list)), count_(list_.size()) {}

  /// The multiples of `step` after `start`, and the end of the run.
  static TargetInstants equal(double start, double duration, double step);

  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] double operator[](std::size_t k) const {
    if (!list_.empty()) return list_[k];
    return k + 1 == count_ ? end_ : start_ + static_cast<double>(k + 1) * step_;
  }
  [[nodiscard]] double front() const { return (*this)[0]; }

 private:
  std::vector<double> list_;
  std::size_t count_ = 0;
  double start_ = 0, step_ = 0, end_ = 0;
};

}  // namespace hersey::run
