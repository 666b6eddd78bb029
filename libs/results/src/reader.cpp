#include "hersey/results/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_set>

#include "dimension_scales.h"
#include "hdf5_handle.h"
#include "hersey/core/hdf5_content.h"
#include "hersey/core/input_file.h"
#include "hersey/core/sealed_file.h"
#include "object_path.h"

namespace hersey::results {
namespace {

constexpr int newest_format = 1;
constexpr int deepest_group = 32;

bool grows(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1) return false;
  std::vector<hsize_t> now(static_cast<std::size_t>(rank)), largest(now.size());
  H5Sget_simple_extent_dims(space, now.data(), largest.data());
  return largest[0] == H5S_UNLIMITED;
}

/// Adds name to the list `data` points to.
herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* data) {
  static_cast<std::vector<std::string>*>(data)->emplace_back(name);
  return 0;
}

herr_t collect_link(hid_t, const char* name, const H5L_info_t*, void* data) {
  static_cast<std::vector<std::string>*>(data)->emplace_back(name);
  return 0;
}

}  // namespace

std::size_t Array::width() const {
  std::size_t width = 1;
  for (std::size_t i = 1; i < info.shape.size(); ++i) width *= info.shape[i];
  return width;
}

struct Reader::Impl {
  std::filesystem::path path;
  Handle file;
  bool is_sealed = false;
  std::vector<std::string> groups, datasets;
  std::unordered_set<std::string> known;             // of them all
  std::map<std::string, std::size_t> complete_rows;  // per growth group
  std::map<std::string, DatasetInfo> infos;          // of datasets asked for: HDF5 takes long to open one

  [[noreturn]] void fail(const std::string& reason) const { throw ReadError(path, reason); }

  /// Path of the file if no checksum covers the structure that HDF5 reads.
  [[nodiscard]] const char* untrusted_path() const { return is_sealed || path.empty() ? nullptr : path.c_str(); }

