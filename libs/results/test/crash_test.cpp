// What is left of a results file when the program is killed or the disk is full.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>

#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "temporary_directory.h"

namespace hersey::results {
namespace crash_test {

/// Contents of the k-th row of every series, so that a reader can detect a lost or mixed row.
double value(std::size_t row, std::size_t series) {
  return std::sin(static_cast<double>(row)) + static_cast<double>(series);
}

constexpr std::size_t series_count = 40;

struct Run {
  Writer writer;
  std::vector<Series> series;
  Series pressure, field_time;
  std::size_t row = 0;

  explicit Run(const std::filesystem::path& path, bool writes_beside = false)
      : writer(path, {.flush_interval = writes_beside ? 0 : 0.5, .writes_beside = writes_beside}) {
    for (std::size_t s = 0; s < series_count; ++s)
      series.push_back(writer.series("/bearings/b/s" + std::to_string(s), 1, "1", "test series"));
    field_time = writer.series("/bearings/b/fields/time", 1, "s", "time");
    pressure = writer.field("/bearings/b/fields/pressure", {60, 13}, "Pa", "pressure");
  }

  void step() {
    for (std::size_t s = 0; s < series_count; ++s) series[s].append(value(row, s));
    field_time.append(static_cast<double>(row));
    pressure.append(std::vector<double>(60 * 13, value(row, 0)));
    ++row;
  }
};

/// @returns number of rows, all of which must be right.
std::size_t check_rows(const std::filesystem::path& path) {
  const Reader reader(path);
  for (std::size_t s = 0; s < series_count; ++s) {
    const Array data = reader.read("/bearings/b/s" + std::to_string(s));
    REQUIRE(data.values.size() == reader.rows());
    for (std::size_t row = 0; row < data.values.size(); ++row) REQUIRE(data.values[row] == value(row, s));
  }
  const Array time = reader.read("/bearings/b/fields/time"), pressure = reader.read("/bearings/b/fields/pressure");
  REQUIRE(time.values.size() == pressure.info.shape[0]);
  for (std::size_t i = 0; i < pressure.values.size(); ++i) REQUIRE(pressure.values[i] == value(i / (60 * 13), 0));
  return reader.rows();
}

void wait_for(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
}

TEST_CASE("FlushedRows_SurviveSigkill") {
  const TemporaryDirectory directory;
  const auto path = directory / "killed.h5";
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  if (child == 0) {
    Run run(path);
    for (int k = 0; k < 500; ++k) run.step();
    run.writer.flush();
    for (int k = 0; k < 300; ++k) run.step();
    const bool is_reported = write(ready[1], "x", 1) == 1;
    pause();
    _exit(is_reported ? 0 : 1);
  }
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  kill(child, SIGKILL);
  wait_for(child);

  CHECK(check_rows(path) == 500);
  CHECK(Reader(path).text_attribute("/", "status") == "running");

  const std::string python = "/usr/bin/python3 -c \"import h5py\" 2>/dev/null";
  if (std::system(python.c_str()) != 0) {
    MESSAGE("h5py is not installed: reading with it is not tested");
    return;
  }
  const std::string script =
      "/usr/bin/python3 -c \"import h5py, sys; f = h5py.File(sys.argv[1], 'r'); "
      "d = f['bearings/b/s7']; assert d.shape == (500,) and d.attrs['units'] == '1'; "
      "assert f.attrs['status'] == 'running'; "
      "assert f['bearings/b/fields/pressure'].shape == (500, 60, 13)\" " +
      path.string();
  CHECK(std::system(script.c_str()) == 0);
}

TEST_CASE("KilledAtAnyMoment_LeavesAReadableFile") {
  // Flushing after every step, the child spends most of its life inside a flush: the worst case, many times over.
  const TemporaryDirectory directory;
  std::size_t most_rows = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const bool writes_beside = trial % 3 == 2;
    const auto path = directory / "killed.h5";
    std::filesystem::remove(path);
    int ready[2];
    REQUIRE(pipe(ready) == 0);
    const pid_t child = fork();
    if (child == 0) {
      Run run(path, writes_beside);
      run.writer.flush();
      if (write(ready[1], "x", 1) != 1) _exit(1);
      for (;;) {
        run.step();
        if (writes_beside)
          run.writer.flush_if_due();
        else
          run.writer.flush();
      }
    }
    char byte = 0;
    REQUIRE(read(ready[0], &byte, 1) == 1);
    usleep(static_cast<useconds_t>(2000 + 1709 * trial));
    kill(child, SIGKILL);
    wait_for(child);
    close(ready[0]);
    close(ready[1]);
    CAPTURE(trial);
    most_rows = std::max(most_rows, check_rows(path));
  }
  MESSAGE("most rows in a killed file: ", most_rows);
  CHECK(most_rows > 1);
}

TEST_CASE("KilledInTheFirstFlush_HasNoCompleteRow") {
  // A kill between the headers of two series: the first knows of its row, the second has none.
  const TemporaryDirectory directory;
  Writer writer(directory / "killed.h5", {});
  const Series first = writer.series("/a", 1, "1", "test series"), second = writer.series("/b", 1, "1", "test series");
  first.append(1.0);
  writer.flush();
  {
    const Reader reader(writer.path());
    CHECK(reader.rows() == 0);
    CHECK(reader.read("/a").values.empty());
  }
  second.append(2.0);
  writer.flush();
  const Reader reader(writer.path());
  CHECK(reader.rows() == 1);
  CHECK(reader.read("/a").values == std::vector{1.0});
}

TEST_CASE("IndexNodes_LieInOneMemoryPageEach") {
  // What the kills above meet only once in some hundred times: a write cut at a page's end cannot cut a node.
  const TemporaryDirectory directory;
  const auto path = directory / "run.h5";
  {
    Run run(path);
    for (int k = 0; k < 300; ++k) run.step();
  }
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string bytes = content.str();
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  // A chunk index node of a one-dimensional dataset, the smallest there is: head, 16 children, 17 keys (HDF5 file
  // format 3.0, III.A.1); its fifth byte, the node type, is 1.
  const std::size_t least = 24 + 16 * 8 + 17 * 24;
  int nodes = 0;
  for (std::size_t at = bytes.find("TREE"); at != std::string::npos; at = bytes.find("TREE", at + 1)) {
    if (bytes[at + 4] != 1) continue;
    ++nodes;
    CHECK(at % page + least <= page);
  }
  CHECK(nodes > 40);  // one for each series, several for the field
}

/// Runs in a child with a small file size limit, which to a program looks like a full disk.
/// @returns 0 if the writer reported it correctly.
int write_until_full(const std::filesystem::path& path, bool writes_beside) {
  const rlimit limit{3 << 20, 3 << 20};
  if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
  const int silent = open((path.string() + ".stderr").c_str(), O_CREAT | O_WRONLY, 0600);
  dup2(silent, STDERR_FILENO);
  try {
    Run run(path, writes_beside);
    try {
      for (int k = 0; k < 100000; ++k) {
        run.step();
        if (k % 10 == 9) writes_beside ? run.writer.flush_if_due() : run.writer.flush();
        // A program that does nothing else would fill the disk with what it hands over second.
        if (writes_beside && k % 50 == 49) run.writer.attribute("/", "reached", k);  // waits for what is under way
      }
      return 2;
    } catch (const WriteError& error) {
      const std::string message = error.what();
      if (message.find(path.string()) == std::string::npos) return 3;
      if (message.find("File too large") == std::string::npos) return 4;
    }
    try {
      run.writer.flush();
      return 5;
    } catch (const WriteError&) {
    }
    run.writer.finish(Status::failed, "disk full");  // closes quietly: the fault has been reported
  } catch (...) {
    return 6;
  }
  return 0;
}

TEST_CASE("FullDisk_IsReportedAndKeepsFlushedRows") {
  const TemporaryDirectory directory;
  bool writes_beside = false;
  SUBCASE("rows written when asked for") {}
  SUBCASE("rows written beside") { writes_beside = true; }
  const auto path = directory / "full.h5";
  const pid_t child = fork();
  if (child == 0) _exit(write_until_full(path, writes_beside));
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  const std::size_t rows = check_rows(path);
  MESSAGE("rows kept: ", rows);
  CHECK(rows > 100);
  CHECK(rows % 10 == 0);
  CHECK(std::filesystem::file_size(path.string() + ".stderr") == 0);  // HDF5 printed nothing of its own
}

}  // namespace crash_test
}  // namespace hersey::results
