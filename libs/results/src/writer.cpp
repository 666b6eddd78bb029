#include "hersey/results/writer.h"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "dimension_scales.h"
#include "growing_dataset.h"
#include "hdf5_handle.h"
#include "hersey/core/contract.h"
#include "hersey/core/sealed_file.h"
#include "hersey/results/reader.h"
#include "object_path.h"
#include "row_flow.h"

namespace hersey::results {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t block_numbers = 1u << 20;  // that rows of one series are copied in

std::size_t numbers_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::string now_iso8601() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[sizeof "2026-01-31T12:34:56Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// Of datasets whose chunks are written whole.
Handle without_chunk_cache() {
  Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_chunk_cache(access.get(), 1, 0, 1.0);
  return access;
}

}  // namespace

std::string_view to_string(Status status) {
  switch (status) {
    case Status::running:
      return "running";
    case Status::completed:
      return "completed";
    case Status::stopped:
      return "stopped";
    case Status::failed:
      return "failed";
  }
  return "unknown";
}

struct Writer::Impl {
  bool in_memory = false;
  std::vector<LatestRow> latest;                          // in memory
  std::map<std::string, std::vector<std::string>> words;  // labels, by path; in memory
  Options options;
  OpenFile file;
  RowFlow flow;
  Handle text = text_type();
  Handle scalar{H5Screate(H5S_SCALAR)};
  std::optional<DimensionScales> scales;
  std::vector<double> open_rows;          // of a block that is being filled in; in memory
  std::unordered_set<std::string> names;  // of groups and datasets made so far
  std::string parent_name = "/";          // of the group opened last
  Handle parent;
  std::map<std::vector<hsize_t>, Handle> creations;  // property lists of datasets by the shape of their chunks
  Handle without_cache = without_chunk_cache();

  explicit Impl(Options how) : options(how), flow(file, options.rows, options.flush_interval, options.writes_beside) {}

  std::size_t keep(std::string_view name, std::string_view unit, std::string_view description,
                   std::vector<std::size_t> row_shape, std::string_view dimension) {
    LatestRow row{absolute(name), std::string(unit), std::string(description), std::move(row_shape), {}, {}};
    if (row.shape.size() == 1) row.components = names_of(row.shape.front(), dimension);
    latest.push_back(std::move(row));
    return latest.size() - 1;
  }

  [[nodiscard]] std::vector<std::string> names_of(std::size_t count, std::string_view dimension) const {
    if (dimension == xyz || (dimension.empty() && count == 3)) return {"x", "y", "z"};
    if (dimension.empty() && count == 2) return {"x", "y"};
    if (dimension.empty() && count == 4) return {"w", "x", "y", "z"};
    if (!dimension.empty())
      if (const auto found = words.find(absolute(dimension)); found != words.end() && found->second.size() == count)
        return found->second;
    std::vector<std::string> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(std::to_string(i));
    return numbers;
  }

  void require(bool good, std::string_view what) { file.require(good, what); }

  Handle open_or_make(const std::string& object) {
    if (object != "/") make_groups(object);
    return Handle(H5Oopen(file.handle.get(), object.c_str(), H5P_DEFAULT));
  }

