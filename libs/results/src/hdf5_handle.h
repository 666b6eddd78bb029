#pragma once

#include <hdf5.h>

#include "hersey/core/hdf5_handle.h"

namespace hersey::results {

using Handle = Hdf5Handle;

/// Type of variable-length UTF-8 text.
inline Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

/// Headers and indices of thousands of datasets stay in memory: every flush changes each of those that grow, and in a
/// smaller cache they would be written and read back each time.
inline void keep_metadata(hid_t access) {
  constexpr std::size_t most = 128u << 20;  // HDF5 allows no more; what is not needed is not taken
  H5AC_cache_config_t config{};
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  if (H5Pget_mdc_config(access, &config) < 0) return;
  config.set_initial_size = true;
  config.initial_size = config.max_size = most;
  config.decr_mode = H5C_decr__off;
  H5Pset_mdc_config(access, &config);
}

}  // namespace hersey::results
