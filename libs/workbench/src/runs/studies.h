#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "folder/folder.h"
#include "runs/runs.h"

namespace hersey::workbench {

/// What the page shows of studies as tables: the runs that a text plans, and what the runs of one that was started have
/// given so far. Both are read from what `hersey study` writes.
/// @verified_by tests/workbench/studies_test.py
class Studies {
 public:
  Studies(Folder& folder, const Runs& runs, std::filesystem::path program)
      : folder_(folder), runs_(runs), program_(std::move(program)) {}

  /// `{path, text, set}` -> what `hersey study --plan` writes of this text, as JSON.
  /// @throws Refused 422 with the faults of the study, or with what is lacking to plan it
  [[nodiscard]] std::string plan(const nlohmann::json& request) const;

  /// `{plan, units: {figure: {unit, si}}, records: [{run, values, status, error, figures}], at}`: with an empty `after`
  /// all that the study has on record, else what has come since the answer whose `at` it is. At most 1000 records at a
  /// time; `more` says that some are left. Lines of another form are left out, as are those above 4 MB.
  /// @throws Refused 404 for a run that is no study
  [[nodiscard]] std::string course(const std::string& id, const std::string& after) const;

  /// True where the machine can hand runs to a cluster: it has sbatch.
  [[nodiscard]] static bool has_cluster();

 private:
  Folder& folder_;
  const Runs& runs_;
  std::filesystem::path program_;
};

}  // namespace hersey::workbench
