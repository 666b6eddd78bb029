#include "hersey/core/hdf5_handle.h"

#include <hdf5.h>

#include "hersey/core/hdf5_lock.h"

namespace hersey {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "the header names HDF5's identifiers so");

bool Hdf5Handle::reset() {
  if (id_ < 0) return true;
  const std::scoped_lock lock(hdf5_lock());
  return H5Idec_ref(std::exchange(id_, -1)) >= 0;
}

Hdf5Session::Hdf5Session(const char* untrusted_path) : lock_(hdf5_lock()), untrusted_(untrusted_path) {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Session::~Hdf5Session() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

std::vector<std::size_t> extent_of(std::int64_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> lengths(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  if (!lengths.empty()) H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  return {lengths.begin(), lengths.end()};
}

bool has_object(std::int64_t group, const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(group, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

}  // namespace hersey
