#pragma once

#include <filesystem>
#include <string>

#include "runs/runs.h"

namespace hersey::workbench {

/// The film of a bearing as a run has stored it last, of a study its run that has written last, as JSON
/// (report::latest_film_json); `{"t": null}` before there is any. Another program reads the file, which may be damaged.
/// @param folder  that the run's paths start from
[[nodiscard]] std::string latest_film(const std::filesystem::path& program, const std::filesystem::path& folder,
                                      const RunEntry& run, const std::string& bearing);

}  // namespace hersey::workbench
