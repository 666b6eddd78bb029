#include "hersey/core/hdf5_content.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <vector>

#include "hersey/core/hdf5_handle.h"
#include "hersey/core/memory.h"

namespace hersey {
namespace {

constexpr int kDeepest = 32;
constexpr double kMostCompressed = 2000;  // deflate makes at most 1032 bytes of one
constexpr double kSmall = 1 << 20;        // [bytes] always accepted

struct Link {
  std::string name;
  H5L_type_t type;
};

herr_t collect(hid_t, const char* name, const H5L_info_t* info, void* links) {
  static_cast<std::vector<Link>*>(links)->push_back({name, info->type});
  return 0;
}

/// Visits all objects below a group.
class Survey {
 public:
  explicit Survey(double file_size) : file_size_(file_size) {}

  std::string of_group(hid_t group, const std::string& path, int depth) const {
    if (depth > kDeepest) return fmt::format("groups more than {} deep: '{}'", kDeepest, path.substr(0, 80));
    std::vector<Link> links;
    if (H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &links) < 0)
      return fmt::format("a group that cannot be read: '{}'", path);
    for (const Link& link : links)
      if (std::string foreign = of_link(group, link, path + "/" + link.name, depth); !foreign.empty()) return foreign;
    return {};
  }

 private:
  std::string of_link(hid_t group, const Link& link, const std::string& path, int depth) const {
    if (link.type == H5L_TYPE_SOFT) return fmt::format("a soft link: '{}'", path);
    if (link.type != H5L_TYPE_HARD) return fmt::format("a link to another file: '{}'", path);
    const Hdf5Handle object(H5Oopen(group, link.name.c_str(), H5P_DEFAULT));
    H5O_info_t info{};
    if (object.get() < 0 || H5Oget_info(object.get(), &info) < 0)
      return fmt::format("an object that cannot be read: '{}'", path);
    if (info.type == H5O_TYPE_DATASET) return of_data(object.get(), path);
    if (info.type != H5O_TYPE_GROUP) return {};
    // A group with two names may contain itself.
    if (info.rc > 1) return fmt::format("a group that has another name, too: '{}'", path);
    return of_group(object.get(), path, depth + 1);
  }

  std::string of_data(hid_t data, const std::string& path) const {
    const Hdf5Handle space(H5Dget_space(data)), type(H5Dget_type(data)), made(H5Dget_create_plist(data));
    if (H5Pget_external_count(made.get()) != 0 || H5Pget_layout(made.get()) == H5D_VIRTUAL)
      return fmt::format("a data set whose numbers lie in another file: '{}'", path);
    // The product of integers may overflow; that of doubles does not.
    double bytes = static_cast<double>(H5Tget_size(type.get()));
    for (const std::size_t length : extent_of(space.get())) bytes *= static_cast<double>(length);
    if (bytes > kSmall && bytes > kMostCompressed * file_size_)
      return fmt::format("a data set of {:.3g} GB in a file of {:.3g} GB: '{}'", bytes / 1e9, file_size_ / 1e9, path);
    if (bytes > usable_memory())
      return fmt::format("a data set of {:.3g} GB, more than the {:.3g} GB of memory: '{}'", bytes / 1e9,
                         usable_memory() / 1e9, path);
    return {};
  }

  double file_size_;
};

}  // namespace

std::string foreign_content(std::int64_t file, const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const Hdf5Handle root(H5Gopen2(file, "/", H5P_DEFAULT));
  if (error || root.get() < 0) return "no group '/'";
  return Survey(static_cast<double>(size)).of_group(root.get(), "", 0);
}

}  // namespace hersey
