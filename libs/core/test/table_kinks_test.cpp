#include <doctest/doctest.h>

#include <vector>

#include "hersey/core/table_function.h"

namespace hersey {
namespace table_kinks_test {

using Points = std::vector<double>;

TEST_CASE("Kinks_AreWhereTheSlopeJumps") {
  const TableFunction table({0, 1, 2, 4, 5}, {0, 1, 2, 2, 2}, {});
  CHECK(table.kinks(0, 5) == Points{2});  // 0-1-2 is straight, so is 2-4-5
  CHECK(table.kinks(2, 5).empty());       // only strictly inside
  const TableFunction smooth({0, 1, 2}, {0, 1, 0}, {.interpolation = Interpolation::smooth});
  CHECK(smooth.kinks(0, 2).empty());
}

TEST_CASE("Kinks_OfAPeriodicTableRepeat") {
  const TableFunction table({0, 1, 4}, {0, 1, 0}, {.period = 4});
  CHECK(table.kinks(-4.5, 5.5) == Points{-4, -3, 0, 1, 4, 5});
}

}  // namespace table_kinks_test
}  // namespace hersey
