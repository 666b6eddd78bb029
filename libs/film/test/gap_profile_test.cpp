#include "hersey/film/gap_profile.h"

#include <doctest/doctest.h>

#include "film_cases.h"

namespace hersey::film {
namespace {

TEST_CASE("Profiles_HaveTheirShapes") {
  const double L = 0.02;
  CHECK(Barrel{4e-6}.opening(1, 0, L) == 0);
  CHECK(Barrel{4e-6}.opening(1, -0.01, L) == doctest::Approx(4e-6));
  CHECK(Barrel{4e-6}.opening(1, 0.005, L) == doctest::Approx(1e-6));
  CHECK(Taper{6e-6}.opening(1, 0.01, L) - Taper{6e-6}.opening(1, -0.01, L) == doctest::Approx(6e-6));
  CHECK(Ovality{3e-6, 0.5}.opening(0.5 + pi, 0, L) == doctest::Approx(3e-6));
  CHECK(Ovality{3e-6, 0.5}.opening(0.5 - pi / 2, 0, L) == doctest::Approx(-3e-6));
  // A lemon bore has the clearance in the middle of its arcs and is widest, by its offset, where they meet.
  const Lobes lemon{2, 20e-6, pi / 2};
  CHECK(lemon.opening(-pi / 2, 0, L) == doctest::Approx(0));
  CHECK(lemon.opening(pi, 0, L) == doctest::Approx(20e-6));
  CHECK(Lobes{3, 20e-6, 0}.opening(2 * pi / 3, 0, L) == doctest::Approx(0).scale(20e-6));
}

// A journal moved by the offset of a lemon's arc is concentric with that arc: half the bearing has an even gap.
TEST_CASE("LemonBore_IsMadeOfArcs") {
  FilmModel m{.R = 0.03, .L = 0.02, .c = 30e-6, .grid = {48, 5}};
  const double offset = 12e-6;
  SurfaceMotion motion = surfaces(m, {.e = {0, -offset}});
  motion.g += gap_profile({Lobes{2, offset, pi / 2}}, m.grid, m.L);
  for (int i = 1; i < 24; ++i) CHECK(motion.g[m.grid.index(i, 2)] == doctest::Approx(m.c + offset).epsilon(1e-12));
}

// Bore and journal of the same taper leave an even gap.
TEST_CASE("Profiles_AddUp") {
  const Grid grid{12, 5};
  const Eigen::VectorXd sum = gap_profile({Taper{5e-6}, Barrel{2e-6}, Taper{-5e-6}}, grid, 0.02);
  CHECK((sum - gap_profile({Barrel{2e-6}}, grid, 0.02)).cwiseAbs().maxCoeff() < 1e-20);
  CHECK(gap_profile({}, grid, 0.02).isZero(0));
}

}  // namespace
}  // namespace hersey::film
