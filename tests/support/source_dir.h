#pragma once

namespace hersey {

/// Where the sources lie, for tests that read files among them. A function, not a definition for every file: tests
/// compile to the same bytes wherever the sources lie, and the compiler cache serves the next clone.
[[nodiscard]] const char* source_dir();

}  // namespace hersey
