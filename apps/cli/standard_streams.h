#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <system_error>
#include <utility>

namespace hersey::cli {

/// Opens closed standard descriptors (0, 1, 2) on /dev/null. Otherwise the next file opened would get one of them, and
/// printed text would go into it. To be called before any file is opened.
/// @throws std::system_error if there is no /dev/null
void open_standard_streams();

/// Prints a message for the user on standard error. If it cannot be read (a pipe whose reader has ended, a closed
/// terminal, a full disk) it is lost, and the program continues.
template <class... T>
void say(fmt::format_string<T...> format, T&&... arguments) {
  try {
    fmt::print(stderr, format, std::forward<T>(arguments)...);
  } catch (const std::system_error&) {
    std::clearerr(stderr);
  }
}

/// Flushes standard output.
/// @returns false, with a message, if it was lost for any reason but a reader that has ended
[[nodiscard]] bool finish_standard_output();

}  // namespace hersey::cli
