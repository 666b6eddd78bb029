#include "hersey/session/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>

#include "hersey/core/input_error.h"

namespace hersey::session {
namespace {

/// Canonical path of a file, links followed, that need not exist yet.
std::filesystem::path canonical_path(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path;
}

}  // namespace

void require_separate(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs) {
  std::vector<Fault> faults;
  std::map<std::filesystem::path, std::string> written;
  for (const auto& [option, path] : outputs) {
    std::error_code missing;
    const std::filesystem::file_status status = std::filesystem::status(path, missing);
    const bool is_device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
    if (path.empty() || is_device) continue;  // /dev/null takes everything
    const auto refuse = [&, &name = option, &at = path](const std::string& other) {
      faults.push_back({{"", 0, 0}, name, "'" + at.string() + "', which is " + other, "a file of its own", ""});
    };
    for (const std::filesystem::path& input : inputs) {
      // Files are compared by their number on the disk: hard links are one file under two paths.
      if (std::filesystem::equivalent(path, input, missing)) refuse("read as '" + input.string() + "'");
    }
    const auto [other, is_new] = written.try_emplace(canonical_path(path), option);
    if (!is_new) refuse("written by " + other->second + " too");
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

void require_writable(const std::vector<OutputFile>& outputs) {
  std::vector<Fault> faults;
  for (const auto& [option, path] : outputs) {
    if (path.empty()) continue;
    std::error_code missing;
    const bool exists = std::filesystem::exists(path, missing);
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const bool is_device = exists && !std::filesystem::is_regular_file(path, missing);
    // A file is written beside its name and renamed: the folder counts, too.
    const bool writable =
        (!exists || ::access(path.c_str(), W_OK) == 0) && (is_device || ::access(folder.c_str(), W_OK | X_OK) == 0);
    if (writable && !std::filesystem::is_directory(path, missing)) continue;
    const char* const reason = writable ? "it is a folder" : std::strerror(errno);
    faults.push_back({{"", 0, 0},
                      option,
                      "'" + path.string() + "', which cannot be written: " + reason,
                      "a file in a folder that exists and may be written to",
                      ""});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace hersey::session
