#pragma once

#include <filesystem>

namespace hersey::model {

/// Lets this process keep reduced meshes in a folder, and take those that earlier processes have kept there: the check
/// of a model, its run and the run after it reduce a mesh once. A body is taken only where everything that went into it
/// is the same, byte for byte, and the program as well; what is damaged or cannot be written is passed over without a
/// word. Without this call nothing is kept on disk: libraries do not write into the folders of those who load them.
/// @param folder  made where it is missing; empty: none
/// @cost 2 GB of disk at most, those used longest ago are removed
/// @verified_by reduction_folder_test.cpp
void keep_reductions_in(const std::filesystem::path& folder);

}  // namespace hersey::model
