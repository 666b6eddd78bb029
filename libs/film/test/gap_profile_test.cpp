#include "hersey/film/gap_profile.h"

#include <doctest/doctest.h>

#include "film_cases.h"
#include "gap/grid_geometry.h"
#include "hersey/film/gap_shape.h"
#include "relative.h"

namespace hersey::film {
namespace gap_profile_test {

constexpr double kNothing = 1e-20;  // m: round-off of openings of some micrometres

TEST_CASE("Profiles_HaveTheirShapes") {
  const double L = 0.02;
  CHECK(Barrel{4e-6}.opening(1, 0, L).value == 0);
  CHECK(Barrel{4e-6}.opening(1, -0.01, L).value == doctest::Approx(4e-6));
  CHECK(Barrel{4e-6}.opening(1, 0.005, L).value == doctest::Approx(1e-6));
  CHECK(Taper{6e-6}.opening(1, 0.01, L).value - Taper{6e-6}.opening(1, -0.01, L).value == relative(6e-6));
  CHECK(Ovality{3e-6, 0.5}.opening(0.5 + pi, 0, L).value == doctest::Approx(3e-6));
  CHECK(Ovality{3e-6, 0.5}.opening(0.5 - pi / 2, 0, L).value == doctest::Approx(-3e-6));
  // A lemon bore has the clearance in the middle of its arcs and is widest, by its offset, where they meet.
  const Lobes lemon{2, 20e-6, pi / 2};
  CHECK(lemon.opening(-pi / 2, 0, L).value == doctest::Approx(0));
  CHECK(lemon.opening(pi, 0, L).value == doctest::Approx(20e-6));
  CHECK(Lobes{3, 20e-6, 0}.opening(2 * pi / 3, 0, L).value == doctest::Approx(0).scale(20e-6));
}

// A journal moved by the offset of a lemon's arc is concentric with that arc: half the bearing has an even gap.
TEST_CASE("LemonBore_IsMadeOfArcs") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {48, 5}};
  const double offset = 12e-6;
  SurfaceMotion motion = surfaces(m, {.e = {0, -offset}});
  m.profiles = {{Lobes{2, offset, pi / 2}}};
  motion.g += gap_opening(m);
  // Round-off.
  for (int i = 1; i < 24; ++i) CHECK(motion.g[m.grid.index(i, 2)] == relative(m.c + offset).epsilon(1e-12));
}

// Bore and journal of the same taper leave an even gap.
TEST_CASE("Profiles_AddUp") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {12, 5}};
  CHECK(gap_opening(m).isZero(0));
  m.profiles = {{Taper{5e-6}}, {Barrel{2e-6}}, {Taper{-5e-6}, Surface::journal}};
  const Eigen::VectorXd sum = gap_opening(m);
  m.profiles = {{Barrel{2e-6}}};
  CHECK((sum - gap_opening(m)).cwiseAbs().maxCoeff() < kNothing);
}

TEST_CASE("ProfileDerivatives_MatchFiniteDifference") {
  std::vector<double> phi, opening;
  for (int k = 0; k < 24; ++k) phi.push_back(2 * pi * k / 24), opening.push_back(3e-6 * std::sin(phi.back()));
  const TableFunction::Options closed{.interpolation = Interpolation::smooth, .period = 2 * pi};
  const auto low = std::make_shared<TableFunction>(phi, opening, closed);
  for (double& o : opening) o += 2e-6;
  const auto high = std::make_shared<TableFunction>(phi, opening, closed);
  const MeasuredShape measured{{-5e-3, 5e-3}, {low, high}};
  for (const ProfileShape& shape : {ProfileShape{Ovality{3e-6, 0.5}}, ProfileShape{Lobes{3, 20e-6, 0.1}},
                                    ProfileShape{Barrel{4e-6}}, ProfileShape{measured}}) {
    const Profile profile{shape};
    const double d = 1e-5, at = 0.7, z = 2e-3, L = 0.02;
    const Opening here = profile.opening(at, z, L);
    const Opening before = profile.opening(at - d, z, L), after = profile.opening(at + d, z, L);
    // Differences of step 1e-5 of micrometres: h^2, and round-off over h.
    CHECK(std::abs((after.value - before.value) / (2 * d) - here.phi) < 1e-14);
    CHECK(std::abs((after.phi - before.phi) / (2 * d) - here.phi_phi) < 1e-13);  // the same, once more differentiated
  }
  // Straight between the measured heights, constant beyond them, a smooth curve through the points around the bearing.
  CHECK(measured.opening(phi[3], 0, 0.02).value == doctest::Approx(3e-6 * std::sin(phi[3]) + 1e-6));
  CHECK(measured.opening(phi[3], 0.01, 0.02).value == doctest::Approx(3e-6 * std::sin(phi[3]) + 2e-6));
  CHECK(measured.opening(0.4, -0.01, 0.02).value == relative(3e-6 * std::sin(0.4)).epsilon(0.01));
}

TEST_CASE("ProfilesOfTheJournal_RotateWithIt") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {40, 9}};
  m.profiles = {{Ovality{4e-6, 0.2}, Surface::journal}};
  const Eigen::VectorXd turned = gap_opening(m, 0.9);
  m.profiles = {{Ovality{4e-6, 0.2 + 0.9}}};
  CHECK((turned - gap_opening(m)).cwiseAbs().maxCoeff() < kNothing);
}

}  // namespace gap_profile_test
}  // namespace hersey::film
