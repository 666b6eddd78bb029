#include "hersey/core/write_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace hersey {
namespace {

bool write(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  std::ofstream file(path, std::ios::binary);
  for (const std::string_view part : parts) file << part;
  file.close();
  return static_cast<bool>(file);
}

}  // namespace

void write_file(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    if (!write(path, parts)) throw std::runtime_error(std::strerror(errno));
    return;
  }
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
  const std::filesystem::path end = error ? path : target;
  std::filesystem::path unfinished = end;
  unfinished += ".new";
  if (!write(unfinished, parts)) {
    const int reason = errno;
    std::filesystem::remove(unfinished, error);
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
