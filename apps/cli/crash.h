#pragma once

namespace hersey::cli {

/// Installs a handler that reports a crash inside HDF5, while it reads a file without a checksum, as a damaged file,
/// with the exit code of wrong input. Other crashes stay crashes.
void report_crashes_of_damaged_files();

}  // namespace hersey::cli
