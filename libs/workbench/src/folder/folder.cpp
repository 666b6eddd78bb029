#include "folder/folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

namespace hersey::workbench {
namespace {

using Path = std::filesystem::path;

constexpr int kDepth = 4;
constexpr std::size_t kMostFiles = 2000;
constexpr std::size_t kMostVisited = 50'000;  // entries of folders that hold other things
constexpr std::uintmax_t kMostText = std::uintmax_t{16} << 20;

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// True if the second byte of a character of several may follow the first: others spell a character in more bytes than
/// it needs, half of a pair of UTF-16, or a number above that of the last character.
bool may_follow(unsigned char first, unsigned char second) {
  return (second & 0xc0) == 0x80 && !(first == 0xe0 && second < 0xa0) && !(first == 0xed && second > 0x9f) &&
         !(first == 0xf0 && second < 0x90) && !(first == 0xf4 && second > 0x8f);
}

bool is_utf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const int more = byte < 0x80                   ? 0
                     : byte >= 0xc2 && byte < 0xe0 ? 1
                     : byte >= 0xe0 && byte < 0xf0 ? 2
                     : byte >= 0xf0 && byte < 0xf5 ? 3
                                                   : -1;
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return false;
    if (more > 0 && !may_follow(byte, static_cast<unsigned char>(text[i + 1]))) return false;
    for (int k = 2; k <= more; ++k)
      if ((static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0xc0) != 0x80) return false;
    i += static_cast<std::size_t>(more) + 1;
  }
  return true;
}

Refused outside(const std::string& why) {
  return {403, why, "name a file of the folder that the workbench was opened with"};
}

[[noreturn]] void cannot_write(const std::string& file, int error) {
  const std::string why = std::generic_category().message(error);
  if (error == ENOSPC || error == EFBIG || error == EDQUOT)
    throw Refused(507, fmt::format("{} is not written, the old file is whole: {}", file, why),
                  "make room on the disk, then save again");
  if (error == EACCES || error == EROFS || error == EPERM)
    throw Refused(403, fmt::format("{} is not written: {}", file, why),
                  "save it under another name, or change the rights of the folder");
  throw Refused(500, fmt::format("{} is not written: {}", file, why), "save it under another name");
}

/// Marks a content. Two contents of one file with the same mark are improbable enough for editors: FNV-1a, 64 bits,
/// with the length.
std::string etag_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return fmt::format("\"{:x}-{:016x}\"", text.size(), hash);
}

/// Text of a file, by an open descriptor of it.
std::string text_of(int fd, std::size_t most) {
  std::string text;
  std::array<char, 65536> part{};
  while (text.size() < most) {
    const ssize_t got = ::read(fd, part.data(), std::min(part.size(), most - text.size()));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(got));
  }
  return text;
}

bool has_model_key(const Path& file) {
  constexpr std::size_t kLooked = 65536;
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const std::string text = "\n" + text_of(opened.number(), kLooked);
  constexpr std::array<std::string_view, 6> keys{
      "\nhersey:", "\nbodies:", "\nbearings:", "\njoints:", "\ntemplates:", "\nbearing:"};
  return std::any_of(keys.begin(), keys.end(),
                     [&](std::string_view key) { return text.find(key) != std::string::npos; });
}

template <std::size_t N>
bool is_one_of(const std::string& extension, const std::array<std::string_view, N>& known) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

std::string kind_by_name(const std::string& extension) {
  constexpr std::array<std::string_view, 11> meshes{".msh",  ".inp", ".bdf",  ".dat",  ".nas", ".unv",
                                                    ".step", ".stp", ".brep", ".iges", ".igs"};
  constexpr std::array<std::string_view, 2> tables{".csv", ".tsv"};
  constexpr std::array<std::string_view, 3> texts{".txt", ".md", ".json"};
  if (is_one_of(extension, meshes)) return "mesh";
  if (is_one_of(extension, tables)) return "table";
  if (is_one_of(extension, texts)) return "text";
  if (extension == ".h5") return "results";
  if (extension == ".html") return "report";
  return "other";
}

