#include "hersey/study/quantities_page.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "hersey/bearing/quantities.h"
#include "hersey/core/contract.h"
#include "hersey/run/quantities.h"
#include "hersey/study/bearing_study.h"
#include "source_dir.h"

namespace hersey::study {
namespace quantities_page_test {

using run::QuantityInfo;

std::vector<QuantityInfo> series_of_runs() {
  std::vector<QuantityInfo> series;
  for (const QuantityInfo& quantity : run::quantities_of("/bearings/<b>/"))
    if (quantity.kind == QuantityInfo::Kind::series && !quantity.name.starts_with("fields/"))
      series.push_back(quantity);
  return series;
}

TEST_CASE("IdOfAQuantity_MeansOneThing") {
  std::set<std::string_view> ids;
  for (const bearing::QuantityList& list : bearing::bearing_quantities()) {
    for (const bearing::Quantity& quantity : list.quantities) {
      CAPTURE(quantity.id);
      CHECK(ids.insert(quantity.id).second);
      CHECK_FALSE(quantity.unit.empty());
      CHECK_FALSE(quantity.title.empty());
    }
  }
  CHECK_THROWS_AS((void)bearing::quantity("no_such_id"), ContractError);
}

TEST_CASE("SeriesOfARun_HaveTheUnitOfTheirQuantity") {
  for (const QuantityInfo& series : series_of_runs()) {
    CAPTURE(series.name);
    REQUIRE_NOTHROW((void)bearing::quantity(series.name));
    const bearing::Quantity& quantity = bearing::quantity(series.name);
    CHECK(series.unit == quantity.unit);
    CHECK(series.symbol == quantity.symbol);
    CHECK(series.text == quantity.definition());
  }
}

TEST_CASE("EveryQuantity_IsReportedSomewhere") {
  std::set<std::string> reported;
  for (const std::string& key : figure_keys()) reported.insert(key);
  for (const QuantityInfo& series : series_of_runs()) reported.insert(series.name);
  for (const bearing::QuantityList& list : bearing::bearing_quantities()) {
    for (const bearing::Quantity& quantity : list.quantities) {
      CAPTURE(quantity.id);
      CHECK(reported.contains(std::string(quantity.id)));
    }
  }
}

TEST_CASE("CommittedPageOfQuantities_IsFresh") {
  // Made again by `hersey schema --quantities > docs/quantities.md`.
  std::ostringstream text;
  text << std::ifstream(std::string(hersey::source_dir()) + "/docs/quantities.md").rdbuf();
  CHECK(text.str() == quantities_markdown());
}

}  // namespace quantities_page_test
}  // namespace hersey::study
