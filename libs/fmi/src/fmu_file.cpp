#include "hersey/fmi/fmu_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <utility>

#include "hersey/core/input_file.h"

// The layout of ZIP archives: PKWARE, APPNOTE.TXT 6.3, sections 4.3.7, 4.3.12 and 4.3.16.
namespace hersey::fmi {
namespace {

constexpr std::uint32_t kEndOfDirectory = 0x06054b50, kDirectoryEntry = 0x02014b50, kLocalHeader = 0x04034b50;
constexpr std::size_t kEndSize = 22, kDirectorySize = 46, kLocalSize = 30, kLongestComment = 65535;
constexpr int kStored = 0, kDeflated = 8;
constexpr std::uint32_t kLargestEntry = 1U << 30;  // bytes unpacked; libraries of FMUs have some millions
constexpr std::uint32_t kLargestDescription = 1U << 27;
constexpr std::uint64_t kMostByDeflate = 1032;  // bytes that one packed byte can stand for: a match of 258 by two bits

constexpr const char* kDescription = "modelDescription.xml";

/// Whole numbers of a file's bytes, least significant byte first.
class Bytes {
 public:
  explicit Bytes(const std::string& text) : text_(text) {}
  [[nodiscard]] std::uint32_t word(std::size_t at) const { return number(at, 2); }
  [[nodiscard]] std::uint32_t double_word(std::size_t at) const { return number(at, 4); }

 private:
  [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t count) const {
    if (at + count > text_.size()) throw FmuError("its list of contents is damaged");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(text_[at + i])) << (8 * i);
    return value;
  }
  const std::string& text_;
};

std::string bytes_of(const std::filesystem::path& path, std::uint64_t from, std::uint64_t count) {
  if (from + count > std::filesystem::file_size(path)) throw FmuError("it ends too early");
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(from));
  std::string bytes(count, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  if (!stream || stream.gcount() != static_cast<std::streamsize>(count)) throw FmuError("it ends too early");
  return bytes;
}

/// False for names that would be written outside of the folder that a file is unpacked to.
bool is_inside(const std::string& name) {
  const std::filesystem::path path(name);
  return !name.empty() && name.find('\\') == std::string::npos && name.find('\0') == std::string::npos &&
         !path.is_absolute() &&
         std::none_of(path.begin(), path.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

std::string inflated(const std::string& packed, std::uint32_t size) {
  std::string content(size, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(content.data());
  stream.avail_out = static_cast<uInt>(size);
  const int status = inflate(&stream, Z_FINISH);
  const bool is_complete = status == Z_STREAM_END && stream.total_out == size;
  inflateEnd(&stream);
  if (!is_complete) throw FmuError("its content is damaged");
  return content;
}

}  // namespace

FmuFile::FmuFile(std::filesystem::path path) : path_(std::move(path)) {
  if (const std::optional<std::string> why = unreadable(path_)) throw FmuError(*why);
  const std::uint64_t length = std::filesystem::file_size(path_);
  if (length < kEndSize) throw FmuError("it is no ZIP archive");
  const std::uint64_t tail = std::min<std::uint64_t>(length, kEndSize + kLongestComment);
  const std::string end = bytes_of(path_, length - tail, tail);
  const Bytes end_bytes(end);
  std::size_t at = end.size() - kEndSize;
  while (end_bytes.double_word(at) != kEndOfDirectory) {
    if (at == 0) throw FmuError("it is no ZIP archive");
    --at;
  }
  const std::uint32_t count = end_bytes.word(at + 10), size = end_bytes.double_word(at + 12),
                      offset = end_bytes.double_word(at + 16);
  if (std::uint64_t{offset} + size > length)
    throw FmuError("its list of contents is damaged, or it is larger than 4 GB");
  const std::string directory = bytes_of(path_, offset, size);
  const Bytes bytes(directory);
  std::size_t from = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (bytes.double_word(from) != kDirectoryEntry) throw FmuError("its list of contents is damaged");
    const bool is_encrypted = (bytes.word(from + 8) & 1U) != 0;
    const std::size_t name_length = bytes.word(from + 28);
    const std::size_t next = from + kDirectorySize + name_length + bytes.word(from + 30) + bytes.word(from + 32);
    if (next > directory.size()) throw FmuError("its list of contents is damaged");
    Entry entry{.name = directory.substr(from + kDirectorySize, name_length),
                .offset = bytes.double_word(from + 42),
                .packed = bytes.double_word(from + 20),
                .size = bytes.double_word(from + 24),
                .checksum = bytes.double_word(from + 16),
                .method = static_cast<int>(bytes.word(from + 10))};
    from = next;
    if (!is_inside(entry.name)) throw FmuError(fmt::format("its content '{}' would lie outside of it", entry.name));
    if (is_encrypted) throw FmuError("it is encrypted");
    if (!entry.name.ends_with('/')) entries_.push_back(std::move(entry));
  }
}

Description FmuFile::description() const {
  const auto is_it = [](const Entry& entry) { return entry.name == kDescription; };
  const auto found = std::find_if(entries_.begin(), entries_.end(), is_it);
  if (found != entries_.end() && found->size > kLargestDescription)
    throw FmuError(fmt::format("its {} is larger than 134 MB", kDescription));
  return read_description(content(kDescription));
}

bool FmuFile::has(const std::string& name) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
}

std::vector<std::string> FmuFile::platforms() const {
  const std::string folder = "binaries/";
  std::set<std::string> found;
  for (const Entry& entry : entries_) {
    if (!entry.name.starts_with(folder)) continue;
    const std::size_t slash = entry.name.find('/', folder.size());
    if (slash != std::string::npos) found.insert(entry.name.substr(folder.size(), slash - folder.size()));
  }
  return {found.begin(), found.end()};
}

std::string FmuFile::content(const std::string& name) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
  if (found == entries_.end()) throw FmuError("it has no " + name);
  return content(*found);
}