  void open() {
    if (std::error_code error; !std::filesystem::exists(path, error)) fail("there is no such file");
    if (const auto failure = unreadable(path)) fail("it is " + *failure);
    // The seal is checked before HDF5 reads the file: the library trusts the structure that it finds.
    const Seal seal = check_seal(path);
    if (seal == Seal::broken) fail("damaged: it has changed since it was written");
    is_sealed = seal == Seal::intact;
    const UntrustedFile untrusted_file(untrusted_path());
    const Handle access(H5Pcreate(H5P_FILE_ACCESS));
    keep_metadata(access.get());
    file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()));
    if (!file.valid()) fail("not a readable HDF5 file");
    if (const std::string foreign = foreign_content(file.get(), path); !foreign.empty())
      fail("no results file of hersey: it has " + foreign);
  }

  [[nodiscard]] bool exists(const std::string& name) const {
    if (known.contains(name)) return true;
    if (name == "/") return true;
    return has_object(file.get(), name);
  }

  [[nodiscard]] Handle attribute(std::string_view object, std::string_view name) const {
    const std::string where = absolute(object), key(name);
    if (!exists(where)) return {};
    if (H5Aexists_by_name(file.get(), where.c_str(), key.c_str(), H5P_DEFAULT) <= 0) return {};
    return Handle(H5Aopen_by_name(file.get(), where.c_str(), key.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  }

  [[nodiscard]] std::vector<std::string> texts(hid_t attribute) const {
    const Handle type(H5Aget_type(attribute)), space(H5Aget_space(attribute));
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) <= 0) return {};
    const hssize_t n = H5Sget_simple_extent_npoints(space.get());
    std::vector<char*> raw(static_cast<std::size_t>(std::max<hssize_t>(n, 0)), nullptr);
    const Handle memory = text_type();
    if (raw.empty() || H5Aread(attribute, memory.get(), raw.data()) < 0) return {};
    return take(raw, memory.get(), space.get());
  }

  /// Copies HDF5's strings and gives their memory back.
  static std::vector<std::string> take(std::vector<char*>& raw, hid_t type, hid_t space) {
    std::vector<std::string> texts;
    texts.reserve(raw.size());
    for (const char* text : raw) texts.emplace_back(text != nullptr ? text : "");
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
    return texts;
  }

  [[nodiscard]] Handle dataset(const std::string& name) const {
    Handle dataset(exists(name) ? H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT) : H5I_INVALID_HID);
    if (!dataset.valid()) fail("there is no dataset " + name);
    return dataset;
  }

  [[nodiscard]] std::vector<std::string> dataset_texts(const std::string& name) const {
    const Handle source = dataset(name);
    const Handle type(H5Dget_type(source.get())), space(H5Dget_space(source.get())), memory = text_type();
    if (H5Tget_class(type.get()) != H5T_STRING) fail(name + " does not hold text");
    std::vector<char*> raw(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())), nullptr);
    if (raw.empty()) return {};
    if (H5Dread(source.get(), memory.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) < 0) fail("cannot read " + name);
    return take(raw, memory.get(), space.get());
  }

  /// Lists all groups and datasets below `group`, and the number of complete rows.
  void survey(const std::string& group) {
    if (std::count(group.begin(), group.end(), '/') > deepest_group) fail("damaged: groups within groups without end");
    groups.push_back(group);
    known.insert(group);
    const Handle parent(H5Gopen2(file.get(), group.c_str(), H5P_DEFAULT));
    std::vector<std::string> names;
    H5Literate(parent.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_link, &names);
    for (const std::string& name : names) {
      const std::string child = (group == "/" ? "" : group) + "/" + name;
      const Handle object(H5Oopen(parent.get(), name.c_str(), H5P_DEFAULT));
      const H5I_type_t kind = H5Iget_type(object.get());
      if (kind == H5I_GROUP) survey(child);
      if (kind == H5I_DATASET && !is_further_name(child, object.get())) {
        datasets.push_back(child);
        known.insert(child);
        count_rows(child, object.get());
      }
    }
  }

  /// True for a link to a dimension scale that has another name, too.
  [[nodiscard]] bool is_further_name(const std::string& name, hid_t object) const {
    H5O_info_t about{};
    if (H5Oget_info2(object, &about, H5O_INFO_BASIC) < 0 || about.rc < 2) return false;
    const std::optional<std::string> first = fixed_text(object, scale_path);
    return first && *first != name;
  }

  [[nodiscard]] static std::optional<std::string> fixed_text(hid_t object, const char* name) {
    if (H5Aexists(object, name) <= 0) return std::nullopt;
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT)), type(H5Aget_type(attribute.get()));
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) return std::nullopt;
    std::string text(H5Tget_size(type.get()), '\0');
    if (H5Aread(attribute.get(), type.get(), text.data()) < 0) return std::nullopt;
    return text.substr(0, text.find('\0'));
  }

  /// Paths of the scales that a dataset's list names, one for each dimension.
  [[nodiscard]] std::vector<std::string> scales_of(hid_t object) const {
    if (H5Aexists(object, "DIMENSION_LIST") <= 0) return {};
    const Handle list(H5Aopen(object, "DIMENSION_LIST", H5P_DEFAULT)), space(H5Aget_space(list.get()));
    const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ));
    std::vector<hvl_t> references(
        static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0)));
    std::vector<std::string> paths;
    if (references.empty() || H5Aread(list.get(), type.get(), references.data()) < 0) return paths;
    for (const hvl_t& reference : references) {
      if (reference.len == 0) break;
      const Handle scale(H5Rdereference2(object, H5P_DEFAULT, H5R_OBJECT, reference.p));
      const std::optional<std::string> path_there = scale.valid() ? fixed_text(scale.get(), scale_path) : std::nullopt;
      if (!path_there) break;
      paths.push_back(*path_there);
    }
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, references.data());
    return paths;
  }

  void count_rows(const std::string& name, hid_t object) {
    const Handle space(H5Dget_space(object));
    if (!grows(space.get())) return;
    const std::size_t rows = extent_of(space.get())[0];
    const auto [entry, added] = complete_rows.try_emplace(growth_group(name), rows);
    entry->second = std::min(entry->second, rows);
  }

  [[nodiscard]] std::optional<std::string> text_of(hid_t object, const char* name) const {
    if (H5Aexists(object, name) <= 0) return std::nullopt;
    const Handle attribute(H5Aopen(object, name, H5P_DEFAULT));
    std::vector<std::string> all = texts(attribute.get());
    if (all.size() != 1) return std::nullopt;
    return std::move(all[0]);
  }

  [[nodiscard]] DatasetInfo info(const std::string& name) {
    if (const auto found = infos.find(name); found != infos.end()) return found->second;
    const Handle opened = dataset(name), space(H5Dget_space(opened.get()));
    return infos.emplace(name, info(name, opened, space)).first->second;
  }

  [[nodiscard]] DatasetInfo info(const std::string& name, const Handle& dataset, const Handle& space) const {
    DatasetInfo info;
    info.shape = extent_of(space.get());
    info.grows = grows(space.get());
    if (info.grows) info.shape[0] = std::min(info.shape[0], complete_rows.at(growth_group(name)));
    const Handle type(H5Dget_type(dataset.get()));
    info.is_text = H5Tget_class(type.get()) == H5T_STRING;
    info.is_float32 = H5Tget_class(type.get()) == H5T_FLOAT && H5Tget_size(type.get()) == sizeof(float);
    info.unit = text_of(dataset.get(), "units").value_or("1");
    info.description = text_of(dataset.get(), "long_name").value_or("");
    if (info.description.empty())
      info.description = text_of(dataset.get(), "description").value_or("");  // of earlier versions
    return info;
  }
};

