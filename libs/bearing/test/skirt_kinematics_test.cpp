#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hersey/bearing/skirt.h"
#include "hersey/core/table_function.h"
#include "hersey/core/two_pi.h"
#include "kinds/skirt/skirt_gap.h"

// A skirt's position in its liner, from the poses of both.
namespace hersey::bearing {
namespace skirt_kinematics_test {

film::FilmModel some_skirt() {
  film::FilmModel model{.surface = film::Skirt{}, .R = 0.04, .L = 0.045, .c = 40e-6};
  model.grid = skirt_grid(1.4, 1.2, 7, 9);
  return model;
}

// The liner in the skirt's frame: tilted both ways, its origin far along it, moving in every direction.
mbd::RelativeMotion some_motion() {
  mbd::RelativeMotion motion;
  motion.X_AB = {rotation_exp({2e-4, -3e-4, 0.1}).toRotationMatrix(), {-8e-6, 5e-6, -0.06}};
  motion.V_AB_A << 0.02, -0.05, 0.3, 4e-3, -2e-3, 7.0;
  return motion;
}

TEST_CASE("SkirtDerivatives_MatchFiniteDifferences") {
  const film::FilmModel model = some_skirt();
  SkirtGap gap(model, Eigen::VectorXd::Zero(model.grid.size()));
  film::SurfaceMotion surfaces;
  const auto gap_at = [&](const mbd::RelativeMotion& motion) {
    CHECK(gap.evaluate(motion, surfaces).empty());
    return surfaces;
  };
  const mbd::RelativeMotion here = some_motion();
  constexpr double h = 1e-7;
  constexpr double of_differences = 1e-6;  // eps over the step, of gaps and speeds of the order of one
  for (int j = 0; j < 6; ++j) {
    CAPTURE(j);
    mbd::RelativeMotion ahead = here, behind = here, faster = here, slower = here;
    const Vector6 xi = h * Vector6::Unit(j);
    ahead.X_AB = pose_exp(xi) * here.X_AB, behind.X_AB = pose_exp(-xi) * here.X_AB;
    faster.V_AB_A += xi, slower.V_AB_A -= xi;
    const film::SurfaceMotion a = gap_at(ahead), b = gap_at(behind), f = gap_at(faster), s = gap_at(slower);
    (void)gap_at(here);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(model.grid.size()), rate_by_pose = g, rate_by_velocity = g;
    double w = 0;
    for (Eigen::Index k = 0; k < gap.parameters().size(); ++k) {
      const film::MotionDirection& d = gap.direction(k);
      if (d.g.size() > 0) g += gap.d_dX()(k, j) * d.g;
      if (d.g_rate.size() > 0) {
        rate_by_pose += gap.d_dX()(k, j) * d.g_rate;
        rate_by_velocity += gap.d_dV()(k, j) * d.g_rate;
      }
      w += gap.d_dV()(k, j) * d.w_journal;
    }
    CHECK((g - (a.g - b.g) / (2 * h)).norm() < of_differences);
    CHECK((rate_by_pose - (a.g_rate - b.g_rate) / (2 * h)).norm() < 10 * of_differences);
    CHECK((rate_by_velocity - (f.g_rate - s.g_rate) / (2 * h)).norm() < of_differences);
    CHECK(std::abs(w - (f.w_journal - s.w_journal) / (2 * h)) < of_differences);
  }
}

// The gap's rate is that of the gap, and the liner has no place: along it and about it nothing changes.
TEST_CASE("SkirtAlongItsLiner_KeepsItsGap") {
  const film::FilmModel model = some_skirt();
  SkirtGap gap(model, Eigen::VectorXd::Zero(model.grid.size()));
  film::SurfaceMotion here, there;
  const mbd::RelativeMotion motion = some_motion();
  REQUIRE(gap.evaluate(motion, here).empty());
  constexpr double dt = 1e-6;
  mbd::RelativeMotion later = motion;
  later.X_AB = pose_exp(dt * motion.V_AB_A) * motion.X_AB;
  REQUIRE(gap.evaluate(later, there).empty());
  CHECK(((there.g - here.g) / dt - here.g_rate).norm() < 1e-4 * here.g_rate.norm());  // accelerations times the step
  mbd::RelativeMotion elsewhere = motion;
  elsewhere.X_AB = motion.X_AB * Pose{rotation_exp({0, 0, 0.7}).toRotationMatrix(), {0, 0, 0.031}};
  REQUIRE(gap.evaluate(elsewhere, there).empty());
  CHECK((there.g - here.g).norm() < 1e-15);  // round-off of centimetres
  // The skirt moves towards the thrust side: its film there gets thinner.
  const GapPosition position = gap.position(motion);
  CHECK(position.e[0] == doctest::Approx(8e-6 + 0.06 * position.tilt.x()).epsilon(1e-3));  // squares of the tilt
  CHECK(position.speed == doctest::Approx(-7).epsilon(1e-3));                              // likewise
  elsewhere.X_AB.r.x() -= 10e-6;
  REQUIRE(gap.evaluate(elsewhere, there).empty());
  CHECK(there.g[model.grid.index(3, 4)] - here.g[model.grid.index(3, 4)] ==
        doctest::Approx(-10e-6).epsilon(1e-3));  // as above
}

// An oval bore that narrows along the liner: the rate of the gap is that of the gap, derivatives are those of
// differences, and a liner seen from its other end is the same liner.
TEST_CASE("SkirtAlongADistortedLiner_HasTheRateOfItsGap") {
  const film::FilmModel model = some_skirt();
  const auto bore = [](double sense) {
    LinerBore liner;
    for (const double z : {0.03, 0.1}) {
      std::vector<double> angles, openings;
      for (int k = 0; k < 24; ++k) {
        angles.push_back(2 * std::numbers::pi * k / 24);
        openings.push_back(20e-6 * (1 - 5 * z) * (1 + 0.3 * std::cos(2 * angles.back() - sense * 0.8)));
      }
      liner.shape.z.push_back(sense * z);
      liner.shape.openings.push_back(std::make_shared<TableFunction>(
          angles, openings, TableFunction::Options{.interpolation = Interpolation::smooth, .period = two_pi}));
    }
    if (sense < 0) {
      std::swap(liner.shape.z[0], liner.shape.z[1]);
      std::swap(liner.shape.openings[0], liner.shape.openings[1]);
    }
    return liner;
  };
  const Eigen::VectorXd round = Eigen::VectorXd::Zero(model.grid.size());
  SkirtGap gap(model, round, bore(1)), plain(model, round), turned(model, round, bore(-1));
  film::SurfaceMotion here, there, cylinder;
  mbd::RelativeMotion motion = some_motion();
  motion.V_AB_A.head<2>().setZero();
  REQUIRE(gap.evaluate(motion, here).empty());
  REQUIRE(plain.evaluate(motion, cylinder).empty());
  CHECK((here.g - cylinder.g).maxCoeff() > 10e-6);
  constexpr double dt = 1e-7;
  mbd::RelativeMotion later = motion;
  // The bore's part of the rate.
  later.X_AB.r.z() += dt * motion.V_AB_A[5];
  REQUIRE(gap.evaluate(later, there).empty());
  film::SurfaceMotion cylinder_there;
  REQUIRE(plain.evaluate(later, cylinder_there).empty());
  const Eigen::VectorXd of_bore = (there.g - cylinder_there.g - here.g + cylinder.g) / dt;
  CHECK((of_bore - (here.g_rate - cylinder.g_rate)).norm() < 1e-4 * of_bore.norm());  // squares of the tilt
  // Moved along it, the height is the last parameter.
  REQUIRE(gap.evaluate(motion, here).empty());
  const Eigen::Index height = gap.parameters().size() - 1;
  CHECK(gap.d_dX()(height, 5) == doctest::Approx(-1).epsilon(1e-6));  // the square of the tilt
  CHECK((gap.direction(height).g * motion.V_AB_A[5] * -1 - of_bore).norm() < 1e-4 * of_bore.norm());  // as above
  mbd::RelativeMotion from_behind = motion;
  from_behind.X_AB.R = motion.X_AB.R * rotation_exp({std::numbers::pi, 0, 0}).toRotationMatrix();
  REQUIRE(turned.evaluate(from_behind, there).empty());
  CHECK((there.g - here.g).norm() < 1e-14);                                // round-off of micrometres and centimetres
  CHECK((there.g_rate - here.g_rate).norm() < 1e-9 * here.g_rate.norm());  // round-off
}

TEST_CASE("LinerAcrossTheSkirt_IsReported") {
  const film::FilmModel model = some_skirt();
  SkirtGap gap(model, Eigen::VectorXd::Zero(model.grid.size()));
  mbd::RelativeMotion across;
  across.X_AB = {rotation_exp({std::numbers::pi / 2, 0, 0}).toRotationMatrix(), Vector3::Zero()};
  film::SurfaceMotion surfaces;
  CHECK(gap.evaluate(across, surfaces).find("90 deg to the skirt's") != std::string::npos);
}

}  // namespace skirt_kinematics_test
}  // namespace hersey::bearing
