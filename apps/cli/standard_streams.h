#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <system_error>
#include <utility>

namespace hersey::cli {

/// Opens those of the descriptors 0, 1 and 2 on nothing that the caller has closed. Else the next file opened would get
/// one of them, and what is printed would go into it. Call it before anything is opened.
/// @throws std::system_error where there is no /dev/null.
void open_standard_streams();

/// Prints a message for the user on standard error. Where nobody can read it (a pipe whose reader has gone, a terminal
/// that is closed, a full disk) it is lost, and work goes on.
template <class... T>
void say(fmt::format_string<T...> format, T&&... arguments) {
  try {
    fmt::print(stderr, format, std::forward<T>(arguments)...);
  } catch (const std::system_error&) {
    std::clearerr(stderr);
  }
}

/// Puts the rest of standard output out. @returns false, and says so, if it was lost to anything but a reader that has
/// seen enough.
[[nodiscard]] bool finish_standard_output();

}  // namespace hersey::cli