Reader::Reader(std::filesystem::path path) : impl_(std::make_unique<Impl>()) {
  const Hdf5Session session(impl_->untrusted_path());
  impl_->path = std::move(path);
  impl_->open();
  const UntrustedFile untrusted_file(impl_->untrusted_path());
  if (text_attribute("/", "format") != "hersey-results") impl_->fail("HDF5, but not a results file of hersey");
  const double version = number_attribute("/", "format_version").value_or(0);
  if (version < 1 || version > newest_format)
    impl_->fail(fmt::format("results format {}; this program reads formats up to {}", version, newest_format));
  impl_->survey("/");
  std::sort(impl_->datasets.begin(), impl_->datasets.end());
}

Reader::~Reader() = default;

bool Reader::has(std::string_view path) const {
  const Hdf5Session session(impl_->untrusted_path());
  return impl_->exists(absolute(path));
}

const std::vector<std::string>& Reader::groups() const { return impl_->groups; }

const std::vector<std::string>& Reader::datasets() const { return impl_->datasets; }

std::vector<std::string> Reader::children(std::string_view group) const {
  const Hdf5Session session(impl_->untrusted_path());
  std::vector<std::string> names;
  const std::string name = absolute(group);
  if (!impl_->exists(name)) return names;
  const Handle parent(H5Gopen2(impl_->file.get(), name.c_str(), H5P_DEFAULT));
  if (parent.valid()) H5Literate(parent.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_link, &names);
  return names;
}

std::vector<std::string> Reader::attributes(std::string_view object) const {
  const Hdf5Session session(impl_->untrusted_path());
  std::vector<std::string> names;
  const std::string name = absolute(object);
  if (!impl_->exists(name)) return names;
  const Handle owner(H5Oopen(impl_->file.get(), name.c_str(), H5P_DEFAULT));
  H5Aiterate2(owner.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names);
  return names;
}

std::optional<std::string> Reader::text_attribute(std::string_view object, std::string_view name) const {
  const Hdf5Session session(impl_->untrusted_path());
  const Handle attribute = impl_->attribute(object, name);
  if (!attribute.valid()) return std::nullopt;
  const Handle space(H5Aget_space(attribute.get()));
  std::vector<std::string> texts = impl_->texts(attribute.get());
  if (texts.size() != 1 || H5Sget_simple_extent_type(space.get()) != H5S_SCALAR) return std::nullopt;
  return std::move(texts[0]);
}

