#include "runs/event_history.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "temporary_directory.h"

namespace hersey::workbench {
namespace {

using Lines = std::vector<nlohmann::json>;

/// Events of a run of `steps` steps at the times 0, 1, ..., each of `filling` bytes and some, with a cycle every 100.
void write_events(const std::filesystem::path& file, int steps, std::size_t filling) {
  std::ofstream stream(file);
  const std::string rest(filling, 'x');
  stream << R"({"kind":"started","t":0})" << '\n';
  for (int step = 0; step < steps; ++step) {
    stream << R"({"kind":"stepped","t":)" << step << R"(,"rest":")" << rest << "\"}\n";
    if (step % 100 == 99) stream << R"({"kind":"cycle","t":)" << step << "}\n";
  }
  stream << R"({"kind":"finished"})" << '\n' << R"({"kind":"step)";
}

Lines thinned(const std::filesystem::path& file, std::size_t most) {
  Lines lines;
  std::istringstream text(thinned_events(file, most));
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

std::vector<int> times_of(const Lines& lines, const std::string& kind) {
  std::vector<int> times;
  for (const nlohmann::json& line : lines)
    if (line["kind"] == kind) times.push_back(line["t"].get<int>());
  return times;
}

TEST_CASE("EventHistory_OfAShortRun_IsWhole") {
  const TemporaryDirectory folder;
  write_events(folder / "events", 250, 10);
  CHECK(thinned(folder / "events", 4000).size() == 254);
  CHECK(thinned_events(folder / "none", 4000).empty());
}

TEST_CASE("EventHistory_IsThinnedOutEvenly_FirstAndLastKept") {
  const TemporaryDirectory folder;
  constexpr int kSteps = 5000;
  write_events(folder / "events", kSteps, 10);
  const Lines lines = thinned(folder / "events", 500);
  CHECK(lines.front()["kind"] == "started");
  CHECK(lines.back()["kind"] == "finished");
  const std::vector<int> times = times_of(lines, "stepped");
  CHECK(times.size() <= 500);
  CHECK(times.size() > 400);
  CHECK(times.front() == 0);
  CHECK(times.back() == kSteps - 1);
  for (std::size_t i = 1; i + 1 < times.size(); ++i) CHECK(times[i] - times[i - 1] == times[1]);
  CHECK(times_of(lines, "cycle").size() == 50);
}

TEST_CASE("EventHistory_OfAnyLength_IsSmall") {
  const TemporaryDirectory folder;
  constexpr int kSteps = 30'000;
  for (const std::size_t filling : {std::size_t{1'000}, std::size_t{2'000}}) {  // read as a whole, and in parts
    write_events(folder / "events", kSteps, filling);
    const Lines lines = thinned(folder / "events", 4000);
    CHECK(thinned_events(folder / "events", 4000).size() < std::size_t{9} << 20);
    CHECK(lines.front()["kind"] == "started");
    CHECK(lines.back()["kind"] == "finished");
    const std::vector<int> times = times_of(lines, "stepped");
    CHECK(times.size() <= 4000);
    CHECK(times.size() > 3000);
    CHECK(times.back() == kSteps - 1);
    CHECK(times.front() < 20);
    int widest = 0;
    for (std::size_t i = 1; i < times.size(); ++i) {
      CHECK(times[i] > times[i - 1]);
      widest = std::max(widest, times[i] - times[i - 1]);
    }
    CHECK(widest <= 3 * kSteps / 4000);
  }
}

TEST_CASE("EventHistory_OfLinesThatAreTooLong_LeavesThemOut") {
  const TemporaryDirectory folder;
  {
    std::ofstream stream(folder / "events");
    stream << R"({"kind":"started","t":0})" << '\n' << std::string(std::size_t{40} << 20, 'x') << '\n';
    stream << R"({"kind":"finished","t":1})" << '\n';
  }
  CHECK(thinned(folder / "events", 4000).size() == 2);
}

}  // namespace
}  // namespace hersey::workbench