std::string FmuFile::content(const Entry& entry) const {
  if (entry.size > kLargestEntry) throw FmuError(fmt::format("its content {} is larger than 1 GB", entry.name));
  const std::string header = bytes_of(path_, entry.offset, kLocalSize);
  const Bytes bytes(header);
  if (bytes.double_word(0) != kLocalHeader) throw FmuError("its list of contents is damaged");
  const std::string packed = bytes_of(path_, entry.offset + kLocalSize + bytes.word(26) + bytes.word(28), entry.packed);
  if (entry.method != kStored && entry.method != kDeflated)
    throw FmuError(fmt::format("its content {} is packed by method {}: deflate is read", entry.name, entry.method));
  const bool is_possible =
      entry.method == kStored ? entry.size == entry.packed : entry.size <= kMostByDeflate * std::uint64_t{entry.packed};
  if (!is_possible) throw FmuError("its list of contents is damaged");
  std::string content = entry.method == kStored ? packed : inflated(packed, entry.size);
  const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  if (checksum != entry.checksum) throw FmuError(fmt::format("its content {} is damaged", entry.name));
  return content;
}

void FmuFile::extract(const std::string& prefix, const std::filesystem::path& folder) const {
  for (const Entry& entry : entries_) {
    if (!entry.name.starts_with(prefix)) continue;
    const std::filesystem::path target = folder / entry.name;
    std::filesystem::create_directories(target.parent_path());
    std::ofstream stream(target, std::ios::binary | std::ios::trunc);
    const std::string bytes = content(entry);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) throw FmuError(fmt::format("{} cannot be written", target.string()));
  }
}

std::string platform([[maybe_unused]] int version) {
#if defined(__x86_64__)
  return version == 2 ? "linux64" : "x86_64-linux";
#elif defined(__aarch64__)
  return "aarch64-linux";
#else
#error "FMI's name of this platform is not known here"
#endif
}

std::string library_name(const Description& description) {
  return fmt::format("binaries/{}/{}.so", platform(description.version), description.model_identifier);
}

std::string missing_library(const FmuFile& file, const Description& description) {
  const std::string wanted = library_name(description);
  if (file.has(wanted)) return {};
  const std::vector<std::string> found = file.platforms();
  return fmt::format("it has no {}, the library for this computer; it has {}", wanted,
                     found.empty() ? "no libraries" : fmt::format("libraries for {}", fmt::join(found, ", ")));
}

}  // namespace hersey::fmi
