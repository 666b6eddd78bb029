#include "hersey/bearing/skirt.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// A skirt in its liner against closed forms and an independent program (theory manual, chapter skirt), and relations
// between its figures.
namespace hersey::bearing {
namespace skirt_test {

constexpr double pi = std::numbers::pi;
constexpr double R = 0.0425, L = 0.045, c = 40e-6, mu = 0.008, arc = 80 * pi / 180;

struct Skirt {
  film::FilmModel model;
  std::shared_ptr<const PistonSkirt> kind;
  OperatingPoint point;

  [[nodiscard]] SteadyState solve() const {
    SteadyState state;
    const SteadySummary summary = solve_steady(scaled_for(model, point), point, {.kind = kind}, state);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    return state;
  }
};

/// A flooded skirt with its axis off by `top` and `bottom`, at the speed V towards the crown.
Skirt skirt(std::vector<SkirtShape> shapes, double V, double top, double bottom, int lines, int rows) {
  Skirt s{
      .model = {.surface = film::Skirt{}, .R = R, .L = L, .c = c, .grid = skirt_grid(arc, arc, lines, rows)},
      .kind = std::make_shared<PistonSkirt>(std::move(shapes)),
      .point = {
          .journal_speed = V / R, .e = Coordinates::Constant(1, 0.5 * (top + bottom)), .e_rate = Coordinates::Zero(1)}};
  s.point.tilt.x() = (top - bottom) / L;
  s.model.lubricant.mu0 = mu;
  s.model.edge_left.ambient_fill = s.model.edge_right.ambient_fill = 1;
  s.model.ends.assign(2, {.first = {.ambient_fill = 1}, .last = {.ambient_fill = 1}});
  return s;
}

const SkirtBarrel barrel{.top = 30e-6, .bottom = 15e-6, .apex = -2.5e-3};

double load(const SteadyState& state) { return state.load[0]; }
double friction(const SteadyState& state) { return skirt_friction(state.film.wrench_on_shell, state.tilt); }
std::array<SkirtSide, 2> sides(const Skirt& s, const SteadyState& state) {
  return skirt_side_forces(s.model, state.film.normal_forces);
}

double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

// A skirt in the middle that only rocks squeezes a film of constant thickness at the rate t' z: without a cavity, which
// the pressure outside prevents, its sides resist with the moment mu t' L^5 b/(60 c^3) each.
TEST_CASE("SkirtThatOnlyRocks_IsASqueezedFilm") {
  constexpr double rate = 0.5, narrow = 0.005, outside = 1e6;  // peaks reach half of the pressure outside
  const double exact = 2 * mu * rate * std::pow(L, 5) * R * narrow / (60 * std::pow(c, 3));
  std::array<double, 2> errors{};
  for (const int k : {0, 1}) {
    const int rows = k == 0 ? 21 : 41;
    Skirt s = skirt({}, 0, 0, 0, 4, rows);
    s.model.grid = skirt_grid(narrow, narrow, 4, rows);
    s.model.edge_left.pressure = s.model.edge_right.pressure = outside;
    for (film::PatchEnds& ends : s.model.ends) ends.first.kind = ends.last.kind = film::EdgeKind::closed;
    s.point.tilt_rate.x() = rate;
    const SteadyState state = s.solve();
    errors[static_cast<std::size_t>(k)] = std::abs(state.film.wrench_on_shell[1]) / exact - 1;
    CHECK(std::abs(load(state)) < 1e-6 * exact / L);  // both sides alike; solved to 1e-8
  }
  // The pressure is a cubic, which central differences solve exactly; its moment, a quartic, is summed by parabolas.
  CHECK(std::abs(errors[0]) < 5e-4);  // (1/20)^4 times some 80
  CHECK(std::abs(errors[1]) < 3e-5);  // a sixteenth
}

// Its sides closed, a narrow skirt is Reynolds' taper (slider.8), whose inclination is the tilt: the film of the thrust
// side narrows towards the edge that trails, that of the other side widens.
TEST_CASE("NarrowSkirt_IsAPlaneSlider") {
  constexpr double K = 1.2, h2 = 20e-6, V = 3, narrow = 0.005;
  // Across the direction of the force the gap of an arc differs by its cosine, and so does the force.
  const double area = R * narrow * L, unit = 6 * mu * V * L * area / (h2 * h2), ln = std::log1p(K);
  const double exact_load = unit * (ln - 2 * K / (K + 2)) / (K * K);
  std::array<std::array<double, 2>, 2> errors{};
  for (const int k : {0, 1}) {
    // Rising, it is led by its top, where the gap is wide: h2 (1 + K) there and h2 at the bottom.
    Skirt s = skirt({}, V, c - h2 * (1 + K), c - h2, 4, k == 0 ? 41 : 81);
    s.model.grid = skirt_grid(narrow, narrow, 4, k == 0 ? 41 : 81);
    for (film::PatchEnds& ends : s.model.ends) ends.first.kind = ends.last.kind = film::EdgeKind::closed;
    const SteadyState state = s.solve();
    const auto [thrust, antithrust] = sides(s, state);
    errors[static_cast<std::size_t>(k)] = {thrust.force / exact_load - 1, thrust.centre()};
    CHECK(load(state) == relative(thrust.force - antithrust.force).epsilon(1e-9));  // the same sums
  }
  CHECK(std::abs(errors[1][0]) < 5e-4);  // (1/80)^2 times some two, and the cosine's narrow^2/24 = 1e-6
  CHECK(order(errors[0][0], errors[1][0]) > 1.8);
  // From the edge that leads, the top: the moment of the same pressure.
  const double behind = 1 - (K * (6 + K) - 2 * (3 + 2 * K) * ln) / (2 * K * ((2 + K) * ln - 2 * K));
  CHECK(errors[1][1] == relative((0.5 - behind) * L).epsilon(2e-3));  // a difference of numbers ten times as large
}

TEST_CASE("Shapes_LieBackAsTheyAreDescribed") {
  const auto at = [](double phi, double z) { return SkirtPosition{phi, z, L}; };
  CHECK(barrel.opening(at(0.3, 0.5 * L)) == relative(30e-6).epsilon(1e-12));   // round-off
  CHECK(barrel.opening(at(0.3, -0.5 * L)) == relative(15e-6).epsilon(1e-12));  // round-off
  CHECK(barrel.opening(at(0.3, -2.5e-3)) == 0);
  // Halfway from the apex to the top: a quarter.
  CHECK(barrel.opening(at(0, 0.5 * (0.5 * L - 2.5e-3))) == relative(7.5e-6).epsilon(1e-12));  // round-off
  const SkirtOvality oval{.top = 60e-6, .bottom = 20e-6};
  CHECK(oval.opening(at(0, 0)) == 0);
  CHECK(oval.opening(at(pi / 2, 0)) == relative(40e-6).epsilon(1e-12));                             // round-off
  CHECK(oval.opening(at(pi / 2, 0.5 * L)) == relative(60e-6).epsilon(1e-12));                       // round-off
  CHECK(oval.opening(at(pi / 6, -0.5 * L)) == relative(5e-6).epsilon(1e-12));                       // round-off
  CHECK(oval.opening(at(pi - 0.4, 3e-3)) == relative(oval.opening(at(0.4, 3e-3))).epsilon(1e-12));  // round-off
  const Skirt both = skirt({barrel, oval}, 1, 0, 0, 9, 9);
  const Skirt one = skirt({barrel}, 1, 0, 0, 9, 9), other = skirt({oval}, 1, 0, 0, 9, 9);
  CHECK((both.kind->opening(both.model) - one.kind->opening(one.model) - other.kind->opening(other.model)).norm() <
        1e-18);  // round-off of micrometres
}

// Independent numpy program, three grids, extrapolated: F to 2e-4. Sliding down with a parallel barrel, up with a tilt,
// and squeeze without sliding; films sheared over the whole gap.
TEST_CASE("Skirt_AgreesWithAnIndependentProgram") {
  struct Side {
    double force, below_top, p_max;
  };
  struct Case {
    double V, top, bottom, rate, shear;
    Side thrust, antithrust;
  };
  // Places count from the top downwards, friction downwards.
  const std::array<Case, 3> cases{{
      {8,
       20e-6,
       20e-6,
       0,
       -6.0130223 - 2.6006675,
       {544.14938, 0.0331012767, 917654.39},
       {42.8345335, 0.0334750185, 60698.19}},
      {-6,
       10e-6,
       28e-6,
       0,
       4.2107710 + 1.9638686,
       {969.48091, 0.0191555418, 1254014.5},
       {46.3931246, 0.0124519203, 62214.91}},
      {0, 15e-6, 15e-6, 0.02, -0.7635682, {9699.9006, 0.0241504037, 10425960.7}, {0, 0, 0}},
  }};
  for (const Case& given : cases) {
    CAPTURE(given.V);
    Skirt s = skirt({barrel}, -given.V, given.top, given.bottom, 31, 61);
    s.model.cavitated_shear = film::CavitatedShear::full;
    s.point.e_rate[0] = given.rate;
    const SteadyState state = s.solve();
    const auto found = sides(s, state);
    for (const std::size_t k : {0U, 1U}) {
      CAPTURE(k);
      const Side& side = k == 0 ? given.thrust : given.antithrust;
      if (side.force == 0) {
        CHECK(found.at(k).force == 0);
        continue;
      }
      CHECK(found.at(k).force == relative(side.force).epsilon(2e-3));  // of 61 rows, (1/60)^2 times some seven
      CHECK(std::abs(0.5 * L - found.at(k).centre() - side.below_top) < 1e-3 * L);  // likewise
      CHECK(state.film.patches.at(k).p_max == relative(side.p_max).epsilon(5e-3));  // the node next to the peak
    }
    CHECK(state.film.force_shear.z() == relative(-given.shear).epsilon(2e-3));  // likewise
  }
}

// In the middle of its liner both sides are the same; down is up turned over; the other side is the mirrored one.
TEST_CASE("MirroredSkirts_AreMirrorImages") {
  const SkirtBarrel turned{.top = barrel.bottom, .bottom = barrel.top, .apex = -barrel.apex};
  constexpr double solved = 1e-8;  // residuals of 1e-10, and sums that cancel in part
  const Skirt s = skirt({barrel}, 5, 10e-6, 18e-6, 13, 21);
  const SteadyState state = s.solve();
  const Skirt down = skirt({turned}, -5, 18e-6, 10e-6, 13, 21);
  const SteadyState upside_down = down.solve();
  CHECK(load(upside_down) == relative(load(state)).epsilon(solved));
  CHECK(friction(upside_down) == relative(-friction(state)).epsilon(solved));
  CHECK(sides(down, upside_down)[0].centre() == relative(-sides(s, state)[0].centre()).epsilon(solved));
  const Skirt other = skirt({barrel}, 5, -10e-6, -18e-6, 13, 21);
  const SteadyState mirrored = other.solve();
  CHECK(load(mirrored) == relative(-load(state)).epsilon(solved));
  CHECK(friction(mirrored) == relative(friction(state)).epsilon(solved));
  CHECK(mirrored.film.wrench_on_shell[1] == relative(-state.film.wrench_on_shell[1]).epsilon(solved));
  CHECK(sides(other, mirrored)[1].force == relative(sides(s, state)[0].force).epsilon(solved));
  const Skirt middle = skirt({barrel}, 5, 0, 0, 13, 21);
  CHECK(std::abs(load(middle.solve())) < solved * load(state));
}

// Lengths doubled and gaps kept: pressures with V L/h^2, forces with pressure and area.
TEST_CASE("LargerSkirt_IsTheSameInItsOwnMeasures") {
  const Skirt s = skirt({barrel}, 5, 20e-6, 20e-6, 13, 21);
  Skirt large = s;
  large.model.R *= 2, large.model.L *= 2;
  large.point.journal_speed /= 2;  // the same speed along the liner
  large.kind =
      std::make_shared<PistonSkirt>(std::vector<SkirtShape>{SkirtBarrel{barrel.top, barrel.bottom, 2 * barrel.apex}});
  const SteadyState a = s.solve(), b = large.solve();
  // Shear around the skirt pushes it across, too, by c/R of the pressure's part.
  CHECK(sides(large, b)[0].force == relative(8 * sides(s, a)[0].force).epsilon(1e-9));  // the film's tolerance
  CHECK(sides(large, b)[1].force == relative(8 * sides(s, a)[1].force).epsilon(1e-9));  // likewise
  CHECK(load(b) == relative(8 * load(a)).epsilon(c / R));
}

// Stiffness and damping by offset and slope are differences of forces.
TEST_CASE("SkirtCoefficients_MatchDifferences") {
  Skirt s = skirt({barrel, SkirtOvality{30e-6, 20e-6}}, 5, 14e-6, 20e-6, 9, 15);
  // Pressed from outside, so that no front leaps from node to node.
  s.model.edge_left.pressure = s.model.edge_right.pressure = 5e6;
  for (film::PatchEnds& ends : s.model.ends) ends.first.pressure = ends.last.pressure = 5e6;
  const SteadyState state = s.solve();
  CHECK(state.film.cavitated_share == 0);
  const auto forces = [](const SteadyState& at) -> Eigen::Vector2d {
    return {-at.film.wrench_on_shell[3], -at.film.wrench_on_shell[1]};
  };
  const auto moved = [&](int k, double by, bool is_rate) {
    Skirt other = s;
    double& value = k == 0 ? (is_rate ? other.point.e_rate[0] : other.point.e[0])
                           : (is_rate ? other.point.tilt_rate : other.point.tilt)[0];
    value += by;
    return forces(other.solve());
  };
  for (int k = 0; k < 2; ++k) {
    CAPTURE(k);
    const double h = k == 0 ? 1e-3 * c : 1e-3 * c / L, rate = h / 1e-3;  // a thousandth of the gap, in a millisecond
    const Eigen::Vector2d stiffness = (moved(k, h, false) - moved(k, -h, false)) / (2 * h);
    const Eigen::Vector2d damping = (moved(k, rate, true) - moved(k, -rate, true)) / (2 * rate);
    constexpr double of_difference = 1e-5;  // the square of the step, times the curvature of a power of the gap
    CHECK((state.coefficients.stiffness.block<2, 1>(0, k) - stiffness).norm() < of_difference * stiffness.norm());
    CHECK((state.coefficients.damping.block<2, 1>(0, k) - damping).norm() < of_difference * damping.norm());
  }
}

// The offset of a side force carries that force, on either side.
TEST_CASE("OffsetOfASideForce_CarriesThatForce") {
  for (const double wanted : {40.0, 1500.0, -600.0, 2e4}) {
    CAPTURE(wanted);
    Skirt s = skirt({barrel}, -6, 0, 0, 13, 21);
    s.point.load = Coordinates::Constant(1, wanted);
    const SteadyState found = s.solve();
    CHECK(load(found) == relative(wanted).epsilon(1e-9));  // the search's tolerance of 1e-10
    CHECK(found.e[0] * wanted > 0);
  }
}

// What friction and side force put in is dissipated, or leaves with the oil: of second order.
TEST_CASE("Skirt_PutsIntoTheFilmWhatItLoses") {
  std::array<double, 2> errors{};
  for (const int k : {0, 1}) {
    Skirt s = skirt({barrel, SkirtOvality{30e-6, 30e-6}}, 6, 10e-6, 16e-6, k == 0 ? 17 : 33, k == 0 ? 31 : 61);
    s.point.e_rate[0] = 5e-3;
    const SteadyState state = s.solve();
    const double put_in = -friction(state) * 6 + load(state) * s.point.e_rate[0];
    errors[static_cast<std::size_t>(k)] = put_in / state.film.power_taken() - 1;
  }
  CHECK(std::abs(errors[1]) < 2e-3);  // (1/60)^2 times some seven
  CHECK(order(errors[0], errors[1]) > 1.5);
}

}  // namespace skirt_test
}  // namespace hersey::bearing
