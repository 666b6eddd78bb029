#include "waiting_rows.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <numeric>

namespace hersey::results {
namespace {

constexpr std::size_t prepared_bytes = std::size_t{4} << 20;  // at a time

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

/// Prepares what follows where less than `needed` elements more are ready. @returns up to which they are now
template <typename T>
std::size_t prepare_ahead(std::vector<T>& values, std::size_t prepared, std::size_t needed) {
  const std::size_t last = std::min(values.capacity(), values.size() + needed + prepared_bytes / sizeof(T));
  put_memory_behind(values.data() + prepared, (last - prepared) * sizeof(T));
  return last;
}

}  // namespace

void WaitingRows::expect(std::size_t series, std::size_t numbers, std::size_t steps) {
  const std::size_t room = numbers > 0 ? std::min(most_numbers / numbers, steps) : 0;
  // Memory that is never used costs nothing, to move it does.
  numbers_.reserve(room * numbers);
  series_.reserve(room * series);
}

void WaitingRows::add(std::size_t series, std::span<const double> row) {
  if (numbers_.size() + row.size() > prepared_numbers_)
    prepared_numbers_ = prepare_ahead(numbers_, prepared_numbers_, row.size());
  if (series_.size() + 1 > prepared_series_) prepared_series_ = prepare_ahead(series_, prepared_series_, 1);
  if (series >= widths_.size()) widths_.resize(series + 1, 0);
  widths_[series] = row.size();
  numbers_.insert(numbers_.end(), row.begin(), row.end());
  series_.push_back(static_cast<std::uint32_t>(series));
}

void WaitingRows::take_out(const std::function<void(std::size_t series, const std::vector<double>& rows)>& take) {
  std::vector<std::size_t> last(widths_.size() + 1, 0);  // of each series' places in `order`, once they are filled
  for (const std::uint32_t series : series_) ++last[series + 1];
  std::partial_sum(last.begin(), last.end(), last.begin());
  std::vector<std::uint32_t> order(series_.size());  // where rows begin, sorted by series
  std::size_t at = 0;
  for (const std::uint32_t series : series_) {
    order[last[series]++] = static_cast<std::uint32_t>(at);
    at += widths_[series];
  }
  std::vector<double> rows;
  std::size_t first = 0;
  for (std::size_t series = 0; series < widths_.size(); ++series) {
    rows.clear();
    for (; first < last[series]; ++first) {
      const auto row = numbers_.begin() + static_cast<std::ptrdiff_t>(order[first]);
      rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(widths_[series]));
    }
    if (!rows.empty()) take(series, rows);
  }
  numbers_.clear();
  series_.clear();
}

}  // namespace hersey::results
