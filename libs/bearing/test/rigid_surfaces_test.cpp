#include "hersey/bearing/rigid_surfaces.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace hersey::bearing {
namespace rigid_surfaces_test {

constexpr double kR = 0.0225;

// A journal well off the bearing's axis, and tilted.
Pose some_pose() { return {rotation_exp({0.03, -0.02, 0.7}).toRotationMatrix(), {20e-6, -13e-6, 4e-3}}; }

ParameterVector value(const Pose& X, const Vector6& V) { return journal_kinematics(X, V, kR, 0).value; }

TEST_CASE("Gap_IsDistanceOfCylinders") {
  // The distance between bore and tilted journal, measured along e_r by intersecting the journal's cylinder.
  film::FilmModel model;
  model.R = kR;
  model.L = 0.0156;
  model.c = 60e-6;
  model.grid = {.n_phi = 24, .n_z = 5};
  const Pose X{rotation_exp({4e-4, -3e-4, 0.2}).toRotationMatrix(), {20e-6, -13e-6, 4e-3}};
  film::SurfaceMotion motion;
  evaluate_surfaces(model, value(X, Vector6::Zero()), motion);
  const double journal_radius = model.R - model.c;
  // (bearing.2) drops e^2/(2R) and the journal's ellipse R tilt^2/2: together some 20 nm of 60 um here.
  const ParameterVector s0 = value(X, Vector6::Zero());
  const double furthest = s0.segment<2>(kEx).norm() + s0.segment<2>(kTx).norm() * model.L / 2;
  const double dropped = (furthest * furthest / model.R + model.R * s0.segment<2>(kTx).squaredNorm()) / 2;
  double smallest = 1;
  for (int i = 0; i < model.grid.n_phi; ++i) {
    const double phi = 2 * std::numbers::pi * i / model.grid.n_phi;
    for (int j = 0; j < model.grid.n_z; ++j) {
      const double z = model.L * (j / 4.0 - 0.5);
      // Largest s with the point (s e_r, z) within the journal: |(1 - d d^T)(point - r)| = journal_radius.
      const Vector3 e_r{std::cos(phi), std::sin(phi), 0}, d = X.R.col(2);
      const Matrix3 across = Matrix3::Identity() - d * d.transpose();
      const Vector3 a = across * e_r, b = across * (Vector3{0, 0, z} - X.r);
      const double s = (-a.dot(b) + std::sqrt(a.dot(b) * a.dot(b) -
                                              a.squaredNorm() * (b.squaredNorm() - journal_radius * journal_radius))) /
                       a.squaredNorm();
      const double g = motion.g[model.grid.index(i, j)];
      CHECK(std::abs(g - (model.R - s)) < dropped);
      smallest = std::min(smallest, g);
    }
  }
  CHECK(smallest_gap(model, value(X, Vector6::Zero())) <= smallest);
  CHECK(smallest_gap(model, value(X, Vector6::Zero())) > smallest - 1e-6);
}

TEST_CASE("Profiles_WidenTheGap") {
  film::FilmModel model;
  model.grid = {.n_phi = 24, .n_z = 5};
  const ParameterVector parameters = value(some_pose(), Vector6::Zero());
  film::SurfaceMotion round, shaped;
  evaluate_surfaces(model, parameters, round);
  model.profiles = {{film::Ovality{3e-6, 0}}, {film::Taper{2e-6}}};
  evaluate_surfaces(model, parameters, shaped);
  CHECK((shaped.g - round.g)[model.grid.index(6, 4)] == doctest::Approx(-3e-6 + 1e-6));
  CHECK(smallest_gap(model, parameters) == shaped.g.minCoeff());
}

TEST_CASE("SupplyLine_StaysOrFollowsTheWidestGap") {
  film::FilmModel model;
  ParameterVector parameters = ParameterVector::Zero();
  parameters[kSupplyAngle] = 2;
  film::SurfaceMotion motion;
  model.supply = {.kind = film::SupplyKind::fixed_angle, .phi = 0.5, .pressure = 0};
  evaluate_surfaces(model, parameters, motion);
  CHECK(motion.phi_supply == 0.5);
  CHECK(RigidSurfaces(model).direction(kSupplyAngle).phi_supply == 0);
  model.supply.kind = film::SupplyKind::widest_gap;
  evaluate_surfaces(model, parameters, motion);
  CHECK(motion.phi_supply == 2);
  CHECK(RigidSurfaces(model).direction(kSupplyAngle).phi_supply == 1);
  CHECK(RigidSurfaces(model).direction(kEx).phi_supply == 0);
}

// A journal with lobes, so that everything turns.
film::FilmModel shaped_journal() {
  film::FilmModel model;
  model.grid = film::graded_grid(24, 7, {{.position = 1, .reach = 0.5, .factor = 2}}, {});
  model.profiles = {{film::Ovality{5e-6, 0.3}, film::Surface::journal}, {film::Barrel{2e-6}}};
  return model;
}

ParameterVector some_parameters() {
  ParameterVector p;
  p << 5e-6, -7e-6, 1e-4, 2e-4, 3e-3, -2e-3, 0.01, 0.02, 8, 0.1, 2, 0.4;
  return p;
}

TEST_CASE("SurfaceDirections_MatchFiniteDifferences") {
  RigidSurfaces surfaces(shaped_journal());
  const ParameterVector p = some_parameters();
  film::SurfaceMotion motion, before, after;
  surfaces.evaluate(p, motion);
  for (int k = 0; k < kParameterCount; ++k) {
    CAPTURE(k);
    const double step = 1e-6 * std::max(1e-4, std::abs(p[k]));
    surfaces.evaluate(p - step * ParameterVector::Unit(k), before);
    surfaces.evaluate(p + step * ParameterVector::Unit(k), after);
    surfaces.evaluate(p, motion);
    const film::MotionDirection& direction = surfaces.direction(k);
    const Eigen::VectorXd g = (after.g - before.g) / (2 * step), rate = (after.g_rate - before.g_rate) / (2 * step);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(g.size());
    const auto close = [](const Eigen::VectorXd& exact, const Eigen::VectorXd& difference) {
      const double size = std::max(exact.cwiseAbs().maxCoeff(), 1e-5);
      // Differences of a millionth: round-off over the step, of what is at least 1e-5.
      return (exact - difference).cwiseAbs().maxCoeff() < 1e-4 * size;
    };
    CHECK(close(direction.g.size() > 0 ? direction.g : none, g));
    CHECK(close(direction.g_rate.size() > 0 ? direction.g_rate : none, rate));
  }
}

TEST_CASE("TurningShape_ChangesTheGapAtItsRate") {
  const film::FilmModel model = shaped_journal();
  RigidSurfaces surfaces(model);
  ParameterVector p = some_parameters();
  p.segment<4>(kExRate).setZero();
  const double omega = p[kJournalSpeed] / model.R, dt = 1e-7;
  film::SurfaceMotion now, before, after;
  surfaces.evaluate(p, now);
  ParameterVector turned = p;
  turned[kRotation] -= omega * dt;
  surfaces.evaluate(turned, before);
  turned[kRotation] += 2 * omega * dt;
  surfaces.evaluate(turned, after);
  // Differences of step 1e-7 s: round-off over it.
  CHECK(((after.g - before.g) / (2 * dt) - now.g_rate).cwiseAbs().maxCoeff() < 1e-5 * now.g_rate.cwiseAbs().maxCoeff());
}

}  // namespace rigid_surfaces_test
}  // namespace hersey::bearing
