#include "events/event_log.h"

#include <doctest/doctest.h>

#include <string>
#include <thread>

namespace hersey::workbench {
namespace {

constexpr double kNoWait = 0;

TEST_CASE("EventLog_GivesEachReaderWhatItHasNotHad") {
  EventLog log;
  CHECK(log.after(0, kNoWait).empty());
  log.add("files", "1");
  log.add("run", "2");
  const std::vector<Event> all = log.after(0, kNoWait);
  REQUIRE(all.size() == 2);
  CHECK(all[0].number == 1);
  CHECK(all[1].name == "run");
  const std::vector<Event> rest = log.after(1, kNoWait);
  REQUIRE(rest.size() == 1);
  CHECK(rest[0].data == "2");
  CHECK(log.after(2, kNoWait).empty());
}

TEST_CASE("EventLog_AsksToReloadWhereEventsAreMissing") {
  EventLog log;
  constexpr int kMore = 5000;  // than are kept
  for (int i = 0; i < kMore; ++i) log.add("run", std::to_string(i));
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{800}, std::uint64_t{kMore + 1}}) {
    const std::vector<Event> events = log.after(number, kNoWait);
    REQUIRE(events.size() == 1);
    CHECK(events[0].name == "reload");
    CHECK(events[0].number == kMore);
  }
  // The oldest that is still known is the first of a whole answer.
  const std::uint64_t oldest = kMore - 4096;
  CHECK(log.after(oldest, kNoWait).size() == 4096);
  CHECK(log.after(oldest - 1, kNoWait).size() == 1);
  CHECK(log.after(kMore, kNoWait).empty());
}

TEST_CASE("EventLog_KeepsNoMoreBytesThanItMay") {
  EventLog log;
  const std::string long_line(std::size_t{1} << 20, 'x');
  constexpr std::uint64_t kAdded = 40;
  for (std::uint64_t i = 0; i < kAdded; ++i) log.add("run", long_line);
  CHECK(log.after(kAdded - 16, kNoWait).size() == 16);
  const std::vector<Event> too_old = log.after(kAdded - 17, kNoWait);
  REQUIRE(too_old.size() == 1);
  CHECK(too_old[0].name == "reload");
  // One that is longer than all that is kept is passed on.
  log.add("run", std::string(std::size_t{17} << 20, 'y'));
  CHECK(log.after(kAdded, kNoWait).size() == 1);
  CHECK(log.after(kAdded, kNoWait)[0].name == "run");
}

TEST_CASE("EventLog_WakesAReader") {
  EventLog log;
  std::thread writer([&] { log.add("run", "{}"); });
  constexpr double kLong = 60;  // [s]: never waited for
  CHECK(log.after(0, kLong).size() == 1);
  writer.join();
}

}  // namespace
}  // namespace hersey::workbench
