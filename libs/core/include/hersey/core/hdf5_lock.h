#pragma once

#include <mutex>

namespace hersey {

/// Returns the lock under which every module calls HDF5. The library keeps its open files and identifiers in tables of
/// the process and may have been built without support for threads. The lock is recursive, because its owner releases
/// identifiers whose release locks it again. Only HDF5's own reading and writing may be slow while the lock is held.
/// @verified_by study_test.cpp
[[nodiscard]] std::recursive_mutex& hdf5_lock();

}  // namespace hersey