  void make_groups(const std::string& group) {
    for (std::size_t end = group.find('/', 1);; end = group.find('/', end + 1)) {
      const std::string part = group.substr(0, end);
      if (names.insert(part).second) {
        const Handle made(H5Gcreate2(file.handle.get(), part.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        require(made.valid(), "HDF5 cannot create group " + part);
      }
      if (end == std::string::npos) return;
    }
  }

  /// In place where there is one of that type and shape: nothing of the file's structure changes then.
  void set_attribute(hid_t object, std::string_view name, hid_t type, hid_t space, const void* value) {
    const std::string key(name);
    Handle attribute;
    if (H5Aexists(object, key.c_str()) > 0) {
      attribute = Handle(H5Aopen(object, key.c_str(), H5P_DEFAULT));
      if (!is_alike(attribute.get(), type, space)) {
        attribute.reset();
        require(H5Adelete(object, key.c_str()) >= 0, "HDF5 cannot replace " + key);
      }
    }
    if (!attribute.valid()) attribute = Handle(H5Acreate2(object, key.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
    require(attribute.valid() && H5Awrite(attribute.get(), type, value) >= 0, "HDF5 cannot write attribute " + key);
  }

  static bool is_alike(hid_t attribute, hid_t type, hid_t space) {
    const Handle type_there(H5Aget_type(attribute)), space_there(H5Aget_space(attribute));
    return H5Tequal(type_there.get(), type) > 0 && H5Sextent_equal(space_there.get(), space) > 0;
  }

  void set_text(hid_t object, std::string_view name, std::string_view value) {
    const std::string copy(value);
    const char* pointer = copy.c_str();
    set_attribute(object, name, text.get(), scalar.get(), &pointer);
  }

  Handle make_dataset(std::string_view path_, hid_t type, hid_t space, hid_t creation, hid_t access,
                      std::string_view unit, std::string_view description) {
    const std::string name = absolute(path_);
    const auto slash = name.rfind('/');
    open_group(slash > 0 ? name.substr(0, slash) : "/");
    HERSEY_REQUIRE(names.insert(name).second, name + " is declared twice");
    Handle dataset(H5Dcreate2(parent.get(), name.c_str() + slash + 1, type, space, H5P_DEFAULT, creation, access));
    require(dataset.valid(), "HDF5 cannot create dataset " + name);
    new_text(dataset.get(), "units", unit);
    new_text(dataset.get(), "long_name", description);
    return dataset;
  }

  /// Datasets of a group are mostly made one after the other.
  void open_group(const std::string& name) {
    if (parent.valid() && parent_name == name) return;
    if (name != "/") make_groups(name);
    parent = Handle(H5Gopen2(file.handle.get(), name.c_str(), H5P_DEFAULT));
    parent_name = name;
    require(parent.valid(), "HDF5 cannot open group " + name);
  }

  /// Of an object that has no such attribute yet.
  void new_text(hid_t object, const char* name, std::string_view value) {
    const std::string copy(value);
    const char* pointer = copy.c_str();
    const Handle attribute(H5Acreate2(object, name, text.get(), scalar.get(), H5P_DEFAULT, H5P_DEFAULT));
    require(attribute.valid() && H5Awrite(attribute.get(), text.get(), &pointer) >= 0,
            std::string("HDF5 cannot write attribute ") + name);
  }

  hid_t creation_of(const std::vector<hsize_t>& chunk) {
    Handle& list = creations[chunk];
    if (list.valid()) return list.get();
    list = Handle(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_chunk(list.get(), static_cast<int>(chunk.size()), chunk.data());
    return list.get();
  }

  void make_scale(const Handle& dataset, const std::string& name) {
    require(scales->make_scale(dataset.get(), name), "HDF5 cannot make " + name + " a dimension");
  }

  void name_dimensions(const Handle& dataset, const std::string& name, const std::vector<std::string>& dimensions) {
    require(scales->attach(dataset.get(), name, dimensions), "HDF5 cannot name the dimensions of " + name);
  }

  /// A dimension of that name, which counts where it was not there before.
  std::string numbers(const std::string& name, std::size_t count, std::string_view description) {
    if (scales->has(name)) return name;
    std::vector<double> values(count);
    std::iota(values.begin(), values.end(), 0.0);
    write_constant(name, values, "1", description);
    return name;
  }

  /// The dimension of `count` columns: as asked for, or that of a vector's components.
  std::string columns(const std::string& name, std::size_t count, std::string_view asked) {
    if (asked == xyz || (asked.empty() && count == 3)) return letters(std::string(xyz), "xyz");
    if (asked.empty() && count == 2) return letters("/xy", "xy");
    if (asked.empty() && count == 4) return letters("/wxyz", "wxyz");
    const std::string scale = asked.empty() ? name + "_column" : absolute(asked);
    return numbers(scale, count, "place, counted from 0");
  }

  std::string letters(const std::string& name, std::string_view axes) {
    std::vector<std::string> texts;
    for (const char axis : axes) texts.emplace_back(1, axis);
    if (!scales->has(name)) write_labels(name, texts, "components of vectors");
    return name;
  }

  void write_labels(const std::string& name, const std::vector<std::string>& texts, std::string_view description) {
    std::vector<const char*> pointers;
    pointers.reserve(texts.size());
    for (const std::string& one : texts) pointers.push_back(one.c_str());
    const hsize_t n = texts.size();
    const Handle space(H5Screate_simple(1, &n, nullptr));
    const Handle dataset = make_dataset(name, text.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, "1", description);
    require(H5Dwrite(dataset.get(), text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0,
            "HDF5 cannot write text");
    make_scale(dataset, name);
  }

  void write_constant(const std::string& name, std::span<const double> values, std::string_view unit,
                      std::string_view description, std::string_view dimension = {}) {
    const hsize_t n = values.size();
    const Handle space(H5Screate_simple(1, &n, nullptr));
    const Handle dataset = make_dataset(name, H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT, unit, description);
    require(H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
            "HDF5 cannot write a constant");
    if (dimension.empty())
      make_scale(dataset, name);
    else
      name_dimensions(dataset, name, {columns(name, n, dimension)});
  }

  std::size_t make_growing(std::string_view name, const std::vector<hsize_t>& row_shape, std::string_view unit,
                           std::string_view description, Precision precision, std::vector<std::string> dimensions) {
    const Clock::time_point began = Clock::now();
    std::vector<hsize_t> shape{0}, largest{H5S_UNLIMITED}, chunk{1};
    for (const hsize_t n : row_shape) {
      HERSEY_REQUIRE(n > 0, "a row has numbers");
      for (std::vector<hsize_t>* sizes : {&shape, &largest, &chunk}) sizes->push_back(n);
    }
    const std::size_t width = std::accumulate(row_shape.begin(), row_shape.end(), std::size_t{1}, std::multiplies<>());
    const std::size_t chunk_rows = GrowingDataset::chunk_rows(width, options.rows);
    chunk[0] = chunk_rows;
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), largest.data()));
    const hid_t type = precision == Precision::float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
    const std::string path_ = absolute(name);
    Handle dataset = make_dataset(path_, type, space.get(), creation_of(chunk), without_cache.get(), unit, description);
    const std::string rows = scales->of_rows(path_);
    if (rows == path_ && row_shape.empty()) make_scale(dataset, rows);
    if (scales->has(rows) && rows != path_) {
      dimensions.insert(dimensions.begin(), rows);
      name_dimensions(dataset, path_, dimensions);
    }
    const NumberSize size = precision == Precision::float32 ? NumberSize::four_bytes : NumberSize::eight_bytes;
    return flow.add({path_, std::move(dataset), row_shape, chunk_rows, size},
                    std::chrono::duration<double>(Clock::now() - began).count());
  }

  /// Room for a row, or for rows that are handed over together.
  std::span<double> open_row(std::size_t width) {
    if (!in_memory) return flow.open(width);
    open_rows.assign(width, 0);
    return open_rows;
  }

  /// What was opened last is a row of each of these series.
  void add_open_row(std::size_t first, std::size_t count) {
    if (!in_memory) return flow.add_opened(first, count);
    auto at = open_rows.begin();
    for (std::size_t series = first; series < first + count; ++series) {
      const auto end = at + static_cast<std::ptrdiff_t>(width(series));
      latest[series].values.assign(at, end);
      at = end;
    }
  }

  [[nodiscard]] std::size_t width(std::size_t series) const {
    return in_memory ? numbers_of(latest.at(series).shape) : flow.width(series);
  }

  /// To be alone with the file, rows handed over being in it.
  [[nodiscard]] Hdf5Session enter() {
    flow.settle();
    return Hdf5Session();
  }
};

Writer::Writer(std::filesystem::path path, Options options) {
  const Hdf5Session session;
  impl_ = std::make_unique<Impl>(options);
  impl_->file.path = std::move(path);
  impl_->file.open(options.overwrite);
  impl_->scales.emplace(impl_->file.handle.get());
  attribute("/", "format", "hersey-results");
  attribute("/", "format_version", 1);
  attribute("/", "created", now_iso8601());
  attribute("/", "status", to_string(Status::running));
  attribute("/", "message", "");
  impl_->flow.flush();
}

Writer::Writer(InMemory) : impl_(std::make_unique<Impl>(Options{})) { impl_->in_memory = true; }

Writer::~Writer() {
  try {
    finish(Status::failed, "ended by an error");
  } catch (const std::exception&) {
    // The file is closed, in the state of its last good flush; a destructor has no one to tell.
  }
}

void Writer::attribute(std::string_view object, std::string_view name, std::string_view text) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  impl_->set_text(impl_->open_or_make(absolute(object)).get(), name, text);
}

void Writer::attribute(std::string_view object, std::string_view name, double value) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  const Handle target = impl_->open_or_make(absolute(object));
  impl_->set_attribute(target.get(), name, H5T_NATIVE_DOUBLE, impl_->scalar.get(), &value);
}

void Writer::attribute(std::string_view object, std::string_view name, int value) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  const Handle target = impl_->open_or_make(absolute(object));
  impl_->set_attribute(target.get(), name, H5T_NATIVE_INT, impl_->scalar.get(), &value);
}

void Writer::attribute(std::string_view object, std::string_view name, const std::vector<std::string>& texts) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  std::vector<const char*> pointers;
  pointers.reserve(texts.size());
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t n = texts.size();
  const Handle space(n > 0 ? H5Screate_simple(1, &n, nullptr) : H5Screate(H5S_NULL));
  const Handle target = impl_->open_or_make(absolute(object));
  impl_->set_attribute(target.get(), name, impl_->text.get(), space.get(), pointers.data());
}

