#pragma once

#include <mutex>

namespace hersey {

/// The lock that every call of HDF5 is made under, in all modules: the library keeps its open files and identifiers in
/// tables of the process, and need not have been built for several threads. Recursive, since what holds it releases
/// identifiers that take it too. Nothing slow but HDF5's own reading and writing is done while it is held.
/// @verified_by study_test.cpp
[[nodiscard]] std::recursive_mutex& hdf5_lock();

}  // namespace hersey
