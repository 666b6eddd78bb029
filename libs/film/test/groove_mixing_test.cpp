#include "hersey/film/groove_mixing.h"

#include <doctest/doctest.h>

namespace hersey::film {
namespace groove_mixing_test {

constexpr double fresh = 313.15;

/// Heat that films draw, over that of fresh oil.
double drawn_heat(const std::vector<EndFlow>& flows, const std::vector<EndOil>& oil) {
  double heat = 0;
  for (std::size_t k = 0; k < flows.size(); ++k) heat += flows[k].drawn * oil[k].rise;
  return heat;
}

TEST_CASE("OilOfAGroove_KeepsItsHeat") {
  // Less is carried over than is drawn: all of it goes along.
  const std::vector<EndFlow> flows{{.drawn = 0, .leaving = 2e-6, .T = 333.15}, {.drawn = 3e-6, .leaving = 0, .T = 0}};
  for (const double carry_over : {0.0, 0.4, 1.0}) {
    const std::vector<EndOil> oil = mixed_in_groove(flows, carry_over, fresh);
    CHECK(drawn_heat(flows, oil) == doctest::Approx(carry_over * 2e-6 * 20));
    CHECK(oil[1].carried * flows[1].drawn == doctest::Approx(oil[0].drawn_again * flows[0].leaving));
  }
}

TEST_CASE("GrooveThatIsBroughtMoreThanItGives_HasTheFilmsTemperature") {
  const std::vector<EndFlow> flows{{.drawn = 0, .leaving = 4e-6, .T = 333.15}, {.drawn = 3e-6, .leaving = 0, .T = 0}};
  const std::vector<EndOil> oil = mixed_in_groove(flows, 1, fresh);
  CHECK(oil[1].rise == doctest::Approx(20));
  CHECK(oil[1].carried == 1);
  CHECK(oil[0].drawn_again == doctest::Approx(0.75));
}

TEST_CASE("OilFromBothSides_Mixes") {
  const std::vector<EndFlow> flows{{.drawn = 4e-6, .leaving = 1e-6, .T = 333.15},
                                   {.drawn = 0, .leaving = 1e-6, .T = 323.15}};
  const std::vector<EndOil> oil = mixed_in_groove(flows, 1, fresh);
  CHECK(oil[0].rise == doctest::Approx(30.0 / 4));
  CHECK(oil[1].rise == oil[0].rise);
}

TEST_CASE("GrooveWithoutOilOfFilms_IsFresh") {
  const std::vector<EndOil> oil = mixed_in_groove({{.drawn = 1e-6, .leaving = 0, .T = 0}, {}}, 1, fresh);
  CHECK(oil[0].rise == 0);
  CHECK(oil[0].carried == 0);
}

}  // namespace groove_mixing_test
}  // namespace hersey::film
