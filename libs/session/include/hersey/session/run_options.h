#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "hersey/run/options.h"

namespace hersey::session {

/// What becomes of results that exist already.
enum class Existing {
  keep,               ///< they are kept and the run is refused
  replace,            ///< they are replaced
  resume,             ///< the run goes on from its checkpoint or begins anew without one; complete results are kept
  resume_or_replace,  ///< as `resume` if there is a checkpoint, else as `replace`; of a single run
};

struct RunOptions {
  Existing existing = Existing::keep;
  bool step_error = false;                   ///< run with steps twice as long too, and compare
  bool check_start = false;                  ///< find the start once before the run, for Listener::warned
  int threads = 0;                           ///< runs of a study at the same time; 0: one per core
  const std::atomic<bool>* stop = nullptr;   ///< set from another thread or a signal handler: end after the step
  std::vector<std::filesystem::path> pages;  ///< that the client writes of the results: no input may be one of them
  std::vector<run::StudyParameterValue> study_parameters = {};  ///< of a single run, for its results file
};

}  // namespace hersey::session
