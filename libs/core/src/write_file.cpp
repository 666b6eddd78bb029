#include "hersey/core/write_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace hersey {
namespace {

/// Writes a file that is opened by the `mode` of fopen. @returns 0, or the error
int write(const std::filesystem::path& path, const char* mode, std::initializer_list<std::string_view> parts) {
  std::FILE* file = std::fopen(path.c_str(), mode);
  if (file == nullptr) return errno;
  int reason = 0;
  for (const std::string_view part : parts)
    if (reason == 0 && std::fwrite(part.data(), 1, part.size(), file) != part.size()) reason = errno;
  if (std::fclose(file) != 0 && reason == 0) reason = errno;
  return reason;
}

/// Removes what an interrupted program has left: a file, or a link. @returns 0, or the error
int remove_leftover(const std::filesystem::path& unfinished) {
  return ::unlink(unfinished.c_str()) == 0 || errno == ENOENT ? 0 : errno;
}

}  // namespace

void write_file(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    if (const int reason = write(path, "wb", parts); reason != 0) throw std::runtime_error(std::strerror(reason));
    return;
  }
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  const std::filesystem::path end = error ? path : target;
  std::filesystem::path unfinished = end;
  unfinished += ".new";
  // A link of this name may lead anywhere, and another one may be made meanwhile: x fails where there is anything.
  if (const int reason = remove_leftover(unfinished); reason != 0) throw std::runtime_error(std::strerror(reason));
  if (const int reason = write(unfinished, "wbx", parts); reason != 0) {
    if (reason != EEXIST) std::filesystem::remove(unfinished, error);
    throw std::runtime_error(std::strerror(reason));
  }
  std::filesystem::rename(unfinished, end, error);
  if (error) throw std::runtime_error(error.message());
}

bool write_new_file(const std::filesystem::path& path, std::string_view text) {
  std::FILE* file = std::fopen(path.c_str(), "wbx");  // x: fails where there is one
  if (file == nullptr && errno == EEXIST) return false;
  if (file == nullptr) throw std::runtime_error(std::strerror(errno));
  errno = 0;
  const bool is_written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  int reason = errno;
  const bool is_closed = std::fclose(file) == 0;
  if (is_written && is_closed) return true;
  if (is_written) reason = errno;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  throw std::runtime_error(std::strerror(reason));
}

}  // namespace hersey
