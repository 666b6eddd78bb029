// NetCDF-4 by its own specification ("HDF5 format of netCDF-4", NetCDF User's Guide, appendix B): dimensions are HDF5
// dimension scales, links and attributes keep the order in which they were made.
#include "hersey/results/netcdf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <system_error>

#include "dimension_scales.h"
#include "hdf5_handle.h"
#include "hersey/results/writer.h"

namespace hersey::results {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t copied_numbers = 1u << 20;  // at a time: 8 MB
constexpr unsigned in_order = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

std::string parent_of(const std::string& path) { return path.substr(0, path.rfind('/')); }
std::string last_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// The unit as CF wants it: without numbers beside a named unit.
std::string cf_unit(const std::string& unit) { return unit.starts_with("1/") ? unit.substr(2) + "-1" : unit; }

/// A name of an attribute as CF recommends it.
std::string cf_name(std::string name) {
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '.' && letter != '-') letter = '_';
  return name;
}

bool is_strictly_monotonic(const std::vector<double>& values) {
  const auto falls = [](double a, double b) { return !(a < b); };
  const auto rises = [](double a, double b) { return !(a > b); };
  if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) return false;
  return std::adjacent_find(values.begin(), values.end(), falls) == values.end() ||
         std::adjacent_find(values.begin(), values.end(), rises) == values.end();
}

/// A column of rows.
Array column_of(const Array& rows, std::size_t column) {
  Array picked{rows.info, {}};
  picked.info.shape = {rows.info.shape.at(0)};
  for (std::size_t at = column; at < rows.values.size(); at += rows.width()) picked.values.push_back(rows.values[at]);
  return picked;
}

/// A dimension of the results in the copy.
struct CopiedDimension {
  std::string scale;      ///< path of the scale
  std::string auxiliary;  ///< path of the variable with its values where they are no coordinate variable
  std::string length;     ///< path of the dimension along the letters of these values; empty: they are numbers
};

/// The file being written.
class NetcdfFile {
 public:
  NetcdfFile(const Reader& results, Path path)
      : results_(results), path_(std::move(path)), unfinished_(path_.string() + ".new") {
    const Handle creation(H5Pcreate(H5P_FILE_CREATE));
    H5Pset_link_creation_order(creation.get(), in_order);
    H5Pset_attr_creation_order(creation.get(), in_order);
    file_ = Handle(H5Fcreate(unfinished_.c_str(), H5F_ACC_TRUNC, creation.get(), H5P_DEFAULT));
    require(file_.valid());
    scales_.emplace(file_.get());
  }
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;
  ~NetcdfFile() {
    if (is_whole_) return;
    file_.reset();
    std::error_code ignored;
    std::filesystem::remove(unfinished_, ignored);
  }

  NetcdfSummary write(const std::string& history) {
    for (const std::string& group : results_.groups()) copy_group(group);
    write_conventions(history);
    NetcdfSummary summary;
    for (const std::string& name : results_.datasets()) {
      const DatasetInfo info = results_.info(name);
      if (std::find(info.shape.begin(), info.shape.end(), std::size_t{0}) != info.shape.end()) continue;
      if (info.unit == "SI") {
        const std::size_t columns = copy_columns(name, info);
        summary.variables += columns;
        if (columns == 0) summary.left_out.push_back(name);
        continue;
      }
      ++summary.variables;
      if (!is_dimension(name))
        copy_dataset(name, info);
      else
        static_cast<void>(dimension(name));
    }
    close();
    return summary;
  }

 private:
  void require(bool good) const {
    if (!good) throw WriteError(path_, "it cannot be written");
  }

  void close() {
    scales_.reset();
    require(file_.reset());
    std::error_code error;
    std::filesystem::rename(unfinished_, path_, error);
    require(!error);
    is_whole_ = true;
  }

