#pragma once

namespace hersey {

/// Returns the version of the libraries, "major.minor.patch".
[[nodiscard]] const char* version();

}  // namespace hersey
