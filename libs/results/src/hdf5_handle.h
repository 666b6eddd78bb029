#pragma once

#include <hdf5.h>

#include <mutex>
#include <utility>

#include "hersey/core/hdf5_lock.h"
#include "hersey/core/untrusted_file.h"

namespace hersey::results {

/// Owns one HDF5 identifier of any kind.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { reset(); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

  /// @returns false if HDF5 could not close the object in order.
  bool reset() {
    if (id_ < 0) return true;
    const std::scoped_lock lock(hdf5_lock());
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return H5Idec_ref(id) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// Begins a sequence of HDF5 calls: during its lifetime this thread alone uses the library, and no error stacks are
/// printed, because exceptions report failures.
class Hdf5Session {
 public:
  /// @param untrusted_path  the file that is read, if no checksum covers it (hersey/core/untrusted_file.h)
  explicit Hdf5Session(const char* untrusted_path = nullptr) : lock_(hdf5_lock()), untrusted_(untrusted_path) {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;
  ~Hdf5Session() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  std::scoped_lock<std::recursive_mutex> lock_;
  UntrustedFile untrusted_;
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

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
