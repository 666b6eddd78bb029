#include "hersey/results/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "hdf5_handle.h"
#include "hersey/core/hdf5_content.h"
#include "hersey/core/input_file.h"
#include "hersey/core/sealed_file.h"

namespace hersey::results {
namespace {

constexpr const char* kFormat = "hersey-checkpoint";
constexpr double kVersion = 1;
constexpr std::size_t kMemoryStep = std::size_t{1} << 20;

/// HDF5 file in memory: its bytes are written to the disk in one piece. HDF5 distinguishes files in memory by their
/// names and opens each only once, so every one has the name of its own checkpoint. Its lifetime lies within one
/// session.
class Image {
 public:
  explicit Image(const std::filesystem::path& path) : path_(path) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fapl_core(access.get(), kMemoryStep, false);
    file_ = Handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()));
    parents_ = Handle(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(parents_.get(), 1);
    require(file_.valid());
  }

  void add(const std::string& name, const Archive::Numbers& numbers) {
    std::vector<hsize_t> shape(numbers.shape.begin(), numbers.shape.end());
    const Handle space(shape.empty() ? H5Screate(H5S_SCALAR)
                                     : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
    write(name, H5T_NATIVE_DOUBLE, space.get(), numbers.values.empty() ? nullptr : numbers.values.data());
  }

  void add(const std::string& name, const std::string& text) {
    const Handle space(H5Screate(H5S_SCALAR)), type = text_type();
    const char* pointer = text.c_str();
    write(name, type.get(), space.get(), &pointer);
  }

  [[nodiscard]] std::vector<char> bytes() const {
    require(H5Fflush(file_.get(), H5F_SCOPE_LOCAL) >= 0);
    const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
    require(size > 0);
    std::vector<char> image(static_cast<std::size_t>(size));
    require(H5Fget_file_image(file_.get(), image.data(), image.size()) == size);
    return image;
  }

 private:
  void write(const std::string& name, hid_t type, hid_t space, const void* data) {
    const Handle dataset(H5Dcreate2(file_.get(), name.c_str(), type, space, parents_.get(), H5P_DEFAULT, H5P_DEFAULT));
    require(dataset.valid());
    if (data != nullptr) require(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
  }

  void require(bool good) const {
    if (!good) throw WriteError(path_, "cannot write the checkpoint: HDF5 fails in memory");
  }

  std::filesystem::path path_;
  Handle file_, parents_;
};

/// Closes the descriptor in any case.
class File {
 public:
  File(const std::filesystem::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (fd_ >= 0) ::close(fd_);
  }

  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  [[nodiscard]] bool sync() const { return ::fsync(fd_) == 0 || errno == EINVAL; }

  [[nodiscard]] bool write(std::span<const char> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n = ::write(fd_, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      done += static_cast<std::size_t>(n);
    }
    return true;
  }

 private:
  int fd_;
};

/// Reads all datasets below a group.
class Contents {
 public:
  explicit Contents(const std::filesystem::path& path) : path_(path) {
    if (std::error_code error; !std::filesystem::exists(path, error)) fail("there is no such checkpoint");
    if (const auto failure = unreadable(path)) fail("it is " + *failure);
    // The seal is checked before HDF5 reads the file: the library trusts the structure that it finds.
    if (const Seal seal = check_seal(path); seal != Seal::intact)
      fail(seal == Seal::broken ? "damaged: it has changed since it was written" : "not a checkpoint, or cut short");
    file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    if (!file_.valid()) fail("not a checkpoint");
    if (const std::string foreign = foreign_content(file_.get(), path); !foreign.empty())
      fail("not a checkpoint of hersey: it has " + foreign);
    if (H5Lexists(file_.get(), "format", H5P_DEFAULT) <= 0 || text("format") != kFormat) fail("not a checkpoint");
    if (numbers("format_version").values != std::vector<double>{kVersion})
      fail("a checkpoint of another version of the program");
  }

  void read(const std::string& group, Archive::Content& content) const {
    const Handle parent(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT));
    std::vector<std::string> names;
    H5Literate(parent.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
    for (const std::string& name : names) {
      const std::string path = group + "/" + name, key = path.substr(path.find('/') + 1);
      const Handle object(H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT));
      if (H5Iget_type(object.get()) == H5I_GROUP)
        read(path, content);
      else if (group.starts_with("texts"))
        content.texts[key] = text(path);
      else
        content.numbers[key] = numbers(path);
    }
  }

  [[nodiscard]] bool has(const char* group) const { return H5Lexists(file_.get(), group, H5P_DEFAULT) > 0; }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw ReadError(path_, reason); }

  static herr_t collect(hid_t, const char* name, const H5L_info_t*, void* data) {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  }

  [[nodiscard]] std::string text(const std::string& name) const {
    const Handle dataset(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT)), type = text_type();
    const Handle space(H5Screate(H5S_SCALAR));
    char* raw = nullptr;
    if (H5Dread(dataset.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &raw) < 0 || raw == nullptr)
      fail("cannot read " + name);
    std::string copy = raw;
    H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, &raw);
    return copy;
  }

  [[nodiscard]] Archive::Numbers numbers(const std::string& name) const {
    const Handle dataset(H5Dopen2(file_.get(), name.c_str(), H5P_DEFAULT)), space(H5Dget_space(dataset.get()));
    Archive::Numbers result{extent_of(space.get()), {}};
    result.values.resize(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0)));
    if (!result.values.empty() &&
        H5Dread(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()) < 0)
      fail("cannot read " + name);
    return result;
  }

  std::filesystem::path path_;
  Handle file_;
};

/// Path of a checkpoint until it is complete.
std::filesystem::path unfinished(std::filesystem::path path) { return path += ".new"; }

std::vector<char> image_of(const std::filesystem::path& path, const Archive::Content& content) {
  const Hdf5Session session;
  Image image(path);
  image.add("format", std::string(kFormat));
  image.add("format_version", Archive::Numbers{{}, {kVersion}});
  for (const auto& [name, numbers] : content.numbers) image.add("numbers/" + name, numbers);
  for (const auto& [name, text] : content.texts) image.add("texts/" + name, text);
  return image.bytes();
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Archive::Content& content) {
  const std::vector<char> bytes = image_of(path, content);
  const auto fail = [&] {
    throw WriteError(path, std::string("cannot write the checkpoint: ") + std::strerror(errno));
  };
  const std::string seal = seal_of(bytes);
  const File file(unfinished(path), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open() || !file.write(bytes) || !file.write(seal) || !file.sync()) fail();
  if (::rename(unfinished(path).c_str(), path.c_str()) != 0) fail();
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (const File parent(folder, O_RDONLY | O_DIRECTORY); !parent.is_open() || !parent.sync()) fail();
}

void remove_checkpoint(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  std::filesystem::remove(unfinished(path), ignored);
}

Archive::Content read_checkpoint(const std::filesystem::path& path) {
  const Hdf5Session session;
  const Contents contents(path);
  Archive::Content content;
  for (const char* group : {"numbers", "texts"})
    if (contents.has(group)) contents.read(group, content);
  return content;
}

}  // namespace hersey::results
