#include <doctest/doctest.h>

#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "hersey/bearing/skirt.h"
#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// A skirt that meets layers of oil on its liner: what they flood, what they starve, and relations between such skirts.
namespace hersey::bearing {
namespace skirt_oil_test {

constexpr double R = 0.0425, L = 0.045, c = 40e-6, arc = 80 * std::numbers::pi / 180;

/// A barrel-shaped skirt with its axis off towards the thrust side, and what it meets.
struct Skirt {
  double V = 5;                                 ///< towards the crown [m/s]
  double scale = 1;                             ///< of all gaps
  std::optional<double> top = {}, bottom = {};  ///< layers [m]; unset: flooded
  double sides = 0;                             ///< fill there
  bool is_turned = false;                       ///< upside down

  [[nodiscard]] SteadyState solve() const {
    const double sense = is_turned ? -1 : 1;
    film::FilmModel model{
        .surface = film::Skirt{}, .R = R, .L = L, .c = scale * c, .grid = skirt_grid(arc, arc, 13, 41)};
    model.lubricant.mu0 = 0.008;
    model.edge_left.ambient_fill = model.edge_right.ambient_fill = 1;
    (is_turned ? model.edge_left : model.edge_right).layer = top;
    (is_turned ? model.edge_right : model.edge_left).layer = bottom;
    model.ends.assign(2, {.first = {.ambient_fill = sides}, .last = {.ambient_fill = sides}});
    SkirtBarrel barrel{.top = scale * 30e-6, .bottom = scale * 15e-6, .apex = sense * -2.5e-3};
    if (is_turned) std::swap(barrel.top, barrel.bottom);
    OperatingPoint point{
        .journal_speed = sense * V / R, .e = Coordinates::Constant(1, scale * 20e-6), .e_rate = Coordinates::Zero(1)};
    point.tilt.x() = sense * scale * 4e-6 / L;
    SteadyState state;
    const auto kind = std::make_shared<PistonSkirt>(std::vector<SkirtShape>{barrel});
    const SteadySummary summary = solve_steady(scaled_for(model, point), point, {.kind = kind, .rtol = 1e-11}, state);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    CHECK(state.film.mass_balance_error < 1e-9);  // the solver's tolerance, summed over the nodes
    return state;
  }
};

constexpr double solved = 1e-8;  // residuals of 1e-11, amplified, and sums that cancel in part

double load(const SteadyState& state) { return state.load[0]; }
double friction(const SteadyState& state) { return skirt_friction(state.film.wrench_on_shell, state.tilt); }

TEST_CASE("AmpleLayers_AreAFloodedSkirt") {
  for (const double V : {5.0, -5.0}) {
    CAPTURE(V);
    const SteadyState flooded = Skirt{.V = V, .sides = 1}.solve();
    const SteadyState ample = Skirt{.V = V, .top = 1e-3, .bottom = 1e-3, .sides = 1}.solve();
    CHECK(load(ample) == relative(load(flooded)).epsilon(1e-9));          // the solver's tolerance
    CHECK(friction(ample) == relative(friction(flooded)).epsilon(1e-9));  // likewise
    CHECK(ample.film.starved_share == 0);
    // A gap takes some 20 um of it; corners, a twelfth, count with flooded sides.
    CHECK(ample.film.flow_scraped > (1 - 1.0 / 12) * (1e-3 - 40e-6) * 5 * 2 * arc * R);
  }
}

TEST_CASE("SkirtWithoutOil_CarriesNothing") {
  const SteadyState dry = Skirt{.top = 0}.solve();
  CHECK(dry.film.p_max == 0);
  CHECK(std::abs(dry.film.flow_out()) < 1e-16 * 5 * c * arc * R);  // round-off of what the liner would carry
  CHECK(dry.film.starved_share > 1 - 1.0 / 40);  // the half volumes where the liner leaves count as full
}

// Rising, the skirt meets the layer before its top alone.
TEST_CASE("SkirtMeetsTheLayerBeforeTheEdgeThatLeads") {
  const SteadyState state = Skirt{.top = 15e-6, .bottom = 30e-6}.solve();
  CHECK(load(Skirt{.top = 15e-6, .bottom = 3e-6}.solve()) == relative(load(state)).epsilon(solved));
  CHECK(load(Skirt{.top = 14e-6, .bottom = 30e-6}.solve()) < (1 - 1e-3) * load(state));  // a fifteenth less oil
}

// Of both sides the one that is nearer to the liner, which bears the load, is the last to starve.
TEST_CASE("LessOil_BearsLessAndStarvesMore") {
  double p_before = Skirt{}.solve().film.p_max, starved_before = 0;
  for (const double layer : {18e-6, 15e-6, 12.5e-6}) {
    CAPTURE(layer);
    const SteadyState state = Skirt{.top = layer}.solve();
    CHECK(state.film.p_max < p_before);
    CHECK(state.film.starved_share > starved_before);
    p_before = state.film.p_max, starved_before = state.film.starved_share;
    // Over the top comes what the layer brings less what is scraped off.
    const double brought = layer * 5 * 2 * arc * R;
    CHECK(state.film.flow_right + brought == doctest::Approx(state.film.flow_scraped).scale(1e-9 * brought));  // sums
  }
}

TEST_CASE("StarvedSkirtTurnedOver_IsTheSame") {
  const SteadyState up = Skirt{.top = 15e-6, .bottom = 20e-6}.solve();
  const SteadyState down = Skirt{.top = 15e-6, .bottom = 20e-6, .is_turned = true}.solve();
  CHECK(load(down) == relative(load(up)).epsilon(solved));
  CHECK(friction(down) == relative(-friction(up)).epsilon(solved));
  CHECK(down.film.flow_left == relative(up.film.flow_right).epsilon(solved));
  CHECK(down.film.starved_share == relative(up.film.starved_share).epsilon(solved));
}

// Gaps and layer doubled: pressures with 1/h^2, flows with h.
TEST_CASE("LayerCountsInThicknessesOfTheGap") {
  const SteadyState one = Skirt{.top = 15e-6}.solve(), two = Skirt{.scale = 2, .top = 30e-6}.solve();
  CHECK(two.film.p_max_node == relative(one.film.p_max_node / 4).epsilon(solved));
  CHECK(two.film.flow_right == relative(2 * one.film.flow_right).epsilon(solved));
  CHECK(two.film.starved_share == relative(one.film.starved_share).epsilon(solved));
}

}  // namespace skirt_oil_test
}  // namespace hersey::bearing