void Writer::text(std::string_view path, std::string_view content, std::string_view description) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  const Handle dataset =
      impl_->make_dataset(path, impl_->text.get(), impl_->scalar.get(), H5P_DEFAULT, H5P_DEFAULT, "1", description);
  const std::string copy(content);
  const char* pointer = copy.c_str();
  impl_->require(H5Dwrite(dataset.get(), impl_->text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &pointer) >= 0,
                 "HDF5 cannot write text");
}

void Writer::text_table(std::string_view path, const std::vector<std::pair<std::string, std::string>>& rows,
                        std::string_view description) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  std::vector<const char*> pointers;
  for (const auto& [name, content] : rows) pointers.insert(pointers.end(), {name.c_str(), content.c_str()});
  const std::array<hsize_t, 2> shape{rows.size(), 2};
  const Handle space(H5Screate_simple(2, shape.data(), nullptr));
  const Handle dataset =
      impl_->make_dataset(path, impl_->text.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, "1", description);
  if (rows.empty()) return;
  const std::string name = absolute(path);
  impl_->name_dimensions(dataset, name,
                         {impl_->numbers(name + "_row", rows.size(), "row of " + name + ", counted from 0"),
                          impl_->numbers(name + "_column", 2, "0: name; 1: text")});
  impl_->require(H5Dwrite(dataset.get(), impl_->text.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0,
                 "HDF5 cannot write a table");
}

