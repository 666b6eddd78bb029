#pragma once

#include <chrono>
#include <cstddef>
#include <future>
#include <span>
#include <vector>

#include "growing_dataset.h"
#include "open_file.h"
#include "waiting_rows.h"

namespace hersey::results {

/// Passes rows to the file: they wait in memory until their series' chunks are full or a flush is due, and are written
/// to the file at once or, if a thread is available, in parallel.
class RowFlow {
 public:
  /// @param file  outlives it; used by a separate thread while rows are being written: settle() first
  /// @param expected  final number of rows of a series, as far as known
  /// @param flush_interval  shortest time between two automatic flushes [s], a tenth of it at first
  RowFlow(OpenFile& file, std::size_t expected, double flush_interval, bool writes_beside)
      : file_(file), expected_(expected), flush_interval_(flush_interval), writes_beside_(writes_beside) {}

  /// @param cost  of making it [s]: a sign of what the first flush will take
  /// @returns the number of the series
  std::size_t add(GrowingDataset dataset, double cost);
  [[nodiscard]] std::vector<GrowingDataset>& datasets() { return datasets_; }
  [[nodiscard]] std::size_t width(std::size_t series) const { return widths_.at(series); }

  /// Room for `width` numbers, zeros: a row, or rows that are handed over together. @throws WriteError
  [[nodiscard]] std::span<double> open(std::size_t width);
  /// Adds the rows opened last: one for each of `count` series from `first` on.
  void add_opened(std::size_t first, std::size_t count) { waiting_.add(first, count); }

  /// Writes all rows to the file. Rows already being written come first: settle().
  /// @throws WriteError
  void flush() { flush(waiting_); }
  /// Hands rows to HDF5, which are safe only after a flush; settle() first. @throws WriteError
  void drain() { drain(waiting_); }
  /// At the end of a step: has rows put into the file where that is due, unless some are under way. @throws WriteError
  void end_step();
  /// Waits for rows that are on their way into the file. @throws WriteError where they did not get there
  void settle() {
    if (writing_.valid()) writing_.get();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void expect_rows();
  void make_room();
  void hand_over(bool with_flush);
  void drain(WaitingRows& rows);
  void flush(WaitingRows& rows);
  [[nodiscard]] bool is_writing() const;
  [[nodiscard]] bool is_flush_due() const;
  [[nodiscard]] bool are_chunks_full() const;
  [[nodiscard]] std::size_t missing_steps() const;

  OpenFile& file_;
  std::size_t expected_;
  double flush_interval_;
  bool writes_beside_;
  std::vector<GrowingDataset> datasets_;
  std::vector<std::size_t> widths_;  // numbers per row of each
  WaitingRows waiting_;              // not in the file yet
  WaitingRows leaving_;              // on their way into it
  std::size_t steps_at_a_time_ = 0;  // rows of most series that go together; 0 until there is room for them
  Clock::time_point opened_ = Clock::now();
  Clock::time_point last_flush_ = opened_;
  std::size_t rows_at_flush_ = 0;  // of the first series
  double flush_cost_ = 0;          // of the last one [s]; before there are rows, what making the series took
  std::future<void> writing_;      // while it is under way the file, its datasets, leaving_ and the cost are its own
};

}  // namespace hersey::results
