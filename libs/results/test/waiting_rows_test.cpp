#include "waiting_rows.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace hersey::results {
namespace waiting_rows_test {

using Taken = std::map<std::size_t, std::vector<double>>;

Taken taken(WaitingRows& rows, const std::vector<std::size_t>& widths) {
  Taken all;
  rows.take_out(widths, [&](std::size_t series, std::span<const double> numbers) {
    all[series].assign(numbers.begin(), numbers.end());
  });
  return all;
}

void add(WaitingRows& rows, std::size_t first, std::size_t count, const std::vector<double>& numbers) {
  std::copy(numbers.begin(), numbers.end(), rows.open(numbers.size()).begin());
  rows.add(first, count);
}

TEST_CASE("WaitingRows_ComeOutSeriesBySeriesInTheirOrder") {
  WaitingRows rows;
  rows.expect(3, 2);
  for (const double t : {1.0, 2.0, 3.0}) {  // one step more than expected
    add(rows, 0, 1, {t});
    add(rows, 1, 1, {10 * t, 20 * t});
  }
  CHECK(rows.numbers() == 9);
  const Taken all = taken(rows, {1, 2});
  CHECK(all.at(0) == std::vector{1.0, 2.0, 3.0});
  CHECK(all.at(1) == std::vector{10.0, 20.0, 20.0, 40.0, 30.0, 60.0});
  CHECK(rows.numbers() == 0);
}

TEST_CASE("WaitingRows_HandedOverTogetherAreThoseHandedOverOneByOne") {
  const std::vector<std::size_t> widths{1, 2, 1, 3};
  WaitingRows single, together;
  for (const double t : {1.0, 2.0, 3.0}) {
    add(single, 0, 1, {t});
    add(single, 1, 1, {t + 1, t + 2});
    add(single, 2, 1, {t + 3});
    if (t != 2) add(single, 3, 1, {t + 4, t + 5, t + 6});
    add(together, 0, 3, {t, t + 1, t + 2, t + 3});
    if (t != 2) add(together, 3, 1, {t + 4, t + 5, t + 6});
  }
  const Taken all = taken(together, widths);
  CHECK(all == taken(single, widths));
  CHECK(all.at(3) == std::vector{5.0, 6.0, 7.0, 7.0, 8.0, 9.0});
}

TEST_CASE("WaitingRows_AreThereOnceTheyAreAdded") {
  WaitingRows rows;
  rows.open(2).front() = 7;  // and given up
  CHECK(rows.numbers() == 0);
  CHECK(std::vector(rows.open(2).begin(), rows.open(2).end()) == std::vector{0.0, 0.0});
  rows.add(0, 2);
  CHECK(taken(rows, {1, 1}) == Taken{{0, {0.0}}, {1, {0.0}}});
}

TEST_CASE("WaitingRows_OfSeriesWithoutAnyAreNone") {
  WaitingRows rows;
  rows.expect(1, 10);
  add(rows, 0, 1, {1.0});
  add(rows, 2, 1, {3.0, 4.0, 5.0});  // nothing of series 1
  CHECK(taken(rows, {1, 1, 3}) == Taken{{0, {1.0}}, {2, {3.0, 4.0, 5.0}}});
  add(rows, 1, 1, {6.0});
  CHECK(taken(rows, {1, 1, 3}) == Taken{{1, {6.0}}});
}

TEST_CASE("WaitingRows_LargerThanWhatIsPreparedOrGatheredAtATimeKeepEveryNumber") {
  WaitingRows rows;
  const std::vector<double> row(300000, 0.5);  // 2.4 MB: the third begins beyond what was prepared with the first
  rows.expect(row.size() + 1, 7);
  for (int i = 0; i < 7; ++i) {
    add(rows, 0, 1, row);
    add(rows, 1, 1, {1.0 * i});
  }
  const Taken all = taken(rows, {row.size(), 1});
  CHECK(all.at(0) == std::vector<double>(7 * row.size(), 0.5));
  CHECK(all.at(1) == std::vector{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
}

}  // namespace waiting_rows_test
}  // namespace hersey::results
