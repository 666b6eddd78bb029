#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hersey::results {

/// Rows of many series in the order in which they came, until they are removed series by series.
///
/// A machine of a thousand bodies passes thousands of short rows a step: kept in one piece of memory they cost little
/// more than their copying, and for rows of neighbouring series only their beginning is stored.
class WaitingRows {
 public:
  static constexpr std::size_t most_numbers = std::size_t{1} << 24;  // 128 MiB

  /// Makes room for as many steps of `numbers` numbers as fit, so that rows need not be moved; the first of it has its
  /// memory at once.
  void expect(std::size_t numbers, std::size_t steps);

  /// Room for `width` numbers, zeros, which count once they are added; a second call forgets the first.
  [[nodiscard]] std::span<double> open(std::size_t width);
  /// Adds the rows opened last: one for each of `count` series from `first` on.
  void add(std::size_t first, std::size_t count);

  [[nodiscard]] std::size_t numbers() const { return used_; }
  /// Rows of the series that was added first since rows were last taken out.
  [[nodiscard]] std::size_t steps() const { return steps_; }
  [[nodiscard]] bool has_room_for(std::size_t count) const { return used_ + count <= most_numbers; }

  /// Gives all rows of one series at a time, in the series' order, and forgets them.
  /// @param widths  numbers per row of each series
  void take_out(const std::vector<std::size_t>& widths,
                const std::function<void(std::size_t series, std::span<const double> rows)>& take);

 private:
  /// Allocates memory for the first `end` numbers.
  void prepare(std::size_t end);

  /// Rows of series that follow each other.
  struct Run {
    std::uint32_t first = 0, count = 0;
  };
  /// Begin of each row, sorted by series.
  struct Positions {
    std::vector<std::uint32_t> rows;  // in numbers_
    std::vector<std::size_t> last;    // of each series in `rows`
  };
  [[nodiscard]] Positions positions(const std::vector<std::size_t>& widths) const;

  std::vector<double> numbers_;
  std::size_t used_ = 0;  // of numbers_; what lies behind is open
  std::vector<Run> runs_;
  std::size_t steps_ = 0;
  std::size_t prepared_ = 0;  // numbers up to which memory is there, not just promised
};

}  // namespace hersey::results
