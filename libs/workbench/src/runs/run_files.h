#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

/// What lies in the folders of runs. Anybody may have put it there: links are not followed, and what cannot be read
/// is as if it were not there.
namespace hersey::workbench {

/// False for a link to a folder.
[[nodiscard]] bool is_own_folder(const std::filesystem::path& folder);
/// [bytes]; 0 if there is no such file.
[[nodiscard]] std::uintmax_t size_of(const std::filesystem::path& file);
/// [s] since 1970; 0 if there is no such file.
[[nodiscard]] double time_of(const std::filesystem::path& file);
/// Differs between two contents of a file that is replaced as a whole: the second may follow the first within one tick
/// of the clock that times files, but is another file.
[[nodiscard]] std::string record_mark(const std::filesystem::path& file);
/// Bytes of a file from `begin` on, at most `most`; empty if it cannot be read.
[[nodiscard]] std::string part_of(const std::filesystem::path& file, std::uintmax_t begin, std::uintmax_t most);
/// The last bytes of a file, at most `most`.
[[nodiscard]] std::string tail_of(const std::filesystem::path& file, std::uintmax_t most);
/// What lies in a folder; none of it if the folder cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
/// Letters, digits, '-' and '_' alone: names of folders that no shell and no page has to quote.
[[nodiscard]] std::string plain_name(const std::string& name);
/// Names of the runs in `folder`/runs.
[[nodiscard]] std::vector<std::string> own_runs(const std::filesystem::path& folder);
/// Name of a link in the folder of a run, empty if there is none. One in the place of any file, of those that are
/// replaced through a temporary file as well, would be followed when it is written.
[[nodiscard]] std::string link_among(const std::filesystem::path& folder);
/// @throws Refused 507 on a full disk, else 403
[[noreturn]] void cannot_make(const std::filesystem::path& folder, const std::error_code& error);

}  // namespace hersey::workbench
