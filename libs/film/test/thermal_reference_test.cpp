#include "thermal_reference.h"

#include <doctest/doctest.h>

#include <string>

// Bearings with one temperature across the film against those of an independent program.
namespace hersey::film {
namespace thermal_reference_test {

using namespace thermal_reference;

/// Returns the temperature at the groove's beginning, extrapolated from the two nodes before it at mid-width.
double T_before(const Case& c, const HotFilm& hot, double phi) {
  const double step = 2 * pi / c.model.grid.n_phi;
  const auto T = [&](double at) { return at_mid_width(c.model.grid, hot.temperatures.middle, at) - zero_celsius; };
  return 2 * T(phi - step) - T(phi - 2 * step);
}

/// Figures at mid-width are compared with verification/data. The narrowest gap lies at pi.
void compare_midplane(const Case& c, const HotFilm& hot) {
  int points = 0;
  for (const CsvRow& row : table("bulk_midplane.csv")) {
    if (row.at("case") != c.name) continue;
    const double phi_deg = number(row, "phi_deg"), phi = pi + phi_deg * pi / 180;
    CAPTURE(phi_deg);
    const auto at = [&](const Eigen::VectorXd& field) { return at_mid_width(c.model.grid, field, phi); };
    CHECK(std::abs(at(hot.temperatures.middle) - zero_celsius - number(row, "T")) < c.bars.T);
    CHECK(std::abs(at(hot.fields.p) - number(row, "p")) < c.bars.p_max * c.expected.p_max);
    // The error is of first order: on 120 cells the program itself is off by 0.03 where the film cavitates and by less
    // beyond.
    CHECK(std::abs(at(hot.fields.theta) - number(row, "theta")) < 0.03);
    ++points;
  }
  CHECK(points >= 11);
}

TEST_CASE("CopesBearings_AreThoseOfAnIndependentProgram") {
  struct Trial {
    Case bearing;
    double T_end;
  };
  for (const Trial& trial :
       {Trial{cope("C1", 0.1, 0.6, {42828.3, 56.328, 9.73175e6, 57.4152, 64.1551, 1536.6, 3.69835e-5}), 93.623},
        Trial{cope("C2", 0.05, 0.3, {1890.35, 71.9236, 775725, 66.205, 71.0157, 590.432, 1.10677e-5}), 86.9021},
        Trial{cope("C3", 0.05, 0.8, {24915.1, 41.5878, 1.57226e7, 49.3055, 57.8424, 905.815, 2.95144e-5}), 111.7278}}) {
    const HotFilm hot = compare(trial.bearing);
    CHECK(std::abs(T_before(trial.bearing, hot, 0) - trial.T_end) < trial.bearing.bars.T);
    compare_midplane(trial.bearing, hot);
  }
}

// A groove of 20 degrees over the whole width, 210 degrees after the narrowest gap, that gives fresh oil.
TEST_CASE("CopesBearingWithARenewedGroove_IsThatOfAnIndependentProgram") {
  Case c = cope("C4", 0.1, 0.8, {118882, 44.158, 3.10085e7, 40, 53.9242, 2007.78, 3.29034e-5});
  c.model.supply = {};
  c.model.grid = {.n_phi = 180, .n_z = 25};  // power is of first order at the rim
  c.model.features.push_back(
      {.name = "groove", .phi = pi / 6, .z = 0, .arc = pi / 9, .length = 0.1, .pressure = 0, .depth = 5e-3});
  c.thermal.carry_over = 0;
  const HotFilm hot = compare(c);
  CHECK(std::abs(T_before(c, hot, pi / 9) - 113.1409) < c.bars.T);
  compare_midplane(c, hot);
}

// Where oil is not conserved the film is full everywhere: the line, which supplies fresh oil, retains all oil that the
// film carries to it, over the edges' half volumes as well.
TEST_CASE("CopesBearingThatLosesOil_IsThatOfAnIndependentProgram") {
  Case c = cope("C5", 0.1, 0.6, {63298.6, 58.9927, 1.40164e7, 40, 50.9598, 2383.88, 3.71359e-5});
  c.model.cavitation = Cavitation::reynolds;
  c.model.cavitated_shear = CavitatedShear::full;
  c.thermal.carry_over = 0;
  const HotFilm hot = compare(c);
  CHECK(std::abs(T_before(c, hot, 0) - 89.2648) < c.bars.T);
  compare_midplane(c, hot);
}

// The walls have 60 degC. The program approximates the temperature across the film by a parabola through its mean and
// both walls, which gives each of these 6 k (T - T_wall)/h; one layer gives it 2 k (T - T_wall)/h (thermal.53), so that
// a layer of oil of three times the conductivity is that parabola.
TEST_CASE("ParabolaAcrossTheFilm_IsALayerOfThreeTimesTheConductivity") {
  Case c = cope("P1", 0.1, 0.6, {55287.1, 52.5018, 1.31518e7, 46.9333, 59.2843, 2405.26, 3.76819e-5});
  c.model.grid = {.n_phi = 240, .n_z = 25};  // T_groove is of first order: 0.30 K on 120 nodes, 0.15 on these
  c.thermal.shell = WallAtTemperature{.T = 60 + zero_celsius};
  c.thermal.journal = WallAtTemperature{.T = 60 + zero_celsius};
  c.model.lubricant.conductivity *= 3;
  const HotFilm hot = compare(c);
  CHECK(std::abs(T_before(c, hot, 0) - 62.0688) < c.bars.T);
  compare_midplane(c, hot);
  // The error is of first order: the line's control volumes heat no wall. 0.83 % on 120 nodes, 0.43 % on 240, 0.30 % on
  // 360.
  CHECK(hot.heat.balance.to_shell == relative(577.602).epsilon(0.005));
  CHECK(hot.heat.balance.to_journal == relative(577.602).epsilon(0.005));  // likewise
  // Layers resolve more than a parabola: the cold oil that enters absorbs heat faster, more of it from the shell along
  // which the oil flows on, and it is thin beside the walls. The tolerance is the parabola's error.
  c.model.lubricant.conductivity /= 3;
  c.thermal.layers = 5;
  const HotFilm layered = solve_hot(c.model, c.thermal, surfaces(c.model, c.journal), c.journal.e);
  CHECK(layered.film.force_pressure.norm() == relative(hot.film.force_pressure.norm()).epsilon(0.02));
  CHECK(layered.heat.balance.power == relative(hot.heat.balance.power).epsilon(0.002));
  CHECK(std::abs(layered.heat.T_side - hot.heat.T_side) < 1);
}

TEST_CASE("CopesBearingWithAShortGroove_IsThatOfAnIndependentProgram") {
  Case c = grooved("G1", 1, {7324.21, 44.9598, 2.6029e6, 41.9176, 43.3932, 563.984, 9.6634e-5});
  c.thermal.journal = InsulatedWall{};
  c.model.grid = {.n_phi = 180, .n_z = 33};  // of first order at the groove's rim, as the power shows
  c.bars.T_groove = 0.4;
  compare(c);
}

}  // namespace thermal_reference_test
}  // namespace hersey::film
