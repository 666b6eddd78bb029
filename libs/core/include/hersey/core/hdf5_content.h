#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hersey {

/// Returns the first feature of an HDF5 file that is never accepted, in words that follow "found: "; empty if there is
/// none. Not accepted are soft links, external links and data in other files (they would let the file choose what is
/// read on this machine), groups that contain themselves, groups nested more than 32 deep, and data sets larger than
/// the file can hold at the best compression, or than the memory. Must be called with `hdf5_lock` held, before anything
/// else is read. Visits every object once.
/// @param file  HDF5's hid_t of an open file
[[nodiscard]] std::string foreign_content(std::int64_t file, const std::filesystem::path& path);

}  // namespace hersey
