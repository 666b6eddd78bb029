#pragma once

#include <atomic>
#include <string>

#include "folder/folder.h"
#include "server/event_log.h"
#include "server/exchange.h"

namespace hersey::workbench {

/// The routes of the workbench: the page, and the interface below /api/ (docs/workbench.md).
class Api {
 public:
  /// @param open  model that the page opens, relative to the folder; empty: none
  Api(Folder& folder, EventLog& events, std::string open, const std::atomic<bool>& stop)
      : folder_(folder), events_(events), open_(std::move(open)), stop_(stop) {}

  [[nodiscard]] Reply handle(const Request& request);

 private:
  [[nodiscard]] Reply route(const Request& request);
  [[nodiscard]] Reply hello() const;
  [[nodiscard]] Reply files() const;
  [[nodiscard]] Reply file(const Request& request);
  [[nodiscard]] Reply event_stream(const Request& request) const;

  Folder& folder_;
  EventLog& events_;
  std::string open_;
  const std::atomic<bool>& stop_;
};

}  // namespace hersey::workbench
