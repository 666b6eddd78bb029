#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "hersey/run/simulate.h"

namespace hersey::cli {

/// One line on stderr with the progress of a run: share, time, step, Newton iterations, smallest film so far and the
/// time left. On a terminal it is redrawn in the same line; otherwise a line is printed every ten seconds.
class ProgressBar {
 public:
  ProgressBar();

  /// @param label  which run of a study this is, "3/14"; empty for a single run.
  void show(const std::string& label, const run::Progress& progress);

  /// Removes the bar, so that other text may follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  std::size_t width_;
  bool drawn_ = false;
  Clock::time_point last_;
};

}  // namespace hersey::cli
