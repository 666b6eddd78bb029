#pragma once

#include <hdf5.h>

#include <string>

namespace hersey::results {

/// The first thing that went wrong with the file, outliving the HDF5 objects that met it.
struct DriverStatus {
  bool failed = false;
  std::string reason;  ///< e.g. "No space left on device"
};

/// Makes a file access property list use the reserving driver on an open file.
///
/// HDF5's own drivers let a full disk surface anywhere: half-way through a flush, and again in every attempt to close.
/// This driver reserves space on the disk before HDF5 may use it. At the first failure of any kind it notes the reason
/// in `status` and from then on lets HDF5 believe that its writes succeed while dropping them. HDF5 can then always
/// close, and, with metadata held back until a flush, the file stays as the last complete flush left it.
///
/// @param access  property list to be changed.
/// @param fd      open for reading and writing, empty; the driver closes it.
/// @param status  written by the driver as long as the file is open.
/// @returns false if HDF5 refuses the driver; `fd` is then still the caller's.
[[nodiscard]] bool use_reserving_driver(hid_t access, int fd, DriverStatus& status);

}  // namespace hersey::results