std::optional<double> Reader::number_attribute(std::string_view object, std::string_view name) const {
  const Hdf5Session session(impl_->untrusted_path());
  const Handle attribute = impl_->attribute(object, name);
  if (!attribute.valid()) return std::nullopt;
  const Handle type(H5Aget_type(attribute.get())), space(H5Aget_space(attribute.get()));
  const H5T_class_t kind = H5Tget_class(type.get());
  double value = 0;
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || H5Sget_simple_extent_npoints(space.get()) != 1) return std::nullopt;
  if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0) return std::nullopt;
  return value;
}

std::vector<std::string> Reader::list_attribute(std::string_view object, std::string_view name) const {
  const Hdf5Session session(impl_->untrusted_path());
  const Handle attribute = impl_->attribute(object, name);
  return attribute.valid() ? impl_->texts(attribute.get()) : std::vector<std::string>{};
}

DatasetInfo Reader::info(std::string_view path) const {
  const Hdf5Session session(impl_->untrusted_path());
  return impl_->info(absolute(path));
}

Array Reader::read(std::string_view path) const { return read_rows(path, 0, std::numeric_limits<std::size_t>::max()); }

Array Reader::read_rows(std::string_view path, std::size_t first, std::size_t count, std::size_t stride) const {
  const Hdf5Session session(impl_->untrusted_path());
  const std::string name = absolute(path);
  const Handle dataset = impl_->dataset(name);
  const Handle type(H5Dget_type(dataset.get())), space(H5Dget_space(dataset.get()));
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) impl_->fail(name + " does not hold numbers");
  Array array{impl_->info(name), {}};
  if (array.info.shape.empty()) impl_->fail(name + " has no rows");
  stride = std::max<std::size_t>(stride, 1);
  const std::size_t rows = array.info.shape[0];
  const std::size_t available = first < rows ? (rows - first - 1) / stride + 1 : 0;
  array.info.shape[0] = std::min(count, available);
  array.values.resize(array.info.shape[0] * array.width());
  if (array.values.empty()) return array;

  std::vector<hsize_t> counts(array.info.shape.begin(), array.info.shape.end());
  std::vector<hsize_t> starts(counts.size(), 0), strides(counts.size(), 1);
  starts[0] = first;
  strides[0] = stride;
  const Handle memory(H5Screate_simple(static_cast<int>(counts.size()), counts.data(), nullptr));
  const bool good =
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, starts.data(), strides.data(), counts.data(), nullptr) >= 0 &&
      H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, array.values.data()) >= 0;
  if (!good) impl_->fail("cannot read " + name);
  return array;
}

std::vector<std::string> Reader::dimensions(std::string_view path) const {
  const Hdf5Session session(impl_->untrusted_path());
  const std::string name = absolute(path);
  const Handle dataset = impl_->dataset(name);
  if (const auto own = Impl::fixed_text(dataset.get(), scale_path)) return {*own};
  return impl_->scales_of(dataset.get());
}

std::vector<std::string> Reader::texts(std::string_view path) const {
  const Hdf5Session session(impl_->untrusted_path());
  return impl_->dataset_texts(absolute(path));
}

std::string Reader::text(std::string_view path) const {
  const Hdf5Session session(impl_->untrusted_path());
  const std::string name = absolute(path);
  std::vector<std::string> texts = impl_->dataset_texts(name);
  if (texts.size() != 1) impl_->fail(name + " is not a single text");
  return std::move(texts[0]);
}

std::vector<std::pair<std::string, std::string>> Reader::text_table(std::string_view path) const {
  const Hdf5Session session(impl_->untrusted_path());
  std::vector<std::string> texts = impl_->dataset_texts(absolute(path));
  std::vector<std::pair<std::string, std::string>> rows;
  for (std::size_t i = 0; i + 1 < texts.size(); i += 2) rows.emplace_back(std::move(texts[i]), std::move(texts[i + 1]));
  return rows;
}

std::size_t Reader::rows() const {
  const auto entry = impl_->complete_rows.find("/");
  return entry == impl_->complete_rows.end() ? 0 : entry->second;
}

const std::filesystem::path& Reader::path() const { return impl_->path; }

}  // namespace hersey::results
