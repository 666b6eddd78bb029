#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "cad/cad_meshes.h"
#include "events/event_log.h"
#include "folder/folder.h"
#include "hersey/workbench/answers.h"
#include "runs/runs.h"
#include "runs/studies.h"
#include "server/exchange.h"

namespace hersey::workbench {

/// The routes of the workbench: the page, and the interface below /api/ (docs/workbench.md).
class Api {
 public:
  /// @param open  model that the page opens, relative to the folder; empty: none
  Api(Folder& folder, Runs& runs, EventLog& events, std::string open, const std::atomic<bool>& stop)
      : folder_(folder),
        runs_(runs),
        events_(events),
        open_(std::move(open)),
        stop_(stop),
        answers_(folder.path()),
        cad_(folder, runs.program()),
        studies_(folder, runs, runs.program()) {}

  [[nodiscard]] Reply handle(const Request& request);

 private:
  [[nodiscard]] Reply route(const Request& request);
  [[nodiscard]] Reply hello() const;
  [[nodiscard]] Reply files() const;
  [[nodiscard]] Reply file(const Request& request);
  [[nodiscard]] Reply event_stream(const Request& request);
  [[nodiscard]] Reply start_cad(const Request& request);
  [[nodiscard]] Reply of_cad(const Request& request);
  [[nodiscard]] Reply run_list() const;
  [[nodiscard]] Reply of_run(const Request& request);
  [[nodiscard]] Reply report(const std::vector<std::string>& ids, const std::vector<std::string>& names = {});
  /// `{url}` under which a report is shown as long as the server lives.
  [[nodiscard]] Reply ticket_for(const std::filesystem::path& page);
  [[nodiscard]] Reply report_file(const Request& request);

  Folder& folder_;
  Runs& runs_;
  EventLog& events_;
  std::string open_;
  const std::atomic<bool>& stop_;
  Answers answers_;
  CadMeshes cad_;
  Studies studies_;
  std::once_flag schema_made_;
  std::string schema_;
  std::atomic<int> streams_ = 0;  // of events
  std::mutex tickets_mutex_;
  std::deque<std::pair<std::string, std::filesystem::path>> tickets_;  // of reports, the oldest first
};

}  // namespace hersey::workbench