double seconds(const struct stat& status) {
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

void write_all(int fd, std::string_view text, const std::string& name) {
  while (!text.empty()) {
    const ssize_t done = ::write(fd, text.data(), text.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) cannot_write(name, errno);
    text.remove_prefix(static_cast<std::size_t>(done));
  }
  if (::fsync(fd) != 0 && errno != EINVAL && errno != EROFS) cannot_write(name, errno);
}

/// A file beside another one that becomes it when it is complete, and is removed otherwise.
class Temporary {
 public:
  Temporary(const Path& target, std::string name) : name_(std::move(name)) {
    path_ = (target.parent_path() / ("." + target.filename().string() + ".XXXXXX")).string();
    fd_ = ::mkostemp(path_.data(), O_CLOEXEC);
    if (fd_ < 0) {
      const int error = errno;
      path_.clear();
      cannot_write(name_, error);
    }
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (fd_ >= 0) ::close(fd_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  void fill(std::string_view text, mode_t mode) const {
    write_all(fd_, text, name_);
    if (::fchmod(fd_, mode) != 0) cannot_write(name_, errno);
  }
  void become(const Path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) cannot_write(name_, errno);
    path_.clear();
  }
  /// @returns false if the target exists
  [[nodiscard]] bool become_new(const Path& target) const {
    if (::link(path_.c_str(), target.c_str()) == 0) return true;
    if (errno == EEXIST) return false;
    // A file system without hard links.
    const Descriptor claimed(::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (claimed.number() < 0 && errno == EEXIST) return false;
    if (claimed.number() < 0 || ::rename(path_.c_str(), target.c_str()) != 0) cannot_write(name_, errno);
    return true;
  }

 private:
  std::string path_, name_;
  int fd_ = -1;
};

mode_t mode_of_new_files() {
  const mode_t mask = ::umask(022);
  ::umask(mask);
  return 0666 & ~mask;
}

}  // namespace

Folder::Folder(const Path& path) {
  std::error_code error;
  path_ = std::filesystem::canonical(path, error);
  if (!error && !std::filesystem::is_directory(path_, error)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error) (void)std::filesystem::directory_iterator(path_, error);
  if (error) throw std::runtime_error(fmt::format("{}: the folder cannot be read: {}", path.string(), error.message()));
}

Path Folder::resolve(const std::string& relative) const {
  if (relative.empty()) throw outside("no file is named");
  if (relative.front() == '/') throw outside("an absolute path");
  if (std::any_of(relative.begin(), relative.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    throw outside("a name with control characters");
  if (!is_utf8(relative)) throw outside("a name that is not UTF-8");
  std::string_view rest = relative;
  while (true) {
    const std::size_t slash = rest.find('/');
    const std::string_view part = rest.substr(0, slash);
    if (part == "..") throw outside("a path with '..'");
    if (part.empty()) throw outside("a path with an empty part");
    if (part.front() == '.') throw outside("a hidden file");
    if (slash == std::string_view::npos) break;
    rest.remove_prefix(slash + 1);
  }
  std::error_code error;
  const Path found = std::filesystem::weakly_canonical(path_ / relative, error);
  if (error) throw outside("a path that leads nowhere");
  const auto [end, other] = std::mismatch(path_.begin(), path_.end(), found.begin(), found.end());
  if (end != path_.end() || other == found.end()) throw outside("a link that leads out of the folder");
  // What is left of a link that could not be followed.
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(found, error)))
    throw outside("a link that leads nowhere");
  return found;
}

std::string Folder::kind_of(const Path& file, const FileEntry& entry) const {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".yaml" && extension != ".yml") return kind_by_name(extension);
  {
    const std::lock_guard lock(kinds_mutex_);
    const auto known = kinds_.find(entry.path);
    if (known != kinds_.end() && known->second.size == entry.size && known->second.changed == entry.changed)
      return known->second.kind;
  }
  std::string kind = has_model_key(file) ? "model" : "text";
  const std::lock_guard lock(kinds_mutex_);
  if (kinds_.size() > 2 * kMostFiles) kinds_.clear();
  kinds_[entry.path] = {entry.size, entry.changed, kind};
  return kind;
}

std::vector<FileEntry> Folder::list() const {
  using Walk = std::filesystem::recursive_directory_iterator;
  std::vector<FileEntry> files;
  std::error_code error;
  std::size_t visited = 0;
  Walk walk(path_, std::filesystem::directory_options::skip_permission_denied, error);
  for (; !error && walk != Walk() && files.size() < kMostFiles && ++visited < kMostVisited; walk.increment(error)) {
    const std::string name = walk->path().filename().string();
    struct stat status {};
    const bool is_hidden = name.starts_with('.') || !is_utf8(name) ||
                           std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    if (is_hidden || walk.depth() >= kDepth) walk.disable_recursion_pending();
    if (is_hidden || ::stat(walk->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    const std::string relative = walk->path().lexically_relative(path_).generic_string();
    try {
      if (walk->is_symlink(error)) (void)resolve(relative);
    } catch (const Refused&) {
      continue;
    }
    FileEntry entry{relative, "", static_cast<std::uintmax_t>(status.st_size), seconds(status)};
    entry.kind = kind_of(walk->path(), entry);
    files.push_back(std::move(entry));
  }
  std::sort(files.begin(), files.end(), [](const FileEntry& a, const FileEntry& b) { return a.path < b.path; });
  return files;
}

FileText Folder::read(const std::string& relative) const {
  const Path file = resolve(relative);
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW));
  if (opened.number() < 0) {
    if (errno == ENOENT || errno == ENOTDIR)
      throw Refused(404, relative + " is not there", "choose a file of the list");
    throw Refused(403, fmt::format("{} cannot be read: {}", relative, std::generic_category().message(errno)),
                  "change its rights, or choose another file");
  }
  struct stat status {};
  if (::fstat(opened.number(), &status) != 0 || !S_ISREG(status.st_mode))
    throw Refused(403, relative + " is no file", "choose a file of the list");
  if (static_cast<std::uintmax_t>(status.st_size) > kMostText)
    throw Refused(413, fmt::format("{} is larger than {} MB", relative, kMostText >> 20), "edit it by another program");
  FileText content{text_of(opened.number(), kMostText), ""};
  // What a page cannot show as it is would be damaged when it is saved.
  if (!is_utf8(content.text)) throw Refused(415, relative + " is not UTF-8 text", "convert it by another program");
  content.etag = etag_of(content.text);
  return content;
}

Path Folder::page(const std::string& relative) const {
  const Path file = resolve(relative);
  if (kind_by_name(file.extension().string()) != "report")
    throw Refused(422, relative + " is no page", "open it as a text");
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
    throw Refused(404, relative + " is not there", "choose a file of the list");
  return file;
}

std::string Folder::replace(const std::string& relative, const std::string& text, const std::string& etag) {
  const Path file = resolve(relative);
  const std::lock_guard lock(writing_);
  FileText now = read(relative);
  if (now.etag != etag) throw ChangedFile{std::move(now)};
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) cannot_write(relative, errno);
  // A rename would replace a file that is protected in a folder that is not.
  if (::access(file.c_str(), W_OK) != 0) cannot_write(relative, errno);
  Temporary fresh(file, relative);
  fresh.fill(text, status.st_mode & 07777);
  // The time in which another editor's change could be lost is that of a rename.
  now = read(relative);
  if (now.etag != etag) throw ChangedFile{std::move(now)};
  fresh.become(file);
  return etag_of(text);
}

std::string Folder::create(const std::string& relative, const std::string& text) {
  const Path file = resolve(relative);
  const std::lock_guard lock(writing_);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) cannot_write(relative, error.value());
  const Temporary fresh(file, relative);
  fresh.fill(text, mode_of_new_files());
  if (!fresh.become_new(file)) throw ChangedFile{read(relative)};
  return etag_of(text);
}

}  // namespace hersey::workbench
