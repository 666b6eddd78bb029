#include "hersey/solver/static_deformation.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hersey/solver/generalized_alpha.h"
#include "one_coordinate.h"
#include "several_coordinates.h"

// Bodies that start deformed as their loads hold them, theory manual eq. (integrator.23), against closed forms.
namespace hersey::solver {
namespace static_deformation_test {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double solved = 1e-8;  // rows are solved to 1e-9 of their terms, which are a few times the sizes looked at

constexpr double mass = 3, moment = 1.2, modal_mass = 0.8, stiffness = 400, gravity = 9.81;

/// A bar that moves along its axis and lengthens: u = y + psi e with psi = 1 at its pulled end, `moment` the integral
/// of rho psi; pulled by `pull` there.
test::SeveralCoordinates bar(double pull) {
  test::SeveralCoordinates e((Matrix2d() << mass, moment, moment, modal_mass).finished());
  e.force = [=](const VectorXd& q, const VectorXd&, double) {
    return VectorXd(Vector2d(mass * gravity - pull, moment * gravity - pull + stiffness * q[1]));
  };
  e.force_by_q = [](const VectorXd&, const VectorXd&, double) {
    return MatrixXd((Matrix2d() << 0, 0, 0, stiffness).finished());
  };
  return e;
}

TEST_CASE("FreeFall_DeformsNothingAndAPullAsItsInertiaDoes") {
  for (const double pull : {0.0, 50.0}) {
    CAPTURE(pull);
    test::SeveralCoordinates e = bar(pull);
    State state = e.at(Vector2d(0.3, 0.02), Vector2d(-2, 5));
    REQUIRE(initialise(e, state).solved());
    REQUIRE(settle_deformations(e, state, {.stiff = {1}}).solved());
    const double elongation = pull * (1 - moment / mass) / stiffness;
    CHECK(std::abs(state.q[1] - elongation) < solved);
    CHECK(state.v[1] == 0);
    CHECK(state.vdot[1] == 0);
    // The rigid motion is left as it was, with the acceleration of the whole.
    CHECK(state.q[0] == 0.3);
    CHECK(state.v[0] == -2);
    CHECK(std::abs(state.vdot[0] - (pull / mass - gravity)) < solved * gravity);
    CHECK(e.accepted == 2);  // by both
  }
}

TEST_CASE("SettledBar_DoesNotVibrate") {
  const auto swing = [](bool settled) {
    test::SeveralCoordinates e = bar(50);
    State state = e.at(Vector2d(0, 0));
    REQUIRE(initialise(e, state).solved());
    if (settled) REQUIRE(settle_deformations(e, state, {.stiff = {1}}).solved());
    GeneralizedAlpha integrator({.spectral_radius = 0.9});
    double lowest = state.q[1], highest = state.q[1];
    for (int i = 0; i < 40; ++i) {  // a period of 0.2 s, twice
      REQUIRE(integrator.step(e, state, 0.01).solved());
      lowest = std::min(lowest, state.q[1]), highest = std::max(highest, state.q[1]);
    }
    return highest - lowest;
  };
  const double elongation = 50 * (1 - moment / mass) / stiffness;
  CHECK(swing(true) < 1e-6 * elongation);  // a few times the rtol of steps and rows
  CHECK(swing(false) > 1.5 * elongation);
}

// Hung by its other end, y + psi_0 e = 0: the constraint takes the whole weight, and y moves with the deformation.
TEST_CASE("HungBar_IsLengthenedByItsWeight") {
  const double psi = -0.5;
  test::SeveralCoordinates e = bar(0);
  e.rows = 1;
  e.phi = [=](const VectorXd& q, double) { return VectorXd(VectorXd::Constant(1, q[0] + psi * q[1])); };
  e.G = [=](const VectorXd&, double) { return MatrixXd((MatrixXd(1, 2) << 1, psi).finished()); };
  State state = e.at(Vector2d(0, 0));
  for (const std::vector<Eigen::Index>& fixed : {std::vector<Eigen::Index>{}, std::vector<Eigen::Index>{0}}) {
    REQUIRE(initialise(e, state).solved());
    REQUIRE(settle_deformations(e, state, {.fixed = fixed, .stiff = {1}}).solved());
    const double elongation = (psi * mass - moment) * gravity / stiffness;
    CHECK(std::abs(state.q[1] - elongation) < solved);
    CHECK(std::abs(state.q[0] + psi * elongation) < solved);
    CHECK(std::abs(state.lambda[0] + mass * gravity) < solved * mass * gravity);
    CHECK(state.vdot.norm() < solved * gravity);
  }
}

/// A mass on an elastic rod that rotates about its other end, x^2 + y^2 = (1 + e)^2.
test::SeveralCoordinates whirled_mass() {
  test::SeveralCoordinates e(Vector3d(mass, mass, 0.1).asDiagonal(), 1);
  e.force = [](const VectorXd& q, const VectorXd&, double) { return VectorXd(Vector3d(0, 0, stiffness * q[2])); };
  e.force_by_q = [](const VectorXd&, const VectorXd&, double) {
    return MatrixXd(Vector3d(0, 0, stiffness).asDiagonal());
  };
  e.phi = [](const VectorXd& q, double) {
    return VectorXd(VectorXd::Constant(1, q.head(2).squaredNorm() - std::pow(1 + q[2], 2)));
  };
  e.G = [](const VectorXd& q, double) {
    return MatrixXd((MatrixXd(1, 3) << 2 * q[0], 2 * q[1], -2 * (1 + q[2])).finished());
  };
  e.bias = [](const VectorXd&, const VectorXd& v, double) {
    return VectorXd(VectorXd::Constant(1, 2 * (v.head(2).squaredNorm() - v[2] * v[2])));
  };
  e.constraint_force_by_q = [](const VectorXd&, const VectorXd& lambda) {
    return MatrixXd(Vector3d(2, 2, -2).asDiagonal() * lambda[0]);
  };
  return e;
}

TEST_CASE("WhirledRod_IsStretchedByItsCentripetalForce") {
  test::SeveralCoordinates e = whirled_mass();
  const double speed = 4;
  State state = e.at(Vector3d(1, 0, 0), Vector3d(0, speed, 0));
  REQUIRE(initialise(e, state).solved());
  CHECK(state.vdot[2] > 1);  // released undeformed it would stretch
  REQUIRE(settle_deformations(e, state, {.stiff = {2}}).solved());
  // k e = m v^2/(1 + e)
  const double stretch = 0.5 * (std::sqrt(1 + 4 * mass * speed * speed / stiffness) - 1);
  CHECK(std::abs(state.q[2] - stretch) < solved);
  CHECK(std::abs(state.q[0] - (1 + stretch)) < solved);
  CHECK(state.q[1] == 0);
  CHECK(state.v[1] == speed);
  CHECK(std::abs(state.vdot[0] + speed * speed / (1 + stretch)) < solved * speed * speed);
  CHECK(state.vdot[2] == 0);
}

/// One deformation alone under `force`.
test::OneCoordinate supported_by(double (*force)(double), double (*slope)(double)) {
  test::OneCoordinate e;
  e.force = [=](double q, double, double) { return force(q); };
  e.force_by_q = [=](double q, double, double) { return slope(q); };
  return e;
}

TEST_CASE("StiffDeformation_IsSettledFromFarAwayAndInsideItsDomain") {
  test::OneCoordinate gap =
      supported_by([](double q) { return 50 - 0.5 / (q * q); }, [](double q) { return 1 / (q * q * q); });
  gap.lowest = 0;
  State state = gap.at(1, 0);  // Newton's method from here ends far on the other side of the wall
  REQUIRE(settle_deformations(gap, state, {.stiff = {0}}).solved());
  CHECK(std::abs(state.q[0] - 0.1) < solved);
  test::OneCoordinate soft = supported_by([](double q) { return std::atan(5 * (q - 1)); },
                                          [](double q) { return 5 / (1 + 25 * (q - 1) * (q - 1)); });
  State far = soft.at(2, 0);  // and from here runs away
  REQUIRE(settle_deformations(soft, far, {.stiff = {0}}).solved());
  CHECK(std::abs(far.q[0] - 1) < solved);
}

/// Checks a failure because of `why` that leaves the state unchanged.
void check_failure(Equations& e, const State& start, Eigen::Index deformation, const std::string& why) {
  State state = start;
  const StaticDeformationSummary summary = settle_deformations(e, state, {.stiff = {deformation}});
  CAPTURE(summary.message);
  CHECK(!summary.solved());
  CHECK(summary.message.find(why) != std::string::npos);
  CHECK(summary.residual > 1);
  CHECK(state.q == start.q);
  CHECK(state.vdot == start.vdot);
}

TEST_CASE("DeformationWithoutStiffness_IsReported") {
  test::OneCoordinate loose = supported_by([](double) { return 2.0; }, [](double) { return 0.0; });
  check_failure(loose, loose.at(1, 0), 0, "the deformation is not determined; worst equation: mass");
  // 1 + q^2 vanishes nowhere: the least that is left is at 0, to which no increment leads any more.
  test::OneCoordinate pushed = supported_by([](double q) { return 1 + q * q; }, [](double q) { return 2 * q; });
  check_failure(pushed, pushed.at(0.9, 0), 0, "worst equation: mass");
  // Each iteration takes a ninth of what is left.
  test::OneCoordinate flat =
      supported_by([](double q) { return std::pow(q, 9); }, [](double q) { return 9 * std::pow(q, 8); });
  check_failure(flat, flat.at(100, 0), 0, "times its tolerance after 41 iterations");
  test::OneCoordinate endless = supported_by([](double) { return 1e200; }, [](double) { return 1e-200; });
  check_failure(endless, endless.at(0, 0), 0, "worst equation: mass");
}

TEST_CASE("DeformationOutsideItsDomain_IsReported") {
  test::OneCoordinate spring = supported_by([](double q) { return 100 + q; }, [](double) { return 1.0; });
  spring.lowest = 1;
  check_failure(spring, spring.at(0.5, 0), 0, "gap closed");
  spring.lowest = -1e-3;  // nearer than any increment that is tried
  check_failure(spring, spring.at(0, 0), 0, "gap closed");
  test::OneCoordinate invalid =
      supported_by([](double) { return std::numeric_limits<double>::quiet_NaN(); }, [](double) { return 1.0; });
  State still = invalid.at(0.5, 0);
  still.vdot.setZero();
  check_failure(invalid, still, 0, "the forces are not numbers");
  test::OneCoordinate condensed = supported_by([](double q) { return 100 + q; }, [](double) { return 1.0; });
  condensed.internal = 1e-3;
  check_failure(condensed, condensed.at(0, 0), 0, "film of the fake is not solved");
}

// Condensed unknowns need iterations of their own: each state is evaluated until they are solved.
TEST_CASE("CondensedUnknowns_AreSolvedBeforeTheDeformationMoves") {
  test::SeveralCoordinates e = bar(50), slow = bar(50);
  State state = e.at(Vector2d(0, 0)), other = state;
  REQUIRE(settle_deformations(e, state, {.stiff = {1}}).solved());
  slow.unsolved = 30;
  REQUIRE(settle_deformations(slow, other, {.stiff = {1}}).solved());
  CHECK((state.q - other.q).norm() == 0);
  CHECK(slow.assembled == e.assembled + 29);
}

// At e = 0.5, an intermediate state, the constraint is independent of x: its rate cannot follow there.
TEST_CASE("ConfigurationWhereConstraintsDetermineNoRates_IsReported") {
  test::SeveralCoordinates e(Vector2d(1, 1).asDiagonal(), 1);
  const auto slope = [](double q) { return q < 0.5 ? 1.0 : 0.0; };
  e.force = [](const VectorXd& q, const VectorXd&, double) { return VectorXd(Vector2d(0, q[1] - 10000)); };
  e.force_by_q = [](const VectorXd&, const VectorXd&, double) { return MatrixXd(Vector2d(0, 1).asDiagonal()); };
  e.phi = [=](const VectorXd& q, double) { return VectorXd(VectorXd::Constant(1, slope(q[1]) * q[0])); };
  e.G = [=](const VectorXd& q, double) { return MatrixXd((MatrixXd(1, 2) << slope(q[1]), 0).finished()); };
  e.phi_t = [](const VectorXd&, double) { return VectorXd(VectorXd::Ones(1)); };
  check_failure(e, e.at(Vector2d(0, 0), Vector2d(-1, 0)), 1, "the constraints do not determine the velocities");
}

}  // namespace static_deformation_test
}  // namespace hersey::solver
