#include "waiting_rows.h"

#include <doctest/doctest.h>

#include <array>
#include <map>

namespace hersey::results {
namespace waiting_rows_test {

std::map<std::size_t, std::vector<double>> taken(WaitingRows& rows) {
  std::map<std::size_t, std::vector<double>> all;
  rows.take_out([&](std::size_t series, const std::vector<double>& numbers) { all[series] = numbers; });
  return all;
}

TEST_CASE("WaitingRows_ComeOutSeriesBySeriesInTheirOrder") {
  WaitingRows rows;
  rows.expect(2, 3, 2);
  for (const double t : {1.0, 2.0, 3.0}) {  // one step more than expected
    rows.add(0, std::array{t});
    rows.add(1, std::array{10 * t, 20 * t});
  }
  CHECK(rows.numbers() == 9);
  const auto all = taken(rows);
  CHECK(all.at(0) == std::vector{1.0, 2.0, 3.0});
  CHECK(all.at(1) == std::vector{10.0, 20.0, 20.0, 40.0, 30.0, 60.0});
  CHECK(rows.numbers() == 0);
}

TEST_CASE("WaitingRows_OfSeriesThatComeLaterAreKeptToo") {
  WaitingRows rows;
  rows.expect(1, 1, 10);
  rows.add(0, std::array{1.0});
  rows.add(2, std::array{3.0, 4.0, 5.0});  // nothing of series 1
  CHECK(taken(rows) == std::map<std::size_t, std::vector<double>>{{0, {1.0}}, {2, {3.0, 4.0, 5.0}}});
  rows.add(1, std::array{6.0});
  CHECK(taken(rows) == std::map<std::size_t, std::vector<double>>{{1, {6.0}}});
}

TEST_CASE("WaitingRows_LargerThanWhatIsPreparedAtATimeKeepEveryNumber") {
  WaitingRows rows;
  const std::vector<double> row(300000, 0.5);  // 2.4 MB: the third begins beyond what was prepared with the first
  for (int i = 0; i < 7; ++i) rows.add(0, row);
  const auto all = taken(rows);
  CHECK(all.at(0) == std::vector<double>(7 * row.size(), 0.5));
}

}  // namespace waiting_rows_test
}  // namespace hersey::results
