#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "force/wearing_surfaces.h"
#include "hersey/film/film_model.h"

// Wear under contact pressures that are given.
namespace hersey::bearing {
namespace wear_test {

constexpr double pi = std::numbers::pi;

/// Bore of 25 mm radius and 20 mm width; every tenth of a degree a line.
film::FilmModel bore() {
  film::FilmModel model;
  model.R = 0.025, model.L = 0.02, model.c = 3e-5;
  model.grid = {.n_phi = 3600, .n_z = 3};
  return model;
}

/// Contact pressure over the angle, the same along the axis.
template <class Pressure>
Eigen::VectorXd contact(const film::FilmModel& model, const Pressure& pressure) {
  Eigen::VectorXd p(model.grid.size());
  for (int node = 0; node < p.size(); ++node)
    p[node] = pressure(std::remainder(model.grid.phi(node / model.grid.n_z), 2 * pi));
  return p;
}

film::SurfaceMotion sliding(double speed) {
  film::SurfaceMotion surfaces;
  surfaces.u_journal = speed;
  return surfaces;
}

constexpr double k = 1e-16, p0 = 8e6, omega = 300, cycle = 0.04, cycles = 1e5, half = 20 * pi / 180;

// Closed forms of an independent program, wear.json: even pressure, a cosine, an oscillating journal, a shaft.
TEST_CASE("WornDepthAndVolume_AreThoseOfClosedForms") {
  const film::FilmModel model = bore();
  const auto even = contact(model, [](double phi) { return std::abs(phi) < half ? p0 : 0.0; });
  const auto cosine =
      contact(model, [](double phi) { return std::abs(phi) < half ? p0 * std::cos(pi * phi / (2 * half)) : 0.0; });
  const WearModel fixed{.fixed = {k}, .moving = {}, .acceleration = cycles};
  WearingSurfaces a(model, fixed), b(model, fixed), c(model, fixed),
      shaft(model, {.fixed = {}, .moving = {k}, .acceleration = cycles});
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double dt = i > 0 ? cycle / steps : 0, t = cycle * i / steps;
    a.wear_off(even, sliding(omega * model.R), dt);
    b.wear_off(cosine, sliding(-omega * model.R), dt);
    c.wear_off(even, sliding(pi / 6 * 2 * pi / cycle * std::cos(2 * pi * t / cycle) * model.R), dt);
    shaft.wear_off(even, sliding(omega * model.R), dt);
  }
  constexpr double of_lines = 2e-3;  // the pressure ends within a tenth of a degree
  CHECK(a.observe().fixed_depth == doctest::Approx(2.4e-5).epsilon(1e-12));  // sums of equal terms, round-off
  CHECK(a.observe().fixed_volume == doctest::Approx(8.377580409572783e-09).epsilon(of_lines));
  CHECK(b.observe().fixed_depth == doctest::Approx(2.4e-5).epsilon(1e-12));  // likewise
  CHECK(b.observe().fixed_volume == doctest::Approx(5.333333333333335e-09).epsilon(of_lines));
  CHECK(c.observe().fixed_depth == doctest::Approx(4.188790204786391e-06).epsilon(1e-4));  // by 400 steps
  CHECK(shaft.observe().moving_depth == doctest::Approx(2.6666666666666664e-06).epsilon(of_lines));
  CHECK(shaft.observe().moving_volume ==
        doctest::Approx(a.observe().fixed_volume).epsilon(1e-12));  // the same work, round-off
}

// Contact that wears itself free: pressure in proportion to what overlaps.
TEST_CASE("ContactThatWearsItselfFree_DecaysExponentially") {
  const film::FilmModel model = bore();
  constexpr double s = 1e13, d0 = 1e-6, v = 7.5, t_end = 150;
  const auto error = [&](int steps) {
    WearingSurfaces surfaces(model, {.fixed = {k}, .moving = {}});
    for (int i = 0; i <= steps; ++i) {
      const double p = s * (d0 - surfaces.observe().fixed_depth);
      surfaces.wear_off(contact(model, [&](double) { return p; }), sliding(v), i > 0 ? t_end / steps : 0);
    }
    return std::abs(surfaces.observe().fixed_depth / 6.753475326416502e-07 - 1);
  };
  // Pressure lags by a step behind the middle of each: (k s v)^2 t dt exp(-k s v t)/(1 - exp(-k s v t)).
  constexpr double of_step = 2.1e-3;
  CHECK(error(300) < of_step);
  CHECK(error(600) < 0.55 * error(300));
}

TEST_CASE("WhatAStepHasWorn_OpensTheGapOverTheNext") {
  const film::FilmModel model = bore();
  WearingSurfaces surfaces(model, {.fixed = {k}, .moving = {2 * k}, .acceleration = 1e5});
  const auto even = contact(model, [](double) { return p0; });
  constexpr double dt = 1e-4;
  mbd::RelativeMotion motion;
  const GapKinematics::Turning turning{};
  const auto gap = [&](double step) {
    film::SurfaceMotion at = sliding(0);
    at.g = at.g_rate = Eigen::VectorXd::Zero(model.grid.size());
    surfaces.begin_step(step);
    surfaces.add_to(motion, turning, at);
    return std::pair{at.g[0], at.g_rate[0]};
  };
  surfaces.wear_off(even, sliding(7.5), 0);
  CHECK(gap(dt).first == 0);
  surfaces.accept_step(dt);
  surfaces.wear_off(even, sliding(7.5), dt);
  const double worn = 3 * k * p0 * 7.5 * dt * 1e5;
  CHECK(gap(dt).first == doctest::Approx(worn));
  CHECK(gap(dt).second == doctest::Approx(worn / dt));
  CHECK(gap(dt / 2).first == doctest::Approx(worn / 2));  // a step taken again, shorter
  // Forces that push the walls apart work on them.
  CHECK(surfaces.power(Eigen::VectorXd::Ones(model.grid.size())) ==
        doctest::Approx(worn / dt * static_cast<double>(model.grid.size())));
}

TEST_CASE("AccelerationError_IsHalfTheChangeOfCycles") {
  const film::FilmModel model = bore();
  WearingSurfaces surfaces(model, {.fixed = {k}, .moving = {}, .acceleration = 100, .cycle = 0.01});
  surfaces.wear_off(contact(model, [](double) { return p0; }), sliding(1), 0);
  const auto step = [&](double p) { surfaces.wear_off(contact(model, [&](double) { return p; }), sliding(1), 0.005); };
  step(p0), step(p0), step(p0), step(p0);
  CHECK(surfaces.observe().acceleration_error == doctest::Approx(0));
  const double before = surfaces.observe().fixed_volume;
  step(0), step(0);
  CHECK(surfaces.observe().acceleration_error ==
        doctest::Approx(0.5 * (before / 2 - (surfaces.observe().fixed_volume - before))));
}

// At a constant rate of wear sigma - sigma_end falls exponentially with the sliding distance, at each place by what
// both surfaces have worn there.
TEST_CASE("Roughness_RunsInExponentiallyWithSlidingDistance") {
  const film::FilmModel model = bore();
  constexpr double ratio = 0.4, depth = 0.5e-6, v = 7.5, dt = 0.1;
  WearingSurfaces surfaces(model, {.fixed = {k}, .moving = {k / 2}, .running_in = RunningIn{ratio, depth}});
  const auto half_loaded = contact(model, [](double phi) { return phi > 0 ? p0 : 0.0; });
  surfaces.wear_off(half_loaded, sliding(v), 0);
  CHECK(surfaces.roughness_ratio() == Eigen::VectorXd::Ones(model.grid.size()));
  for (int step = 1; step <= 300; ++step) {
    surfaces.wear_off(half_loaded, sliding(v), dt);
    if (step % 100 != 0) continue;
    const double distance = v * dt * step, worn = k * p0 * distance, of_moving = surfaces.moving()[0];
    const auto expected = [&](double w) { return ratio + (1 - ratio) * std::exp(-(w + of_moving) / depth); };
    const Eigen::VectorXd found = surfaces.roughness_ratio();
    CHECK(found[900 * model.grid.n_z] == doctest::Approx(expected(worn)).epsilon(1e-12));  // round-off of 300 sums
    CHECK(found[2700 * model.grid.n_z] == doctest::Approx(expected(0)).epsilon(1e-12));    // likewise
    CHECK(surfaces.observe().roughness_least == found.minCoeff());
  }
}

// The film sees over a step the roughness of the wear that opens its gap at the step's end.
TEST_CASE("RoughnessOfAStep_IsThatOfItsGap") {
  const film::FilmModel model = bore();
  WearingSurfaces surfaces(model,
                           {.fixed = {k}, .moving = {}, .running_in = RunningIn{0.5, 1e-6}, .acceleration = 1e5});
  const auto even = contact(model, [](double) { return p0; });
  const auto film = [&](double dt) {
    film::SurfaceMotion at = sliding(0);
    at.g = at.g_rate = Eigen::VectorXd::Zero(model.grid.size());
    surfaces.begin_step(dt);
    surfaces.add_to({}, {}, at);
    return std::pair{at.g[0], at.roughness_ratio[0]};
  };
  constexpr double dt = 1e-4;  // [s], the step
  surfaces.wear_off(even, sliding(7.5), 0);
  CHECK(film(dt) == std::pair{0.0, 1.0});
  surfaces.accept_step(dt);
  surfaces.wear_off(even, sliding(7.5), dt);
  const auto [gap, ratio] = film(dt);
  CHECK(gap > 0);
  CHECK(ratio == doctest::Approx(0.5 + 0.5 * std::exp(-gap / 1e-6)));  // the depth of running in
}

TEST_CASE("WornLining_IsNamedWithItsDepth") {
  const film::FilmModel model = bore();
  WearingSurfaces surfaces(model, {.fixed = {k, 2e-6}, .moving = {}, .acceleration = 1e5});
  const auto even = contact(model, [](double) { return p0; });
  surfaces.wear_off(even, sliding(7.5), 0), surfaces.wear_off(even, sliding(7.5), 3e-3);
  CHECK(surfaces.failure().empty());
  surfaces.wear_off(even, sliding(7.5), 1e-3);
  CHECK(surfaces.failure() == "the fixed surface has worn by 2.4 um, all of its lining of 2 um");
}

}  // namespace wear_test
}  // namespace hersey::bearing
