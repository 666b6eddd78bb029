#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hersey::results {

/// Rows of many series in the order they came, until they are taken out series by series.
///
/// A machine of a thousand bodies hands over thousands of short rows a step: kept in one piece of memory they cost
/// little more than their copying.
class WaitingRows {
 public:
  static constexpr std::size_t most_numbers = std::size_t{1} << 25;  // 256 MiB

  /// Makes room for as many steps of `series` rows and `numbers` numbers as fit, so that rows need not be moved.
  void expect(std::size_t series, std::size_t numbers, std::size_t steps);

  /// @param row  not empty, always as wide for one series
  void add(std::size_t series, std::span<const double> row);

  [[nodiscard]] std::size_t numbers() const { return numbers_.size(); }
  [[nodiscard]] bool has_room_for(std::size_t count) const { return numbers_.size() + count <= most_numbers; }

  /// Gives all rows of one series at a time, in the series' order, and forgets them.
  void take_out(const std::function<void(std::size_t series, const std::vector<double>& rows)>& take);

 private:
  std::vector<std::size_t> widths_;  // numbers per row of each series
  std::vector<double> numbers_;
  std::vector<std::uint32_t> series_;                       // of each row
  std::size_t prepared_numbers_ = 0, prepared_series_ = 0;  // up to which memory is there, not just promised
};

}  // namespace hersey::results
