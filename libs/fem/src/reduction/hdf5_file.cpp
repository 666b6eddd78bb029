#include "reduction/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "hersey/core/hdf5_content.h"
#include "hersey/core/input_file.h"

namespace hersey::fem {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr hsize_t kMostNumbers = hsize_t{1} << 31;  // of one data set: 16 GiB

/// An identifier that is released with its owner.
class Identifier {
 public:
  explicit Identifier(hid_t id) : id_(id) {}
  Identifier(const Identifier&) = delete;
  Identifier& operator=(const Identifier&) = delete;
  ~Identifier() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }

 private:
  hid_t id_;
};

// HDF5 prints stacks of errors by default; this disables it, and failures are reported once, by exceptions.
void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw std::runtime_error(fmt::format("data set '{}' {}", name, what));
}

}  // namespace

Hdf5File Hdf5File::create(const std::filesystem::path& path) {
  Lock lock(hdf5_lock());
  be_quiet();
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  if (file < 0) throw std::runtime_error("cannot be written");
  return {std::move(lock), file};
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  Lock lock(hdf5_lock());
  be_quiet();
  if (const auto failure = unreadable(path)) throw std::runtime_error(*failure);
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) throw std::runtime_error("is no HDF5 file that can be read");
  Hdf5File file(std::move(lock), id);
  if (const std::string foreign = foreign_content(id, path); !foreign.empty()) throw std::runtime_error(foreign);
  return file;
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : lock_(std::move(other.lock_)), file_(std::exchange(other.file_, H5I_INVALID_HID)) {}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Idec_ref(file_);
}

void Hdf5File::write(const std::string& name, hid_t stored, hid_t type, const std::vector<hsize_t>& shape,
                     const void* values) {
  const Identifier links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.get(), 1);
  const Identifier space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
  const Identifier data(H5Dcreate2(file_, name.c_str(), stored, space.get(), links.get(), H5P_DEFAULT, H5P_DEFAULT));
  const bool is_empty = std::find(shape.begin(), shape.end(), 0) != shape.end();
  const bool is_written =
      data.get() >= 0 && (is_empty || H5Dwrite(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  if (!is_written) fail(name, "cannot be written");
}

void Hdf5File::write(const std::string& name, const Eigen::MatrixXd& values) {
  const RowMajor rows = values;
  write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE,
        {static_cast<hsize_t>(values.rows()), static_cast<hsize_t>(values.cols())}, rows.data());
}

void Hdf5File::write(const std::string& name, const std::vector<double>& values) {
  write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}

void Hdf5File::write(const std::string& name, const std::vector<long long>& values) {
  write(name, H5T_STD_I64LE, H5T_NATIVE_LLONG, {values.size()}, values.data());
}

// Text is stored as bytes, which the HDF5 libraries of all languages read alike.
void Hdf5File::write_text(const std::string& name, const std::string& text) {
  write(name, H5T_STD_U8LE, H5T_NATIVE_UCHAR, {text.size()}, text.data());
}

bool Hdf5File::has(const std::string& name) const {
  for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<hsize_t> Hdf5File::shape_of(const std::string& name) const {
  if (!has(name)) fail(name, "is missing");
  const Identifier data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
  const Identifier space(data.get() < 0 ? H5I_INVALID_HID : H5Dget_space(data.get()));
  const int rank = space.get() < 0 ? -1 : H5Sget_simple_extent_ndims(space.get());
  if (rank < 1 || rank > 2) fail(name, "is no list and no matrix");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  hsize_t count = 1;
  for (const hsize_t length : shape) {
    if (length > kMostNumbers || (count *= std::max<hsize_t>(length, 1)) > kMostNumbers) fail(name, "is too large");
  }
  return shape;
}

void Hdf5File::read(const std::string& name, hid_t type, void* values) const {
  const Identifier data(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
  if (H5Dread(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail(name, "cannot be read as numbers");
}

Eigen::MatrixXd Hdf5File::read_matrix(const std::string& name) const {
  const std::vector<hsize_t> shape = shape_of(name);
  if (shape.size() != 2) fail(name, "is no matrix");
  RowMajor values(static_cast<Eigen::Index>(shape[0]), static_cast<Eigen::Index>(shape[1]));
  if (values.size() > 0) read(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<double> Hdf5File::read_numbers(const std::string& name) const {
  const std::vector<hsize_t> shape = shape_of(name);
  if (shape.size() != 1) fail(name, "is no list");
  std::vector<double> values(shape[0]);
  if (!values.empty()) read(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<long long> Hdf5File::read_integers(const std::string& name) const {
  const std::vector<hsize_t> shape = shape_of(name);
  if (shape.size() != 1) fail(name, "is no list");
  std::vector<long long> values(shape[0]);
  if (!values.empty()) read(name, H5T_NATIVE_LLONG, values.data());
  return values;
}

std::string Hdf5File::read_text(const std::string& name) const {
  const std::vector<hsize_t> shape = shape_of(name);
  if (shape.size() != 1) fail(name, "is no text");
  std::string text(shape[0], '\0');
  if (!text.empty()) read(name, H5T_NATIVE_UCHAR, text.data());
  return text;
}

}  // namespace hersey::fem
