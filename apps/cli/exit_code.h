#pragma once

namespace hersey::cli {

/// Exit codes of the program; listed in `hersey --help`.
enum ExitCode : int {
  kOk = 0,
  kFailed = 1,         ///< the simulation or its results file failed; what was written stays readable
  kWrongInput = 2,     ///< usage, model file, missing or already existing files; nothing was written
  kInterrupted = 130,  ///< stopped by Ctrl-C; what was written stays readable
};

}  // namespace hersey::cli
