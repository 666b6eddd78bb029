#pragma once

namespace hersey {

/// Version of the libraries, "major.minor.patch".
[[nodiscard]] const char* version();

}  // namespace hersey
