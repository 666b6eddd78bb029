#include "open_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include "hersey/core/contract.h"
#include "hersey/results/error.h"

namespace hersey::results {
namespace {

constexpr unsigned index_node_half = 8;  // entries of half an index node: most series have a dozen chunks

/// @returns descriptor of a new, empty file.
int create(const std::filesystem::path& path, bool overwrite) {
  // The old file is unlinked, not truncated: a program still reading or writing it keeps its own.
  std::error_code ignored;
  if (overwrite && std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd >= 0) return fd;
  if (errno == EEXIST && !overwrite) throw FileExists(path);
  throw WriteError(path, std::string("cannot create the results file: ") + std::strerror(errno));
}

}  // namespace

void OpenFile::open(bool overwrite) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  const int fd = create(path, overwrite);
  if (!use_reserving_driver(access.get(), fd, status)) {
    ::close(fd);
    throw WriteError(path, "HDF5 refuses the file driver");
  }
  keep_metadata(access.get());
  // Headers of objects have checksums from HDF5 1.8 on: a flipped bit in one is an error, not a text of any length.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_istore_k(creation.get(), index_node_half);
  handle = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()));
  require(handle.valid(), "HDF5 cannot create the file");
}

void OpenFile::require(bool good, std::string_view what) {
  if (!good && !status.failed) {
    status.failed = true;
    status.reason = what;
  }
  if (status.failed) throw WriteError(path, "cannot write results: " + status.reason);
}

void OpenFile::require_open() {
  HERSEY_REQUIRE(handle.valid(), "the results file is finished");
  require(true, {});
}

void OpenFile::sync() {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = fd >= 0 && (::fsync(fd) == 0 || errno == EINVAL);
  const std::string reason = std::strerror(errno);
  if (fd >= 0) ::close(fd);
  require(synced, reason);
}

void OpenFile::rename(const std::filesystem::path& to, bool replace) {
  bool renamed = false;
  if (replace) {
    renamed = ::rename(path.c_str(), to.c_str()) == 0;
  } else {
    renamed = ::renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0;
    if (!renamed && errno == EEXIST) throw FileExists(to);
    if (!renamed && errno == EINVAL) {  // a file system without this flag
      if (std::filesystem::exists(to)) throw FileExists(to);
      renamed = ::rename(path.c_str(), to.c_str()) == 0;
    }
  }
  require(renamed, std::strerror(errno));
  path = to;
}

void OpenFile::close() {
  const bool good = handle.reset();
  if (!good && !status.failed) status = {true, "HDF5 cannot close the file"};
}

}  // namespace hersey::results
