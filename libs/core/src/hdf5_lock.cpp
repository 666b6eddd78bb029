#include "hersey/core/hdf5_lock.h"

namespace hersey {

std::recursive_mutex& hdf5_lock() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace hersey
