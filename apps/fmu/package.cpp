#include "package.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>

#include "hersey/core/input_error.h"

namespace hersey::fmu {
namespace {

/// Of the C library and the loader, which every Linux has and which must be its own.
constexpr std::array<const char*, 8> kOfTheSystem{"libresolv.so",  "libc.so",  "libm.so",  "libdl.so",
                                                  "libpthread.so", "librt.so", "ld-linux", "linux-vdso.so"};

bool is_within(const std::filesystem::path& name) {
  return !name.is_absolute() &&
         std::none_of(name.begin(), name.end(), [](const std::filesystem::path& part) { return part == ".."; });
}

bool replace_all(std::string& text, const std::string& old, const std::string& replacement) {
  bool is_found = false;
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + replacement.size())) {
    text.replace(at, old.size(), replacement);
    is_found = true;
  }
  return is_found;
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

}  // namespace

PackedModel pack(const model::Model& model, const std::string& text, const std::vector<std::string>& overrides) {
  PackedModel packed{text, overrides, {}};
  const std::filesystem::path folder = std::filesystem::path(model.file).parent_path();
  for (const auto& [name, hash] : model.files) {
    const std::filesystem::path plain = std::filesystem::path(name).lexically_normal();
    const bool is_taken = plain == "model.yaml" || plain == "variables.json" || plain.begin()->string() == "udunits";
    std::string inside = plain.string();
    if (!is_within(plain) || is_taken) {
      inside = fmt::format("files/{}/{}", packed.files.size(), plain.filename().string());
      bool is_named = replace_all(packed.text, name, inside);
      for (std::string& change : packed.overrides) is_named = replace_all(change, name, inside) || is_named;
      if (!is_named)
        throw InputError(Fault{{model.file, 0, 0},
                               "",
                               "the file '" + name + "', whose name is put together from parameters",
                               "files whose names are plain values of the model, or that lie below it",
                               "write the name out"});
    }
    packed.files.push_back({folder / name, "resources/" + inside});
  }
  return packed;
}

std::vector<PackedFile> libraries_of(const std::filesystem::path& library) {
  std::string quoted = library.string();
  replace_all(quoted, "'", "'\\''");
  const std::unique_ptr<FILE, int (*)(FILE*)> listing(::popen(("ldd '" + quoted + "'").c_str(), "r"), ::pclose);
  if (listing == nullptr)
    throw std::runtime_error("ldd, which lists the libraries that a library needs, cannot be called");
  std::vector<PackedFile> found;
  std::array<char, 4096> line{};
  while (std::fgets(line.data(), line.size(), listing.get()) != nullptr) {
    std::istringstream words(line.data());
    std::string name, arrow, path;
    words >> name >> arrow >> path;
    const std::string file = std::filesystem::path(name).filename().string();
    const bool is_of_system = std::any_of(kOfTheSystem.begin(), kOfTheSystem.end(),
                                          [&](const char* known) { return file.starts_with(known); });
    if (arrow != "=>" || is_of_system) continue;
    if (path == "not")
      throw std::runtime_error(fmt::format("{} needs {}, which is not installed", library.string(), name));
    found.push_back({path, name});
  }
  if (found.empty()) throw std::runtime_error("what " + library.string() + " needs cannot be found");
  return found;
}

std::vector<PackedFile> licences_of(const std::vector<PackedFile>& files) {
  std::string command = "dpkg-query --search";
  for (const PackedFile& file : files) {
    // Packages name files as they were before /lib became a link to /usr/lib.
    const std::string path = std::filesystem::canonical(file.from).string();
    for (const std::string& name : {path, path.starts_with("/usr/") ? path.substr(4) : path})
      if (name.find('\'') == std::string::npos) command += " '" + name + "'";
  }
  const std::unique_ptr<FILE, int (*)(FILE*)> listing(::popen((command + " 2>/dev/null").c_str(), "r"), ::pclose);
  std::set<std::string> packages;
  std::array<char, 4096> line{};
  while (listing != nullptr && std::fgets(line.data(), line.size(), listing.get()) != nullptr) {
    const std::string text = line.data();
    packages.insert(text.substr(0, text.find(':')));
  }
  std::vector<PackedFile> found;
  for (const std::string& package : packages) {
    const std::filesystem::path copyright = std::filesystem::path("/usr/share/doc") / package / "copyright";
    if (std::filesystem::is_regular_file(copyright))
      found.push_back({copyright, "documentation/licenses/" + package + ".txt"});
  }
  return found;
}

void write_zip(const std::filesystem::path& path, const std::vector<std::pair<std::string, std::string>>& texts,
               const std::vector<PackedFile>& files) {
  int code = 0;
  std::unique_ptr<zip_t, Discard> archive(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (archive == nullptr) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw std::runtime_error(fmt::format("{}: {}", path.string(), why));
  }
  // Fast rather than small: most of it are libraries.
  const auto add = [&](const std::string& name, zip_source_t* source) {
    const zip_int64_t index =
        source == nullptr ? -1 : zip_file_add(archive.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
    const bool is_added =
        index >= 0 && zip_set_file_compression(archive.get(), static_cast<zip_uint64_t>(index), ZIP_CM_DEFLATE, 1) == 0;
    if (!is_added) throw std::runtime_error(fmt::format("{}: {}", path.string(), zip_strerror(archive.get())));
  };
  for (const auto& [name, text] : texts) add(name, zip_source_buffer(archive.get(), text.data(), text.size(), 0));
  for (const PackedFile& file : files)
    add(file.name, zip_source_file(archive.get(), std::filesystem::canonical(file.from).c_str(), 0, -1));
  if (zip_close(archive.get()) != 0)
    throw std::runtime_error(fmt::format("{}: {}", path.string(), zip_strerror(archive.get())));
  [[maybe_unused]] const zip_t* closed = archive.release();  // freed with that
}

}  // namespace hersey::fmu
