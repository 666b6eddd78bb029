#include "growing_dataset.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <type_traits>

namespace hersey::results {
namespace {

constexpr std::size_t narrow = 4;                  // numbers per row: scalars, vectors, orientations
constexpr std::size_t small_chunk_numbers = 256;   // 2 KiB: rewritten at most once a flush while it fills
constexpr std::size_t large_chunk_numbers = 1024;  // of series of many rows

static_assert(std::endian::native == std::endian::little, "chunks lie in the file as in memory");

}  // namespace

std::size_t GrowingDataset::chunk_rows(std::size_t width, std::size_t expected) {
  const std::size_t columns = std::max(width, narrow);
  const std::size_t least = small_chunk_numbers / columns, most = large_chunk_numbers / columns;
  return std::bit_floor(std::max<std::size_t>(1, std::clamp(expected / 4, least, most)));
}

GrowingDataset::GrowingDataset(std::string name, Handle dataset, const std::vector<hsize_t>& row_shape,
                               std::size_t chunk_rows, NumberSize size)
    : name_(std::move(name)),
      dataset_(std::move(dataset)),
      width_(std::accumulate(row_shape.begin(), row_shape.end(), std::size_t{1}, std::multiplies<>())),
      chunk_numbers_(chunk_rows * width_),
      size_(size) {
  shape_.push_back(0);
  shape_.insert(shape_.end(), row_shape.begin(), row_shape.end());
}

bool GrowingDataset::add(std::span<const double> rows) {
  shape_[0] += rows.size() / width_;
  if (H5Dset_extent(dataset_.get(), shape_.data()) < 0) return false;
  while (!rows.empty()) {
    const std::size_t count = std::min(rows.size(), chunk_numbers_ - begun_.size());
    const std::span<const double> part = rows.first(count);
    rows = rows.subspan(count);
    if (begun_.empty() && count == chunk_numbers_) {
      if (!write_chunk(part)) return false;
      continue;
    }
    begun_.insert(begun_.end(), part.begin(), part.end());
    if (!write_chunk(begun_)) return false;
    if (begun_.size() == chunk_numbers_) begun_.clear();
  }
  return true;
}

/// Writes the chunk for the next rows, with zeros after the rows it has so far.
bool GrowingDataset::write_chunk(std::span<const double> rows) {
  return size_ == NumberSize::eight_bytes ? write_chunk_of<double>(rows) : write_chunk_of<float>(rows);
}

template <class Number>
bool GrowingDataset::write_chunk_of(std::span<const double> rows) {
  const void* numbers = rows.data();
  std::vector<Number> whole;
  if (!std::is_same_v<Number, double> || rows.size() < chunk_numbers_) {
    whole.resize(chunk_numbers_);
    std::transform(rows.begin(), rows.end(), whole.begin(), [](double number) { return static_cast<Number>(number); });
    numbers = whole.data();
  }
  std::vector<hsize_t> offset(shape_.size(), 0);
  offset[0] = next_chunk_;
  if (rows.size() == chunk_numbers_) next_chunk_ += chunk_numbers_ / width_;
  return H5Dwrite_chunk(dataset_.get(), H5P_DEFAULT, 0, offset.data(), chunk_numbers_ * sizeof(Number), numbers) >= 0;
}

}  // namespace hersey::results