void Writer::constant(std::string_view path, std::span<const double> values, std::string_view unit,
                      std::string_view description, std::string_view dimension) {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  HERSEY_REQUIRE(!values.empty(), "a constant has numbers");
  impl_->write_constant(absolute(path), values, unit, description, dimension);
}

void Writer::labels(std::string_view path, const std::vector<std::string>& names, std::string_view description) {
  if (impl_->in_memory) {
    impl_->words[absolute(path)] = names;
    return;
  }
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  HERSEY_REQUIRE(!names.empty(), "labels are of something");
  impl_->write_labels(absolute(path), names, description);
}

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
                                    "place, counted from 0"));
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

const std::vector<LatestRow>& Writer::latest() const { return impl_->latest; }

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

void Writer::rename(const std::filesystem::path& path, bool replace) {
  if (impl_->in_memory) return;
  impl_->flow.settle();
  impl_->file.require_open();
  impl_->file.sync();
  impl_->file.rename(path, replace);
}

void Writer::flush() {
  if (impl_->in_memory) return;
  const Hdf5Session session = impl_->enter();
  impl_->file.require_open();
  impl_->flow.flush();
}

void Writer::flush_if_due() {
  if (!impl_->in_memory) impl_->flow.end_step();
}

void Writer::finish(Status status, std::string_view message) {
  if (impl_->in_memory) return;
  if (!impl_->file.handle.valid()) return;
  std::exception_ptr untold;
  try {
    impl_->flow.settle();
  } catch (const WriteError&) {
    untold = std::current_exception();
  }
  const Hdf5Session session;
  const bool failed_before = impl_->file.status.failed;
  if (!failed_before) {
    try {
      impl_->flow.flush();  // whoever reads the status finds all the rest
      const Handle root(H5Oopen(impl_->file.handle.get(), "/", H5P_DEFAULT));
      impl_->set_text(root.get(), "status", to_string(status));
      impl_->set_text(root.get(), "message", message);
      impl_->flow.flush();
    } catch (const WriteError&) {
      untold = std::current_exception();
    }
  }
  impl_->flow.datasets().clear();
  impl_->parent.reset();
  impl_->file.close();
  if (untold) std::rethrow_exception(untold);
  if (failed_before) return;
  impl_->require(true, {});
  try {
    seal_file(impl_->file.path);
  } catch (const std::runtime_error&) {
    // All is there: without its seal the file is read as that of a run that was killed.
  }
}

const std::filesystem::path& Writer::path() const { return impl_->file.path; }

}  // namespace hersey::results
