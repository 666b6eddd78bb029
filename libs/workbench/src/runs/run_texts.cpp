#include "hersey/workbench/refused.h"
#include "runs/event_history.h"
#include "runs/run_files.h"
#include "runs/runs.h"

namespace hersey::workbench {
namespace {

constexpr std::uintmax_t kMostLog = 256 << 10;
constexpr std::uintmax_t kMostModel = std::uintmax_t{16} << 20;

}  // namespace

std::string Runs::log(const std::string& id) const {
  return tail_of(folder_.path() / find(id).folder / "log.txt", kMostLog);
}

std::string Runs::model_text(const std::string& id) const {
  const Path file = folder_.path() / find(id).folder / "model.txt";
  if (size_of(file) == 0) throw Refused(404, "the model of this run is not known", "");
  return tail_of(file, kMostModel);
}

std::string Runs::history_in_study(const std::string& id, const std::string& run, std::size_t most) const {
  const Path runs = folder_.path() / find(id).folder / "runs";
  if (run != plain_name(run) || !is_own_folder(runs)) throw Refused(404, "there is no such run in this study", "");
  return thinned_events(runs / (run + ".events"), most);
}

std::string Runs::history(const std::string& id, std::size_t most) const {
  return thinned_events(folder_.path() / find(id).folder / "events.ndjson", most);
}

}  // namespace hersey::workbench
