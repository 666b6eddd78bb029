#include "reduction/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "hersey/core/hdf5_content.h"
#include "hersey/core/input_file.h"

namespace hersey::fem {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t kMostNumbers = std::size_t{1} << 31;  // of one data set: 16 GiB

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw std::runtime_error(fmt::format("data set '{}' {}", name, what));
}

}  // namespace

Hdf5File::Hdf5File(const std::filesystem::path& path, bool is_new) {
  if (is_new) {
    file_ = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    if (!file_.valid()) throw std::runtime_error("cannot be written");
    return;
  }
  if (const auto failure = unreadable(path)) throw std::runtime_error(*failure);
  file_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!file_.valid()) throw std::runtime_error("is no HDF5 file that can be read");
  if (const std::string foreign = foreign_content(file_.get(), path); !foreign.empty())
    throw std::runtime_error(foreign);
}

void Hdf5File::write(const std::string& name, hid_t stored, hid_t type, const std::vector<hsize_t>& shape,
                     const void* values) {
  const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links.get(), 1);
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
  const Hdf5Handle data(
      H5Dcreate2(file_.get(), name.c_str(), stored, space.get(), links.get(), H5P_DEFAULT, H5P_DEFAULT));
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

bool Hdf5File::has(const std::string& name) const { return has_object(file_.get(), name); }

std::vector<std::size_t> Hdf5File::shape_of(const std::string& name) const {
  if (!has(name)) fail(name, "is missing");
  const Hdf5Handle data(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT));
  const Hdf5Handle space(data.get() < 0 ? H5I_INVALID_HID : H5Dget_space(data.get()));
  std::vector<std::size_t> shape = extent_of(space.get());
  if (shape.empty() || shape.size() > 2) fail(name, "is no list and no matrix");
  std::size_t count = 1;
  for (const std::size_t length : shape) {
    if (length > kMostNumbers || (count *= std::max<std::size_t>(length, 1)) > kMostNumbers) fail(name, "is too large");
  }
  return shape;
}

void Hdf5File::read(const std::string& name, hid_t type, void* values) const {
  const Hdf5Handle data(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT));
  if (H5Dread(data.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail(name, "cannot be read as numbers");
}

Eigen::MatrixXd Hdf5File::read_matrix(const std::string& name) const {
  const std::vector<std::size_t> shape = shape_of(name);
  if (shape.size() != 2) fail(name, "is no matrix");
  RowMajor values(static_cast<Eigen::Index>(shape[0]), static_cast<Eigen::Index>(shape[1]));
  if (values.size() > 0) read(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<double> Hdf5File::read_numbers(const std::string& name) const {
  const std::vector<std::size_t> shape = shape_of(name);
  if (shape.size() != 1) fail(name, "is no list");
  std::vector<double> values(shape[0]);
  if (!values.empty()) read(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<long long> Hdf5File::read_integers(const std::string& name) const {
  const std::vector<std::size_t> shape = shape_of(name);
  if (shape.size() != 1) fail(name, "is no list");
  std::vector<long long> values(shape[0]);
  if (!values.empty()) read(name, H5T_NATIVE_LLONG, values.data());
  return values;
}

std::string Hdf5File::read_text(const std::string& name) const {
  const std::vector<std::size_t> shape = shape_of(name);
  if (shape.size() != 1) fail(name, "is no text");
  std::string text(shape[0], '\0');
  if (!text.empty()) read(name, H5T_NATIVE_UCHAR, text.data());
  return text;
}

}  // namespace hersey::fem
