#include "hersey/run/quantities.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "hersey/results/reader.h"
#include "hersey/run/film_fields.h"
#include "source_dir.h"
#include "table/quantity.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace quantities_test {

std::string text_of_file(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST_CASE("CommittedReferenceOfResults_IsFresh") {
  // Made again by `hersey schema --results --markdown > docs/results-file.md` and
  // `hersey schema --results > docs/schema/results.json`.
  CHECK(text_of_file(std::string(hersey::source_dir()) + "/docs/results-file.md") == results_schema_markdown());
  CHECK(text_of_file(std::string(hersey::source_dir()) + "/docs/schema/results.json") == results_schema_json());
}

TEST_CASE("EveryQuantity_IsDescribedWithItsUnit") {
  for (const QuantityGroup& group : result_quantities()) {
    CAPTURE(group.path);
    CHECK(group.path.front() == '/');
    CHECK(group.path.back() == '/');
    CHECK_FALSE(group.heading.empty());
    for (const QuantityInfo& quantity : group.quantities) {
      CAPTURE(quantity.name);
      CHECK_FALSE(quantity.name.empty());
      CHECK_FALSE(quantity.text.empty());
      CHECK((quantity.kind == QuantityInfo::Kind::attribute || !quantity.unit.empty()));
      CHECK((quantity.kind != QuantityInfo::Kind::series || quantity.shape.starts_with('[')));
    }
  }
}

TEST_CASE("SummaryEntries_AreUniqueForEachThing") {
  for (const QuantityGroup& group : result_quantities()) {
    std::set<std::string> names;
    for (const QuantityInfo& quantity : group.quantities)
      for (const SummaryEntry& summary_entry : quantity.summary_entries) {
        CAPTURE(summary_entry.name);
        CHECK_FALSE(summary_entry.name.empty());
        CHECK(names.insert(summary_entry.name).second);
        if (!summary_entry.has_location || !quantity.dimensions.empty()) continue;
        const auto is_there = [&](const std::string& name) {
          return std::any_of(group.quantities.begin(), group.quantities.end(),
                             [&](const QuantityInfo& other) { return other.name == name; });
        };
        CHECK(is_there(quantity.name + "_phi"));
        CHECK(is_there(quantity.name + "_z"));
      }
  }
}

TEST_CASE("EveryFieldOfAFilm_IsAQuantityOfItsBearing") {
  const std::vector<QuantityInfo> of_bearing = quantities_of("/bearings/<b>/");
  for (const FilmField& field : film_fields()) {
    CAPTURE(field.name);
    const auto found = std::find_if(of_bearing.begin(), of_bearing.end(), [&](const QuantityInfo& quantity) {
      return quantity.name == "fields/" + field.name;
    });
    REQUIRE(found != of_bearing.end());
    CHECK(found->unit == field.unit);
    CHECK(found->shape == "[m, n_phi, n_z]");
  }
}

struct Machine {
  int wheels = 0;
};
struct WheelState {
  double speed = 0;
  std::vector<double> revolutions;
};

TEST_CASE("TableOfQuantities_WritesAFileThatSaysWhatItSays") {
  static const QuantityTable<WheelState, Machine> table{
      {"speed", "m/s", "of the machine", &WheelState::speed},
      {"turn_<wheel>",
       "rad",
       "of wheel <wheel>",
       [](const WheelState& state, std::size_t k) { return state.revolutions[k]; },
       {.each =
            [](const Machine& machine) {
              std::vector<std::string> names;
              for (int k = 0; k < machine.wheels; ++k) names.push_back(std::string(1, static_cast<char>('a' + k)));
              return names;
            }}},
      {"turns",
       "rad",
       "of all wheels",
       &WheelState::revolutions,
       {.only = [](const Machine& machine) { return machine.wheels > 2; },
        .extent = {"wheels", [](const Machine& machine, std::size_t) { return std::vector{machine.wheels}; }}}},
      {"place", "m", "of the machine", [](const WheelState& state) { return Vector3(state.speed, 0, 0); }},
  };
  const TemporaryDirectory directory;
  const auto write = [&](const char* name, int wheels) {
    results::Writer writer(directory / name);
    const QuantityRows<WheelState, Machine> rows(table, "/machines/m/", Machine{wheels}, writer);
    rows.append({3, {0.5, 1.5, 2.5}});
    rows.append({4, {0.25, 1.25, 2.25}});
    writer.finish(results::Status::completed);
  };
  write("three.h5", 3);
  write("two.h5", 2);
  const results::Reader three(directory / "three.h5"), two(directory / "two.h5");
  CHECK(three.read("/machines/m/speed").values == std::vector<double>{3, 4});
  CHECK(three.read("/machines/m/turn_b").values == std::vector<double>{1.5, 1.25});
  CHECK(three.info("/machines/m/turn_b").description == "of wheel b");
  CHECK(three.read("/machines/m/turns").values == std::vector<double>{0.5, 1.5, 2.5, 0.25, 1.25, 2.25});
  CHECK(three.info("/machines/m/place").shape == std::vector<std::size_t>{2, 3});
  CHECK(three.info("/machines/m/place").unit == "m");
  CHECK_FALSE(two.has("/machines/m/turns"));
  CHECK_FALSE(two.has("/machines/m/turn_c"));
}

TEST_CASE("NamesBelowAGroup_GoUpWhereAsked") {
  CHECK(below("/bearings/b/cycles/fields/", "../../fields/phi") == "/bearings/b/fields/phi");
  CHECK(below("/bearings/b/", "fields/phi") == "/bearings/b/fields/phi");
  CHECK(filled_in("flow_feature_<name>", "inlet") == "flow_feature_inlet");
  CHECK(filled_in("h_min", "") == "h_min");
}

}  // namespace quantities_test
}  // namespace hersey::run
