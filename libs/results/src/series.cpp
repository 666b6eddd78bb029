#include <fmt/format.h>

#include "hersey/results/reader.h"
#include "writer_parts.h"

// Series, of which every row is written as its step ends.
namespace hersey::results {
namespace {

constexpr std::size_t block_numbers = 1u << 20;  // that rows of one series are copied in

}  // namespace

Series Writer::series(std::string_view path, int columns, std::string_view unit, std::string_view description,
                      Precision precision, std::string_view dimension) {
  if (impl_->in_memory) {
    std::vector<std::size_t> shape;
    if (columns > 1) shape.push_back(static_cast<std::size_t>(columns));
    return {this, impl_->keep(path, unit, description, std::move(shape), dimension)};
  }
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  HERSEY_REQUIRE(columns >= 1, "a row has numbers");
  std::vector<hsize_t> row;
  std::vector<std::string> dimensions;
  if (columns > 1) {
    row.push_back(static_cast<hsize_t>(columns));
    dimensions.push_back(impl_->columns(absolute(path), row.back(), dimension));
  }
  return {this, impl_->make_growing(path, row, unit, description, precision, std::move(dimensions))};
}

Series Writer::field(std::string_view path, std::array<int, 2> shape, std::string_view unit,
                     std::string_view description, const std::array<std::string, 2>& dimensions) {
  if (impl_->in_memory)
    return {this, impl_->keep(path, unit, description,
                              {static_cast<std::size_t>(shape[0]), static_cast<std::size_t>(shape[1])}, {})};
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  HERSEY_REQUIRE(shape[0] >= 1 && shape[1] >= 1, "a row has numbers");
  const std::vector<hsize_t> row{static_cast<hsize_t>(shape[0]), static_cast<hsize_t>(shape[1])};
  const std::string name = absolute(path);
  const std::array<const char*, 2> which{"_row", "_column"};
  std::vector<std::string> scales;
  for (std::size_t i = 0; i < 2; ++i)
    scales.push_back(impl_->numbers(dimensions[i].empty() ? name + which[i] : absolute(dimensions[i]), row[i],
                                    "index, counted from 0"));
  return {this, impl_->make_growing(path, row, unit, description, Precision::float64, std::move(scales))};
}

void Series::append(std::span<const double> row) const {
  HERSEY_REQUIRE(writer_ != nullptr, "a series comes from Writer::series");
  Writer::Impl& impl = *writer_->impl_;
  const std::size_t width = impl.width(index_);
  HERSEY_REQUIRE(row.size() == width, fmt::format("a row of {} numbers was given, {} are due", row.size(), width));
  std::copy(row.begin(), row.end(), impl.open_row(width).begin());
  impl.add_open_row(index_, 1);
}

std::size_t Series::width() const {
  HERSEY_REQUIRE(writer_ != nullptr, "a series comes from Writer::series");
  return writer_->impl_->width(index_);
}

void SeriesBlock::add(const Series& series) {
  HERSEY_REQUIRE(series.writer_ != nullptr, "a series comes from Writer::series");
  if (count_ == 0) writer_ = series.writer_, first_ = series.index_;
  HERSEY_REQUIRE(series.writer_ == writer_ && series.index_ == first_ + count_,
                 "series of a block are declared one right after the other");
  ++count_;
  width_ += series.width();
}

std::span<double> SeriesBlock::open() const {
  HERSEY_REQUIRE(count_ > 0, "a block has series");
  return writer_->impl_->open_row(width_);
}

void SeriesBlock::close() const { writer_->impl_->add_open_row(first_, count_); }
std::vector<std::pair<std::string, std::size_t>> Writer::rows() {
  if (impl_->in_memory) return {};
  flush();
  impl_->file.sync();
  std::vector<std::pair<std::string, std::size_t>> rows;
  rows.reserve(impl_->flow.datasets().size());
  for (const GrowingDataset& entry : impl_->flow.datasets()) rows.emplace_back(entry.name(), entry.rows());
  return rows;
}

void Writer::copy_rows(const Reader& from, const std::vector<std::pair<std::string, std::size_t>>& rows) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  if (rows.size() != impl_->flow.datasets().size()) throw ReadError(from.path(), "it holds other series");
  impl_->flow.drain();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    GrowingDataset& entry = impl_->flow.datasets()[i];
    const auto& [name, count] = rows[i];
    if (name != entry.name() || !from.has(name)) throw ReadError(from.path(), "it lacks " + entry.name());
    const std::size_t width = entry.width(), block = std::max<std::size_t>(1, block_numbers / width);
    for (std::size_t first = 0; first < count; first += block) {
      const std::size_t size = std::min(block, count - first);
      const Array part = from.read_rows(name, first, size);
      if (part.values.size() != size * width) throw ReadError(from.path(), "it lacks rows of " + name);
      impl_->require(entry.add(part.values), "HDF5 cannot add rows");
    }
  }
  flush();
}

}  // namespace hersey::results
