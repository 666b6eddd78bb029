#include "waiting_rows.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <numeric>

namespace hersey::results {
namespace {

constexpr std::size_t prepared_bytes = std::size_t{4} << 20;    // at a time
constexpr std::size_t gathered_numbers = std::size_t{1} << 16;  // 512 KiB: what a processor holds close to itself

/// Asks for large pages, of which a machine's rows fill less than one a step instead of dozens of small ones. A wish.
void wish_large_pages(void* data, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* begin = data;
  if (std::align(page, page, begin, bytes) != nullptr) ::madvise(begin, bytes / page * page, MADV_HUGEPAGE);
#else
  static_cast<void>(data);
  static_cast<void>(bytes);
#endif
}

/// Has the system put memory behind [data, data + bytes), which costs a quarter of what it does page by page as they
/// are written to. A wish: where it is not heard, nothing is lost.
void put_memory_behind(void* data, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* begin = data;
  if (std::align(page, page, begin, bytes) != nullptr) ::madvise(begin, bytes / page * page, MADV_POPULATE_WRITE);
#else
  static_cast<void>(data);
  static_cast<void>(bytes);
#endif
}

}  // namespace

void WaitingRows::expect(std::size_t numbers, std::size_t steps) {
  // Memory that is never used costs nothing, to move it does.
  if (numbers > 0) numbers_.reserve(std::min(most_numbers / numbers, steps) * numbers);
  wish_large_pages(numbers_.data(), numbers_.capacity() * sizeof(double));
  prepare(numbers_.capacity());
}

void WaitingRows::prepare(std::size_t end) {
  if (end <= prepared_) return;
  put_memory_behind(numbers_.data() + prepared_, (end - prepared_) * sizeof(double));
  prepared_ = end;
}

std::span<double> WaitingRows::open(std::size_t width) {
  const std::size_t end = used_ + width;
  if (end > prepared_ && end <= numbers_.capacity())
    prepare(std::min(numbers_.capacity(), end + prepared_bytes / sizeof(double)));
  numbers_.resize(used_);
  numbers_.resize(end);
  return {numbers_.data() + used_, width};
}

void WaitingRows::add(std::size_t first, std::size_t count) {
  used_ = numbers_.size();
  if (runs_.empty() || first == runs_.front().first) ++steps_;
  if (!runs_.empty() && runs_.back().first + runs_.back().count == first)
    runs_.back().count += static_cast<std::uint32_t>(count);
  else
    runs_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
}

WaitingRows::Positions WaitingRows::positions(const std::vector<std::size_t>& widths) const {
  Positions positions;
  std::vector<std::size_t>& last = positions.last;  // of what is filled in so far
  last.assign(widths.size() + 1, 0);
  for (const Run& run : runs_)
    for (std::size_t series = run.first; series < run.first + run.count; ++series) ++last[series + 1];
  std::partial_sum(last.begin(), last.end(), last.begin());
  positions.rows.resize(last.back());
  std::size_t at = 0;
  for (const Run& run : runs_)
    for (std::size_t series = run.first; series < run.first + run.count; ++series) {
      positions.rows[last[series]++] = static_cast<std::uint32_t>(at);
      at += widths[series];
    }
  return positions;
}

void WaitingRows::take_out(const std::vector<std::size_t>& widths,
                           const std::function<void(std::size_t series, std::span<const double> rows)>& take) {
  const Positions at = positions(widths);
  const auto first_of = [&](std::size_t series) { return series > 0 ? at.last[series - 1] : 0; };
  const auto count_of = [&](std::size_t series) { return at.last[series] - first_of(series); };
  // Rows of neighbouring series mostly lie beside each other: those of a few series are gathered at a time.
  std::vector<std::vector<double>> gathered;
  for (std::size_t begin = 0, end = 0; begin < widths.size(); begin = end) {
    std::size_t most = 0, numbers = 0;
    for (; end < widths.size() && (end == begin || numbers + count_of(end) * widths[end] <= gathered_numbers); ++end) {
      numbers += count_of(end) * widths[end];
      most = std::max(most, count_of(end));
    }
    gathered.resize(std::max(gathered.size(), end - begin));
    for (std::size_t series = begin; series < end; ++series) gathered[series - begin].clear();
    for (std::size_t k = 0; k < most; ++k)
      for (std::size_t series = begin; series < end; ++series) {
        if (k >= count_of(series)) continue;
        const auto row = numbers_.begin() + static_cast<std::ptrdiff_t>(at.rows[first_of(series) + k]);
        std::vector<double>& rows = gathered[series - begin];
        rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(widths[series]));
      }
    for (std::size_t series = begin; series < end; ++series)
      if (!gathered[series - begin].empty()) take(series, gathered[series - begin]);
  }
  numbers_.clear();
  used_ = 0;
  runs_.clear();
  steps_ = 0;
}

}  // namespace hersey::results
