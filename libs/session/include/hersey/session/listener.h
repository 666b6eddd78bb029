#pragma once

#include <cstddef>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/run/options.h"
#include "hersey/study/study.h"

namespace hersey::session {

/// Events of a run, or of all runs of a study, in the order in which they come: `warned`, then `stepped` and
/// `cycle_ended`, `stopping` where a stop has been noticed, `finished`. `run` is the run's index, 0 of a single one.
/// Calls come one at a time, from the thread of the run that they are about, which waits for them. A client overrides
/// what it shows.
/// @verified_by session_test.cpp
class Listener {
 public:
  /// Hears nothing.
  Listener() = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  virtual ~Listener() = default;

  /// Before the run: all warnings of its model and its start, if RunOptions::check_start asks for them.
  virtual void warned(std::size_t run, const std::vector<Fault>& warnings);
  /// The start is known, or a step has been accepted.
  virtual void stepped(std::size_t run, const run::Progress& progress);
  /// A cycle of a single run has ended.
  virtual void cycle_ended(std::size_t run, const run::CycleProgress& cycle);
  /// All that computed has noticed the stop; checkpoints and results are yet to be written.
  virtual void stopping();
  /// The run has ended, whichever way, and its results are closed.
  virtual void finished(std::size_t run, const study::RunResult& result);
};

}  // namespace hersey::session
