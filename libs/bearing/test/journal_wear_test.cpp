#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "force/journal_ring.h"
#include "force/wearing_surfaces.h"
#include "hersey/film/film_model.h"

// Wear of a journal place by place, in its own axes.
namespace hersey::bearing {
namespace journal_wear_test {

constexpr double pi = std::numbers::pi;

film::FilmModel bore(int n_phi = 120) {
  film::FilmModel model;
  model.R = 0.025, model.L = 0.02, model.c = 3e-5;
  model.grid = {.n_phi = n_phi, .n_z = 3};
  return model;
}

/// A wave around the journal on the lines of its ring, that differs from row to row.
Eigen::VectorXd wave(const JournalRing& ring, int n_z) {
  Eigen::VectorXd values(ring.size());
  for (Eigen::Index k = 0; k < values.size(); ++k)
    values[k] = 2 + std::sin(2 * pi * static_cast<double>(k / n_z) / static_cast<double>(ring.lines()) + k % n_z);
  return values;
}

TEST_CASE("JournalRing_SharesAllAmongItsLines_AndIsEvenWhereTheyAre") {
  const film::FilmModel model = bore();
  JournalRing ring(model.grid);
  REQUIRE(ring.lines() == 120);
  const Eigen::VectorXd even = Eigen::VectorXd::Constant(ring.size(), 3.0), values = wave(ring, 3);
  constexpr double round_off = 1e-12;
  CHECK((ring.at_lines(values) - ring.at_nodes(values)).lpNorm<Eigen::Infinity>() < round_off);  // nodes are on lines
  for (const double angle : {0.0, 0.013, 2.0, -7.5}) {
    ring.turn(angle);
    CHECK((ring.at_nodes(even) - even).lpNorm<Eigen::Infinity>() < round_off);
    CHECK(ring.by_angle(even).lpNorm<Eigen::Infinity>() < round_off * 120);  // of its 120 lines
    const Eigen::VectorXd nodal = Eigen::VectorXd::LinSpaced(model.grid.size(), 0, 1);
    CHECK(ring.collected(nodal).sum() == doctest::Approx(nodal.sum()).epsilon(round_off));
    // What is collected at nodes has the same work as what is spread to them.
    CHECK(ring.collected(nodal).dot(values) == doctest::Approx(nodal.dot(ring.at_nodes(values))).epsilon(round_off));
  }
}

TEST_CASE("JournalRing_HasTheSlopesOfFiniteDifferences") {
  const film::FilmModel model = bore();
  JournalRing ring(model.grid);
  const Eigen::VectorXd values = wave(ring, 3);
  constexpr double angle = 0.4321, step = 1e-5;
  const auto at = [&](double turned) {
    ring.turn(turned);
    return ring.at_nodes(values);
  };
  const Eigen::VectorXd plus = at(angle + step), minus = at(angle - step), middle = at(angle);
  const double size = ring.by_angle(values).norm();
  CHECK(((plus - minus) / (2 * step) - ring.by_angle(values)).norm() <
        std::sqrt(step) * step * size);  // exact in splines
  CHECK(((plus - 2 * middle + minus) / (step * step) - ring.by_angle_twice(values)).norm() < 1e-3 * size);  // round-off
}

TEST_CASE("JournalRing_TurnedByALine_IsShiftedByIt") {
  const film::FilmModel model = bore();
  JournalRing ring(model.grid);
  const Eigen::VectorXd values = wave(ring, 3), before = ring.at_nodes(values);
  constexpr double round_off = 1e-12;
  ring.turn(2 * pi / 120);
  const Eigen::VectorXd after = ring.at_nodes(values);
  CHECK((after.segment(3, after.size() - 3) - before.head(before.size() - 3)).lpNorm<Eigen::Infinity>() < round_off);
  CHECK((after.head(3) - before.tail(3)).lpNorm<Eigen::Infinity>() < round_off);
}

constexpr double k = 1e-16, p0 = 8e6, omega = 300, half = 20 * pi / 180;

/// Wears a journal over one revolution under an even contact of 40 deg, whose angle `turns` times as fast.
WearingSurfaces after_a_revolution(const film::FilmModel& model, const WearModel& wear, double turns) {
  WearingSurfaces surfaces(model, wear);
  constexpr int steps = 720;
  const double dt = 2 * pi / omega / steps;
  for (int i = 0; i <= steps; ++i) {
    const double turned = omega * dt * i;
    film::SurfaceMotion motion;
    motion.u_journal = omega * model.R;
    motion.g = motion.g_rate = Eigen::VectorXd::Zero(model.grid.size());
    surfaces.begin_step(i > 0 ? dt : 0);
    surfaces.add_to({}, {.angle = std::remainder(turned, 2 * pi), .speed = omega, .radius = model.R}, motion);
    surfaces.accept_step(i > 0 ? dt : 0);
    Eigen::VectorXd p(model.grid.size());
    for (int node = 0; node < p.size(); ++node) {
      const double from = std::abs(std::remainder(model.grid.phi(node / model.grid.n_z) - turns * turned, 2 * pi));
      p[node] = p0 * std::clamp((half - from) / (2 * pi / 120) + 0.5, 0.0, 1.0);  // ends within a line
    }
    surfaces.wear_off(p, motion, i > 0 ? dt : 0);
  }
  return surfaces;
}

// A load that stands wears a journal evenly in whole revolutions; one that turns with it wears it in one place, as a
// load that stands wears the shell.
TEST_CASE("JournalUnderALoad_WearsWhereItIsLoaded") {
  const film::FilmModel model = bore();
  const WearModel local{.fixed = {}, .moving = {k}, .around = WearAround::local, .acceleration = 1000},
      even{.fixed = {}, .moving = {k}, .acceleration = 1000}, shell{.fixed = {k}, .moving = {}, .acceleration = 1000};
  const WearingSurfaces standing = after_a_revolution(model, local, 0), evenly = after_a_revolution(model, even, 0);
  CHECK(standing.observe().moving_volume == doctest::Approx(evenly.observe().moving_volume));
  CHECK(standing.moving().maxCoeff() - standing.moving().minCoeff() <
        1e-9 * evenly.observe().moving_depth);  // round-off

  const WearingSurfaces with_it = after_a_revolution(model, local, 1), bush = after_a_revolution(model, shell, 0);
  CHECK(with_it.observe().moving_volume == doctest::Approx(bush.observe().fixed_volume).epsilon(2e-3));  // of an edge
  const Eigen::VectorXd journal = with_it.moving(), bore = bush.fixed();
  const double depth = k * 1000 * p0 * 2 * pi * model.R;
  for (int i = 0; i < model.grid.n_phi; ++i) {
    const double from = std::abs(std::remainder(model.grid.phi(i), 2 * pi));
    const int node = model.grid.index(i, 1);
    if (std::abs(from - half) < 4 * 2 * pi / 120) continue;  // two splines of 1.5 lines, and the edge itself
    CHECK(journal[node] == doctest::Approx(from < half ? depth : 0).epsilon(1e-9).scale(depth));  // round-off
    CHECK(bore[node] == doctest::Approx(from < half ? depth : 0).epsilon(1e-9).scale(depth));     // likewise
  }
}

// Gap and rate of a journal that turns, with a depth that varies around it: the rate is the change of the gap.
TEST_CASE("GapOfAWornJournal_ChangesAtItsRate") {
  const film::FilmModel model = bore();
  const WearModel local{.fixed = {}, .moving = {k}, .around = WearAround::local, .acceleration = 1000};
  WearingSurfaces surfaces = after_a_revolution(model, local, 1);
  constexpr double dt = 1e-5, step = 1e-8;  // [s], within the step before
  const auto at = [&](double t, double angle, double speed) {
    film::SurfaceMotion motion;
    motion.g = motion.g_rate = Eigen::VectorXd::Zero(model.grid.size());
    surfaces.begin_step(t);
    surfaces.add_to({}, {.angle = angle, .speed = speed, .radius = model.R}, motion);
    return motion;
  };
  const double angle = 0.345;
  const auto later = at(dt + step, angle + omega * step, omega), before = at(dt - step, angle - omega * step, omega),
             now = at(dt, angle, omega);
  const Eigen::VectorXd difference = (later.g - before.g) / (2 * step);
  CHECK((difference - now.g_rate).norm() < 1e-3 * now.g_rate.norm());  // second derivatives jump where lines pass

  std::vector<film::MotionDirection> directions(2);
  const GapKinematics::Turning turning{.angle = angle, .speed = omega, .radius = model.R, .of_angle = 0, .of_speed = 1};
  surfaces.add_turning(turning, directions);
  constexpr double turn = 1e-6;
  const auto forth = at(dt, angle + turn, omega), back = at(dt, angle - turn, omega);
  CHECK(((forth.g - back.g) / (2 * turn) - directions[0].g).norm() < 1e-6 * directions[0].g.norm());  // round-off
  CHECK(((forth.g_rate - back.g_rate) / (2 * turn) - directions[0].g_rate).norm() <
        1e-6 * directions[0].g_rate.norm());  // likewise
  const auto fast = at(dt, angle, omega + 1 / model.R);
  CHECK(((fast.g_rate - now.g_rate) - directions[1].g_rate).norm() < 1e-9 * directions[1].g_rate.norm());  // linear
}

}  // namespace journal_wear_test
}  // namespace hersey::bearing
