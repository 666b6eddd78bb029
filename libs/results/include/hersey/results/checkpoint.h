#pragma once

#include <filesystem>

#include "hersey/core/archive.h"
#include "hersey/results/error.h"

namespace hersey::results {

/// Writes a checkpoint (HDF5; layout in docs/results-file.md) in place of the one before. A program killed at any
/// moment, or a full disk, leaves the old one or the new one, never a part: it is written under another name, synced to
/// the disk and renamed.
/// @throws WriteError.
/// @verified_by checkpoint_test.cpp
void write_checkpoint(const std::filesystem::path& path, const Archive::Content& content);

/// Removes a checkpoint, if there is one, and the partial file of a program killed while it wrote one.
void remove_checkpoint(const std::filesystem::path& path);

/// @throws ReadError if the file is missing or not a checkpoint that this version understands.
[[nodiscard]] Archive::Content read_checkpoint(const std::filesystem::path& path);

}  // namespace hersey::results
