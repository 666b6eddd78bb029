#pragma once

#include <string>

namespace hersey {

/// Returns what tells this build of the code, on this kind of processor, from every other: the build ID that the linker
/// gives program or library, and the kernels that OpenBLAS has chosen. Two programs with the same one compute the same
/// bits. Empty where the linker gave none.
/// @verified_by program_identity_test.cpp
[[nodiscard]] std::string program_identity();

}  // namespace hersey
