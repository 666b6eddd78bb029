#include "hersey/core/input_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

namespace hersey {
namespace {

constexpr double kMegabyte = 1e6;

}  // namespace

std::optional<std::string> unreadable(const std::filesystem::path& path, std::uintmax_t most) {
  using std::filesystem::file_type;
  std::error_code error;
  switch (std::filesystem::status(path, error).type()) {
    case file_type::regular:
      break;
    case file_type::directory:
      return "a directory";
    case file_type::fifo:
      return "a pipe";
    case file_type::socket:
      return "a socket";
    case file_type::block:
    case file_type::character:
      return "a device";
    default:
      return "no readable file";
  }
  if (::access(path.c_str(), R_OK) != 0) return "no readable file";
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return "no readable file";
  if (size > most)
    return fmt::format("a file of {:.6g} MB, of at most {:.6g} MB", static_cast<double>(size) / kMegabyte,
                       static_cast<double>(most) / kMegabyte);
  return std::nullopt;
}

InputFile read_input_file(const std::filesystem::path& path, std::uintmax_t most) {
  if (std::optional<std::string> fault = unreadable(path, most)) return {{}, *fault};
  InputFile file;
  std::error_code error;
  file.content.resize(static_cast<std::size_t>(std::filesystem::file_size(path, error)));
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream.read(file.content.data(), static_cast<std::streamsize>(file.content.size())))
    return {{}, "no readable file"};
  return file;
}

}  // namespace hersey
