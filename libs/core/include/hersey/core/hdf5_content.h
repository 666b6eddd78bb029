#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hersey {

/// What an HDF5 file from elsewhere has that none of ours has, in words that follow "found: "; empty where it has
/// nothing of it: soft and external links and data in other files, which would let a file choose what is read of this
/// machine; groups that contain themselves, which never end; groups more than 32 deep; data sets of a size that the
/// file cannot hold however well it is compressed, or the memory cannot. Called under `hdf5_lock`, before anything else
/// is read. Cost: one look at every object.
/// @param file  an open file, HDF5's hid_t
[[nodiscard]] std::string foreign_content(std::int64_t file, const std::filesystem::path& path);

}  // namespace hersey
