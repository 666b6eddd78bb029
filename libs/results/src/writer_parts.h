#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "dimension_scales.h"
#include "growing_dataset.h"
#include "hdf5_handle.h"
#include "hersey/core/contract.h"
#include "hersey/results/writer.h"
#include "object_path.h"
#include "row_flow.h"

namespace hersey::results {

/// Numbers of an array of that shape.
[[nodiscard]] inline std::size_t numbers_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// Of datasets whose chunks are written whole.
[[nodiscard]] inline Handle without_chunk_cache() {
  Handle access(H5Pcreate(H5P_DATASET_ACCESS));
  H5Pset_chunk_cache(access.get(), 1, 0, 1.0);
  return access;
}

/// The file being written, and the objects made in it so far.
struct Writer::Impl {
  bool in_memory = false;
  std::vector<LatestRow> latest;  // in memory
  bool keeps_all = false;         // attributes and constants too; in memory
  Kept kept;
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

  void keep_attribute(std::string_view object, std::string_view name, Kept::Attribute value) {
    if (keeps_all) kept.attributes[absolute(object)][std::string(name)] = std::move(value);
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

  /// Overwrites an attribute of the same type and shape in place, which leaves the structure of the file unchanged.
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

  /// Adds an attribute to an object that does not have it yet.
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

  /// The dimension of `count` columns: the requested one, or that of a vector's components.
  std::string columns(const std::string& name, std::size_t count, std::string_view asked) {
    if (asked == xyz || (asked.empty() && count == 3)) return letters(std::string(xyz), "xyz");
    if (asked.empty() && count == 2) return letters("/xy", "xy");
    if (asked.empty() && count == 4) return letters("/wxyz", "wxyz");
    const std::string scale = asked.empty() ? name + "_column" : absolute(asked);
    return numbers(scale, count, "index, counted from 0");
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
    const std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
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
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  }

  /// Room for a row, or for rows that are handed over together.
  std::span<double> open_row(std::size_t width) {
    if (!in_memory) return flow.open(width);
    open_rows.assign(width, 0);
    return open_rows;
  }

  /// The rows opened last are one for each of these series.
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

  /// Gets exclusive access to the file with all passed rows in it.
  [[nodiscard]] Hdf5Session enter() {
    flow.settle();
    return Hdf5Session();
  }
};

}  // namespace hersey::results
