#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "temporary_directory.h"

/// Every program of tests works in a folder of its own, so that tests at the same time do not find each other's files.
int main(int count, char** arguments) try {
  const hersey::TemporaryDirectory folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  const int failed = doctest::Context(count, arguments).run();
  std::filesystem::current_path(before);
  return failed;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return EXIT_FAILURE;
}