  // Text has one length, in UTF-8; netCDF has none of length 0.
  void text_attribute(hid_t object, const std::string& name, const std::string& text) const {
    const Handle type(H5Tcopy(H5T_C_S1)), space(H5Screate(text.empty() ? H5S_NULL : H5S_SCALAR));
    H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1));
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    const Handle made(H5Acreate2(object, name.c_str(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT));
    require(made.valid() && (text.empty() || H5Awrite(made.get(), type.get(), text.data()) >= 0));
  }

  void number_attribute(hid_t object, const std::string& name, double value) const {
    const Handle space(H5Screate(H5S_SCALAR));
    const Handle made(H5Acreate2(object, name.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT));
    require(made.valid() && H5Awrite(made.get(), H5T_NATIVE_DOUBLE, &value) >= 0);
  }

  void copy_group(const std::string& group) const {
    if (group != "/") {
      const Handle creation(H5Pcreate(H5P_GROUP_CREATE));
      H5Pset_link_creation_order(creation.get(), in_order);
      H5Pset_attr_creation_order(creation.get(), in_order);
      const Handle made(H5Gcreate2(file_.get(), group.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT));
      require(made.valid());
    }
    const Handle object(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT));
    for (const std::string& name : results_.attributes(group)) {
      if (const auto text = results_.text_attribute(group, name))
        text_attribute(object.get(), cf_name(name), *text);
      else if (const auto number = results_.number_attribute(group, name))
        number_attribute(object.get(), cf_name(name), *number);
      else if (const auto list = results_.list_attribute(group, name); !list.empty())
        text_attribute(object.get(), cf_name(name), fmt::format("{}", fmt::join(list, ", ")));
    }
  }

  void write_conventions(const std::string& history) const {
    const Handle root(H5Gopen2(file_.get(), "/", H5P_DEFAULT));
    text_attribute(root.get(), "Conventions", cf_conventions);
    const std::string program = results_.text_attribute("/", "hersey_version").value_or("");
    text_attribute(root.get(), "source", program.empty() ? "hersey" : "hersey " + program);
    const std::string created = results_.text_attribute("/", "created").value_or("");
    text_attribute(root.get(), "history", created.empty() ? history : created + " run\n" + history);
  }

  [[nodiscard]] bool is_dimension(const std::string& name) const {
    return results_.dimensions(name) == std::vector<std::string>{name};
  }

  [[nodiscard]] Handle create(const std::string& name, hid_t type, const std::vector<std::size_t>& shape) const {
    const std::vector<hsize_t> sizes(shape.begin(), shape.end());
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_attr_creation_order(creation.get(), in_order);
    const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr));
    Handle data(H5Dcreate2(file_.get(), name.c_str(), type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT));
    require(data.valid());
    return data;
  }

  /// A name that no data of the results have.
  [[nodiscard]] std::string free_name(std::string name) const {
    while (results_.has(name)) name += '_';
    return name;
  }

  /// A dimension that counts, without values of its own.
  void create_bare_dimension(const std::string& name, std::size_t size) {
    const Handle data = create(name, H5T_IEEE_F32BE, {size});
    require(scales_->make_scale(data.get(), name,
                                fmt::format("This is a netCDF dimension but not a netCDF variable.{:10}", size)));
  }

  /// The dimension of texts of that many bytes.
  std::string length_dimension(std::size_t bytes) {
    const std::string name = free_name(fmt::format("/length_{}", bytes));
    if (!scales_->has(name)) create_bare_dimension(name, bytes);
    return name;
  }

  /// The copy of a dimension, which is made when it is first asked for.
  const CopiedDimension& dimension(const std::string& path) {
    if (const auto found = dimensions_.find(path); found != dimensions_.end()) return found->second;
    const DatasetInfo info = results_.info(path);
    CopiedDimension made{path, {}, {}};
    if (info.is_text) {
      made.auxiliary = free_name(path + "_name");
      create_bare_dimension(path, info.shape.at(0));
      made.length = write_text(made.auxiliary, path, info, {path});
    } else if (const std::vector<double> values = results_.read(path).values; is_strictly_monotonic(values)) {
      const Handle data = write_numbers(path, path, info);
      require(scales_->make_scale(data.get(), path));
    } else {
      made = {free_name(path + "_number"), path, {}};
      create_bare_dimension(made.scale, values.size());
      const Handle data = write_numbers(path, path, info);
      require(scales_->attach(data.get(), path, {made.scale}));
      text_attribute(data.get(), scale_path, path);
    }
    return dimensions_.emplace(path, std::move(made)).first->second;
  }

  void copy_dataset(const std::string& name, const DatasetInfo& info) {
    std::vector<std::string> scales;
    std::string coordinates;
    const std::vector<std::string> dimensions = results_.dimensions(name);
    for (std::size_t axis = 0; axis < info.shape.size(); ++axis) {
      if (axis >= dimensions.size()) {
        scales.push_back(free_name(fmt::format("{}_dimension_{}", name, axis)));
        create_bare_dimension(scales.back(), info.shape[axis]);
        continue;
      }
      const CopiedDimension& copied = dimension(dimensions[axis]);
      scales.push_back(copied.scale);
      if (copied.auxiliary.empty()) continue;
      for (const std::string& beside : {copied.auxiliary, copied.length})
        require(beside.empty() || scales_->link(beside, parent_of(name)));
      coordinates += (coordinates.empty() ? "" : " ") + last_of(copied.auxiliary);
    }
    if (info.is_text) {
      write_text(name, name, info, scales);
      return;
    }
    const Handle data = write_numbers(name, name, info);
    require(scales_->attach(data.get(), name, scales));
    if (!coordinates.empty()) text_attribute(data.get(), "coordinates", coordinates);
  }

  /// Columns with units of their own, each as a variable. Returns how many; 0 where the results do not tell the units.
  std::size_t copy_columns(const std::string& name, DatasetInfo info) {
    const std::vector<std::string> units = results_.list_attribute(name, column_units),
                                   dimensions = results_.dimensions(name);
    if (info.shape.size() != 2 || units.size() != info.shape[1] || dimensions.size() != 2) return 0;
    if (!results_.info(dimensions[1]).is_text) return 0;
    const std::vector<std::string> labels = results_.texts(dimensions[1]);
    const std::string rows = dimension(dimensions[0]).scale, description = info.description;
    info.shape.pop_back();
    for (std::size_t k = 0; k < units.size(); ++k) {
      info.unit = units[k];
      info.description = description + ": " + labels[k];
      const std::string column = free_name(name + "_" + cf_name(labels[k]));
      const Handle data = write_numbers(column, name, info, k);
      require(scales_->attach(data.get(), column, {rows}));
    }
    return units.size();
  }

  /// Numbers of the results, block by block, with unit and description.
  /// @param column  the only one that is wanted
  [[nodiscard]] Handle write_numbers(const std::string& name, const std::string& from, const DatasetInfo& info,
                                     std::optional<std::size_t> column = {}) const {
    Handle data = create(name, info.is_float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, info.shape);
    const std::size_t width = std::max<std::size_t>(1, Array{info, {}}.width());
    const std::size_t block = std::max<std::size_t>(1, copied_numbers / width);
    bool has_gaps = false;
    for (std::size_t first = 0; first < info.shape.at(0); first += block) {
      const Array part =
          column ? column_of(results_.read_rows(from, first, block), *column) : results_.read_rows(from, first, block);
      has_gaps =
          has_gaps || std::any_of(part.values.begin(), part.values.end(), [](double v) { return std::isnan(v); });
      write_rows(data.get(), part, first);
    }
    describe(data.get(), info);
    if (has_gaps) mark_gaps(data.get(), info.is_float32);
    return data;
  }

  void write_rows(hid_t data, const Array& part, std::size_t first) const {
    const Handle space(H5Dget_space(data));
    std::vector<hsize_t> counts(part.info.shape.begin(), part.info.shape.end()), starts(counts.size(), 0);
    starts[0] = first;
    const Handle rows(H5Screate_simple(static_cast<int>(counts.size()), counts.data(), nullptr));
    require(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, starts.data(), nullptr, counts.data(), nullptr) >= 0 &&
            H5Dwrite(data, H5T_NATIVE_DOUBLE, rows.get(), space.get(), H5P_DEFAULT, part.values.data()) >= 0);
  }

  /// Missing values have the type of the others.
  void mark_gaps(hid_t data, bool is_single) const {
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    const hsize_t one = 1;
    const Handle space(H5Screate_simple(1, &one, nullptr));
    const Handle made(H5Acreate2(data, "_FillValue", is_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE, space.get(),
                                 H5P_DEFAULT, H5P_DEFAULT));
    require(made.valid() && H5Awrite(made.get(), H5T_NATIVE_DOUBLE, &gap) >= 0);
  }

  void describe(hid_t data, const DatasetInfo& info) const {
    text_attribute(data, "long_name", info.description);
    if (info.is_text || info.unit.empty()) return;
    text_attribute(data, "units", cf_unit(info.unit));
    // Every temperature in degC is one, every one in K or per K a difference.
    if (info.unit == "degC") text_attribute(data, "units_metadata", "temperature: on_scale");
    if (info.unit.find('K') != std::string::npos) text_attribute(data, "units_metadata", "temperature: difference");
  }

  /// Texts as rows of characters, padded with nulls to the longest. Returns the dimension along them.
  std::string write_text(const std::string& name, const std::string& from, const DatasetInfo& info,
                         std::vector<std::string> scales) {
    const std::vector<std::string> texts = results_.texts(from);
    std::size_t bytes = 1;
    for (const std::string& text : texts) bytes = std::max(bytes, text.size());
    std::vector<char> letters(bytes * texts.size(), '\0');
    for (std::size_t i = 0; i < texts.size(); ++i)
      std::copy(texts[i].begin(), texts[i].end(), letters.begin() + static_cast<std::ptrdiff_t>(i * bytes));
    std::vector<std::size_t> shape = info.shape;
    shape.push_back(bytes);
    const Handle data = create(name, H5T_C_S1, shape);
    require(H5Dwrite(data.get(), H5T_C_S1, H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data()) >= 0);
    describe(data.get(), info);
    text_attribute(data.get(), "_Encoding", "utf-8");
    text_attribute(data.get(), scale_path, name);
    const std::string length = length_dimension(bytes);
    scales.push_back(length);
    require(scales_->attach(data.get(), name, scales));
    return length;
  }

  const Reader& results_;
  Path path_, unfinished_;
  bool is_whole_ = false;
  Handle file_;
  std::optional<DimensionScales> scales_;
  std::map<std::string, CopiedDimension> dimensions_;  ///< by the path of the dimension in the results
};

}  // namespace

NetcdfSummary write_netcdf(const Reader& results, const std::filesystem::path& path, const std::string& history) {
  const Hdf5Session session;  // the reader's own sessions are of the same thread
  return NetcdfFile(results, path).write(history);
}

}  // namespace hersey::results
