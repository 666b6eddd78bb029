#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hersey/fmi/description.h"

namespace hersey::fmi {

/// The file of an FMU, a ZIP archive, opened for reading. Names of its entries that lead out of a folder, encrypted and
/// damaged content are refused.
/// @verified_by fmu_file_test.cpp
class FmuFile {
 public:
  /// Reads the list of its entries.
  /// @throws FmuError if it cannot be read or is no ZIP archive
  explicit FmuFile(std::filesystem::path path);

  /// As given.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// True if there is an entry of this name, with '/' between folders.
  [[nodiscard]] bool has(const std::string& name) const;
  /// Names of the folders in `binaries`: the platforms that the FMU runs on.
  [[nodiscard]] std::vector<std::string> platforms() const;
  /// The content of an entry. @throws FmuError if there is none, or it is damaged
  [[nodiscard]] std::string content(const std::string& name) const;
  /// The description in `modelDescription.xml`. @throws FmuError
  [[nodiscard]] Description description() const;
  /// Writes all entries below `prefix`, "resources/", to the same names below `folder`.
  /// @throws FmuError, std::filesystem::filesystem_error
  void extract(const std::string& prefix, const std::filesystem::path& folder) const;

 private:
  struct Entry {
    std::string name;
    std::uint64_t offset = 0;  ///< of its local header
    std::uint32_t packed = 0, size = 0, checksum = 0;
    int method = 0;
  };
  [[nodiscard]] std::string content(const Entry& entry) const;

  std::filesystem::path path_;
  std::vector<Entry> entries_;
};

/// Name of the folder for this computer's libraries inside `binaries` of an FMU of the standard's version 2 or 3.
/// Version 2 has a name of its own for computers of x86 only, and takes those of version 3 for all others (FMI 2.0.5,
/// section 2.3).
[[nodiscard]] std::string platform(int version);

/// Name of the library of an FMU inside its file, on this platform: "binaries/x86_64-linux/controller.so".
[[nodiscard]] std::string library_name(const Description& description);

/// Why an FMU has no library for this platform; empty where it has one.
[[nodiscard]] std::string missing_library(const FmuFile& file, const Description& description);

}  // namespace hersey::fmi
