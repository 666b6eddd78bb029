#include "row_flow.h"

#include <algorithm>
#include <numeric>
#include <system_error>

#include "hersey/core/contract.h"

namespace hersey::results {
namespace {

constexpr double flush_share = 0.03;                        // of the time of a run, which flushes take at most
constexpr double first_flush = 0.1;                         // of the interval: a run may soon fill a small disk
constexpr std::size_t worth_moving = std::size_t{1} << 20;  // numbers: 8 MiB

}  // namespace

std::size_t RowFlow::add(GrowingDataset dataset, double cost) {
  widths_.push_back(dataset.width());
  datasets_.push_back(std::move(dataset));
  flush_cost_ += cost;
  return datasets_.size() - 1;
}

std::span<double> RowFlow::open(std::size_t width) {
  if (!writes_beside_) file_.require(true, {});
  HERSEY_REQUIRE(file_.handle.valid(), "the results file is finished");
  if (steps_at_a_time_ == 0) expect_rows();
  if (!waiting_.has_room_for(width)) make_room();
  return waiting_.open(width);
}

void RowFlow::expect_rows() {
  const std::size_t numbers = std::accumulate(widths_.begin(), widths_.end(), std::size_t{0});
  const std::size_t chunk_rows = GrowingDataset::narrow_chunk_rows(expected_);
  steps_at_a_time_ = chunk_rows * (1 + worth_moving / (chunk_rows * std::max<std::size_t>(1, numbers)));
  const std::size_t steps = std::min(expected_, steps_at_a_time_) + 2;
  waiting_.expect(numbers, steps);
  if (writes_beside_) leaving_.expect(numbers, steps);
}

void RowFlow::make_room() {
  if (writes_beside_) return hand_over(false);
  const Hdf5Session session;
  file_.require_open();
  drain();
}

/// Writes the rows in a separate thread; waits for those before them.
void RowFlow::hand_over(bool with_flush) {
  settle();
  file_.require_open();
  std::swap(waiting_, leaving_);
  const auto write = [this, with_flush] {
    const Hdf5Session session;
    with_flush ? flush(leaving_) : drain(leaving_);
  };
  try {
    writing_ = std::async(std::launch::async, write);
  } catch (const std::system_error&) {  // the system has no thread to give
    write();
  }
}

/// One series after the other.
void RowFlow::drain(WaitingRows& rows) {
  rows.take_out(widths_, [this](std::size_t series, std::span<const double> numbers) {
    file_.require(datasets_[series].add(numbers), "HDF5 cannot add rows");
  });
}

void RowFlow::flush(WaitingRows& rows) {
  const Clock::time_point began = Clock::now();
  const bool has_rows = rows.numbers() > 0;
  drain(rows);
  file_.require(H5Fflush(file_.handle.get(), H5F_SCOPE_LOCAL) >= 0, "HDF5 cannot flush");
  last_flush_ = Clock::now();
  rows_at_flush_ = datasets_.empty() ? 0 : datasets_.front().rows();
  // The cost of a flush of few rows does not predict that of the next one.
  if (has_rows) flush_cost_ = std::max(std::chrono::duration<double>(last_flush_ - began).count(), 0.5 * flush_cost_);
}

void RowFlow::end_step() {
  if (is_writing()) return;
  settle();
  const bool is_due = is_flush_due();
  if (!is_due && !are_chunks_full()) return;
  if (writes_beside_) return hand_over(is_due);
  const Hdf5Session session;
  file_.require_open();
  is_due ? flush() : drain();
}

bool RowFlow::is_writing() const {
  return writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

/// Rows that the chunks, as far as they are begun, still take. Of the first series, which most others keep pace with;
/// while nothing is under way.
std::size_t RowFlow::missing_steps() const {
  const std::size_t begun = datasets_.front().rows() % steps_at_a_time_;
  return steps_at_a_time_ - std::min(steps_at_a_time_, begun + waiting_.steps());
}

bool RowFlow::are_chunks_full() const { return steps_at_a_time_ > 0 && !datasets_.empty() && missing_steps() == 0; }

/// While nothing is under way. Flushes follow each other quickly in a young file. A chunk that is written before it is
/// full is written again: where all are about to be, a flush waits for that as long again at most.
bool RowFlow::is_flush_due() const {
  if (flush_interval_ == 0) return true;
  const Clock::time_point now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_flush_).count();
  const double age = std::chrono::duration<double>(now - opened_).count();
  const double wanted = std::clamp(age, first_flush * flush_interval_, flush_interval_);
  const double interval = std::max(wanted, flush_cost_ / flush_share);
  if (since < interval) return false;
  if (steps_at_a_time_ == 0 || datasets_.empty() || since >= 2 * interval) return true;
  const double steps = static_cast<double>(datasets_.front().rows() + waiting_.steps() - rows_at_flush_);
  const bool are_full_soon = static_cast<double>(missing_steps()) * since <= steps * (2 * interval - since);
  return missing_steps() == 0 || !are_full_soon;
}

}  // namespace hersey::results
