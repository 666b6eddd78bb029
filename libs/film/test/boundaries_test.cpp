#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "film_cases.h"
#include "hersey/film/body_journal.h"
#include "hersey/film/cavitated_shear.h"
#include "hersey/film/gap_shape.h"
#include "hersey/film/heat_state.h"
#include "relative.h"

// Branches that films in the middle of their range do not take.
namespace hersey::film {
namespace boundaries_test {

using Violation = FilmDomain::Violation;

TEST_CASE("TextOfADomain_NamesTheFaultAndItsPosition") {
  FilmModel m;
  const int node = m.grid.index(15, 12);  // a quarter around, on the edge
  CHECK(text(m, {}).empty());
  CHECK(text(m, {Violation::not_finite, -1}) == "the film has no finite pressure");
  CHECK(text(m, {Violation::not_finite, node}) == "the film has no finite pressure at 90.0 deg, z = 7.8 mm");
  CHECK(text(m, {Violation::pressure, node}) == "the film's pressure rises without bound at 90.0 deg, z = 7.8 mm");
  m.surface = Plane{};
  CHECK(text(m, {Violation::closed, node}) == "the film closes at 35.3 mm, z = 7.8 mm");  // R pi/2
}

TEST_CASE("UsualSolver_IsChosenBySize") {
  CHECK(usual_solver({.n_phi = 150, .n_z = 100}) == FilmSolver::newton);
  CHECK(usual_solver({.n_phi = 151, .n_z = 100}) == FilmSolver::multigrid);
}

TEST_CASE("LowestFillNode_HasANegativeFillFraction") {
  FilmModel m;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const double none = -fill_scale(m);
  u.setConstant(none);
  CHECK(lowest_fill_node(m, u) == -1);  // empty is no less than empty
  u[m.grid.index(3, 5)] = 1.1 * none, u[m.grid.index(20, 7)] = 1.2 * none, u[m.grid.index(30, 2)] = 1.05 * none;
  CHECK(lowest_fill_node(m, u) == m.grid.index(20, 7));
  u[m.grid.index(40, 0)] = 2 * none;  // more than any other
  CHECK(lowest_fill_node(m, u) == m.grid.index(40, 0));
  m.edge_left.ambient_fill = 0.3;  // there u < 0 is oil that comes in
  CHECK(lowest_fill_node(m, u) == m.grid.index(20, 7));
  m.cavitation = Cavitation::reynolds;  // a model without a fill fraction
  CHECK(lowest_fill_node(m, u) == -1);
}

TEST_CASE("Features_OverlapWhereAPointIsInBoth") {
  const SurfaceFeature groove{.phi = 1, .z = 0, .arc = 0.4, .length = 10e-3};
  SurfaceFeature hole{.shape = Ellipse{}, .phi = 1.25, .z = 0, .arc = 0.2, .length = 2e-3};
  CHECK(overlap(groove, hole));  // 1.15 to 1.35 and 0.8 to 1.2
  CHECK(overlap(hole, groove));
  hole.phi += 2 * pi;  // the same position
  CHECK(overlap(groove, hole));
  hole.phi = 1.31;
  CHECK(!overlap(groove, hole));
  CHECK(!overlap(hole, groove));
  // The strip is so thin that points spread over either of them miss it.
  const SurfaceFeature beside{.phi = 1, .z = 5.99e-3, .arc = 0.4, .length = 2e-3};
  CHECK(overlap(groove, beside));
  CHECK(overlap(beside, groove));
  CHECK(!overlap(groove, {.phi = 1, .z = 6.01e-3, .arc = 0.4, .length = 2e-3}));
  // The box around an ellipse reaches into the groove's corner, the ellipse does not: (0.9 of a half extent)^2 twice.
  hole.phi = 1.29, hole.z = 5.9e-3;
  CHECK(!overlap(groove, hole));
  hole.shape = Rectangle{};
  CHECK(overlap(groove, hole));
  hole.z = 6.1e-3;
  CHECK(!overlap(groove, hole));
}

TEST_CASE("Laws_AtTheEndOfTheirRange") {
  // An oil of zero compressibility takes the work of an incompressible one.
  const DowsonHigginson stiff{.rise = 0, .saturation = 0};
  CHECK(stiff.work(1e8) == 1e8);
  CHECK(stiff.ratio(1e8).value == 1);
  const Lubricant oil{.viscosity_law = Barus{2e-8}, .density_law = DowsonHigginson{}};
  CHECK(density_ratio(oil, -1e5).value == 1);  // tension neither thins the oil
  CHECK(density_ratio(oil, -1e5).slope == 0);
  CHECK(log_viscosity_ratio(oil, -1e5).value == 0);
  CHECK(oil_work(oil, -1e5) == -1e5);
  // Vogel's viscosity stays what it is a tenth of a kelvin above its pole.
  const VogelViscosity vogel;
  CHECK(vogel.log_viscosity(vogel.c + 0.05).value == vogel.log_viscosity(vogel.c - 20).value);
  CHECK(vogel.log_viscosity(vogel.c + 0.05).slope == 0);
  CHECK(vogel.log_viscosity(vogel.c + 0.2).slope < 0);
}

TEST_CASE("OilAtATemperature_HasTheViscosityAndDensityOfItsLaws") {
  const double T = 353.15;
  const WaltherViscosity walther = WaltherViscosity::through(100e-6, 11e-6, 880);
  const Lubricant mineral = at_temperature({.temperature_law = walther}, T);
  CHECK(mineral.mu0 == walther.viscosity(T));
  CHECK(mineral.density == walther.density(T));
  const Lubricant plain{.mu0 = 0.02, .density = 850},
      same = at_temperature(plain, T);  // which does not depend on temperature
  CHECK(same.mu0 == plain.mu0);
  CHECK(same.density == plain.density);
  const Lubricant thinned = at_temperature({.temperature_law = ExponentialViscosity{.mu_ref = 0.03, .T_ref = T}}, T);
  CHECK(thinned.mu0 == relative(0.03).epsilon(1e-15));  // round-off
}

TEST_CASE("CavitatedShear_IsReportedWithTheChoiceMade") {
  const std::string full = choice_in_words(CavitatedShear::full),
                    fraction = choice_in_words(CavitatedShear::film_share);
  CHECK(full.find("over the whole gap (`cavitated_shear: full`)") < full.find("`film_share`"));
  CHECK(fraction.find("the oil's share of the gap (`cavitated_shear: film_share`)") < fraction.find("(`full`)"));
}

TEST_CASE("JournalThatKeepsItsShape_HasNoneOnAnyGrid") {
  const JournalConduction plain{.T0 = 320, .rise = 0.1}, observed = on_grid(plain, {.n_z = 5}, {.n_z = 9});
  CHECK(!observed.deforms());
  CHECK(observed.rise == plain.rise);
  CHECK(around({.n_phi = 6, .n_z = 5}, observed.shape0).size() == 0);
  const Eigen::VectorXd shape = Eigen::VectorXd::LinSpaced(5, 0, 4);
  CHECK(around({.n_phi = 6, .n_z = 5}, shape).segment(10, 5) == shape);
}

TEST_CASE("Grids_ChangeOnlyInTheDirectionRefined") {
  const Grid pads = patch_grid({{0.5, 1.5, 11}, {2, 2.6, 7}}, 5), finer = resampled(pads, pads.n_phi, 9);
  CHECK(finer.n_z == 9);
  CHECK(finer.patches.size() == 2);
  for (int i = 0; i < pads.n_phi; ++i) CHECK(finer.phi(i) == pads.phi(i));
  const Grid along = graded_grid(24, 9, {}, {{.position = 0.5, .reach = 0.1, .factor = 4}});
  CHECK(along.angles.empty());  // equal angles
  CHECK(along.z_over_L(8) - along.z_over_L(7) < along.z_over_L(1) - along.z_over_L(0));
}

TEST_CASE("SurfacesThatAreNoNumbers_AreReportedWithTheirPosition") {
  const FilmModel m;
  const SurfaceMotion sound = surfaces(m, turning(m, 0.5, 100));
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  const int node = m.grid.index(7, 3);
  for (Eigen::VectorXd SurfaceMotion::*member : {&SurfaceMotion::g, &SurfaceMotion::g_rate}) {
    SurfaceMotion cavitated = sound;
    (cavitated.*member)[node] = std::numeric_limits<double>::quiet_NaN();
    Reynolds reynolds(m);
    const FilmDomain domain = reynolds.linearise(cavitated, {}, u);
    CHECK(domain.violation == Violation::not_finite);
    CHECK(domain.node == node);
    CHECK(reynolds.linearise(sound, {}, u).is_inside());
  }
}

// The pivot order of an earlier factor decides the round-off of later ones.
TEST_CASE("RestoredReynolds_ContinuesToTheSameBits") {
  const FilmModel m;
  const SurfaceMotion first = surfaces(m, turning(m, 0.5, 100)), later = surfaces(m, turning(m, 0.7, 80));
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(m.grid.size());
  Reynolds saved(m), restored(m);
  Eigen::VectorXd du, other;
  REQUIRE((saved.linearise(first, {}, u).is_inside() && restored.linearise(later, {}, u).is_inside()));
  saved.newton_increment(du), restored.newton_increment(other);
  Archive out;
  saved.persist(out);
  Archive in(out.content());
  restored.persist(in);
  CHECK(saved.linear_solver().has_factor);
  CHECK(!restored.linear_solver().has_factor);  // of what it saw before
  REQUIRE((saved.linearise(later, {}, u).is_inside() && restored.linearise(later, {}, u).is_inside()));
  saved.newton_increment(du), restored.newton_increment(other);
  CHECK(du == other);
}

TEST_CASE("BalanceOfNoHeat_HasNoError") {
  CHECK(HeatBalance{}.error() == 0);
  CHECK(HeatBalance{.source = 2, .to_oil = 1}.error() == 0.5);  // half of what is made has gone nowhere
  CHECK(HeatBalance{.power = 1, .source = 1, .to_oil = 2}.error() == 0);
}

// A pad that parts from its runner without any oil at its edges is one cavity from its first line to its last.
TEST_CASE("CavityOfAWholePatch_EndsWhereThatEnds") {
  constexpr double round_off = 1e-12;  // of angles that are sums of steps
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = patch_grid({{0.5, 1.5, 11}, {2, 2.6, 7}}, 5)};
  m.ends.resize(2);
  const SurfaceMotion motion = surfaces(m, {.omega_journal = 100});
  const double empty = -0.5 * fill_scale(m);
  const auto cavity = [&](const Eigen::VectorXd& u) {
    const FilmObservables observed = observe_film(m, motion, {}, {0, 0}, u);
    return std::array<double, 2>{observed.rupture_angle, observed.reformation_angle};
  };
  Eigen::VectorXd u = Eigen::VectorXd::Constant(m.grid.size(), empty);
  const auto whole = cavity(u);  // that of the wider patch
  CHECK(whole[0] == relative(0.5).epsilon(round_off));
  CHECK(whole[1] == relative(1.5).epsilon(round_off));
  u.setConstant(1e5);
  CHECK(std::isnan(cavity(u)[0]));
  for (int i = 7; i < 11; ++i) u.segment(m.grid.index(i, 0), 5).setConstant(empty);  // from line 7 to the end
  const auto last = cavity(u);
  CHECK(last[0] > m.grid.phi(6));
  CHECK(last[0] <= m.grid.phi(7) + round_off);
  CHECK(last[1] == relative(1.5).epsilon(round_off));
}

// The slope is that of the bore's shapes alone; a shape that varies only along the axis has none.
TEST_CASE("SlopeOfTheShell_IsThatOfItsOwnShapes") {
  FilmModel m;
  CHECK(GapShape(m).shell_slope().isZero(0));
  m.profiles = {{.shape = Barrel{.drop = 1e-6}, .surface = Surface::shell}};
  CHECK(GapShape(m).shell_slope().isZero(0));
  const Profile lobes{.shape = Ovality{.amplitude = 3e-6, .angle = 0.3}, .surface = Surface::shell};
  m.profiles.push_back(lobes);
  const Eigen::VectorXd slope = GapShape(m).shell_slope();
  for (const int i : {3, 17, 44}) {
    const double d = 1e-6, phi = m.grid.phi(i);
    const double difference = (lobes.opening(phi + d, 0, m.L).value - lobes.opening(phi - d, 0, m.L).value) / (2 * d);
    // Differences leave d^2 of the third derivative and round-off over d, both below 1e-9 of the lobes.
    CHECK(slope[m.grid.index(i, 4)] == doctest::Approx(difference).scale(0).epsilon(1e-8));
  }
  m.profiles = {{.shape = Ovality{.amplitude = 3e-6, .angle = 0.3}, .surface = Surface::journal}};
  CHECK(GapShape(m).shell_slope().isZero(0));
}

}  // namespace boundaries_test
}  // namespace hersey::film
