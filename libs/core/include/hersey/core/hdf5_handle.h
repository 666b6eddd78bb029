#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "hersey/core/untrusted_file.h"

namespace hersey {

/// Owns one HDF5 identifier of any kind. Numbers of this type are HDF5's hid_t; less than 0: none.
/// @verified_by hdf5_handle_test.cpp
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  /// Takes the identifier over; less than 0, as HDF5 returns where it fails: none.
  explicit Hdf5Handle(std::int64_t id) : id_(id) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, -1);
    }
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { reset(); }

  /// Returns the identifier, which stays owned.
  [[nodiscard]] std::int64_t get() const { return id_; }
  /// True if there is an identifier.
  [[nodiscard]] bool valid() const { return id_ >= 0; }

  /// Releases the identifier. @returns false if HDF5 could not close the object in order.
  bool reset();

 private:
  std::int64_t id_ = -1;
};

/// Begins a sequence of HDF5 calls: during its lifetime this thread alone uses the library, and no error stacks are
/// printed, because exceptions report failures.
class Hdf5Session {
 public:
  /// @param untrusted_path  the file that is read, if no checksum covers it (hersey/core/untrusted_file.h)
  explicit Hdf5Session(const char* untrusted_path = nullptr);
  Hdf5Session(const Hdf5Session&) = delete;
  Hdf5Session& operator=(const Hdf5Session&) = delete;
  ~Hdf5Session();

 private:
  std::scoped_lock<std::recursive_mutex> lock_;
  UntrustedFile untrusted_;
  int (*function_)(std::int64_t, void*) = nullptr;
  void* data_ = nullptr;
};

/// Returns the lengths of a data space, the slowest index first; of a single value, or where there is no space, none.
[[nodiscard]] std::vector<std::size_t> extent_of(std::int64_t space);

/// True if `path`, "frames/0/origin" or "/frames/0/origin", leads from `group` to a link of that name through groups
/// that exist.
[[nodiscard]] bool has_object(std::int64_t group, const std::string& path);

}  // namespace hersey
