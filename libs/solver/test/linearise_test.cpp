#include "hersey/solver/linearise.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "one_coordinate.h"
#include "relative.h"

namespace hersey::solver {
namespace linearise_test {

constexpr double eps = std::numeric_limits<double>::epsilon();
// Eigenvalues of well-scaled matrices of a few rows, relative.
constexpr double of_eigenvalues = 1e4 * eps;
constexpr double two_pi = 2 * std::numbers::pi;

Linearisation of(const Eigen::MatrixXd& M, const Eigen::MatrixXd& C, const Eigen::MatrixXd& K) {
  Linearisation linear;
  linear.Z = Eigen::MatrixXd::Identity(M.rows(), M.rows());
  linear.M = M, linear.C = C, linear.K = K;
  linear.set_solved(true);
  return linear;
}

Linearisation of(double m, double c, double k) {
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  return of(one(m), one(c), one(k));
}

TEST_CASE("Linearisation_OfOneCoordinateIsItsMassDampingAndStiffness") {
  test::OneCoordinate spring;
  spring.mass = 3;
  spring.force = [](double q, double v, double) { return 5 * q * q + 2 * v; };
  spring.force_by_q = [](double q, double, double) { return 10 * q; };
  spring.force_by_v = [](double, double, double) { return 2.0; };
  const Linearisation linear = linearise(spring, spring.at(0.7, 0), 1e-3);
  REQUIRE(linear.solved());
  REQUIRE(linear.Z.cols() == 1);
  const double scale = linear.Z(0, 0) * linear.Z(0, 0);  // of whatever length the direction has
  CHECK(linear.M(0, 0) == relative(3 * scale).epsilon(8 * eps));
  CHECK(linear.C(0, 0) == relative(2 * scale).epsilon(8 * eps));
  CHECK(linear.K(0, 0) == relative(7 * scale).epsilon(8 * eps));
  spring.lowest = 1;
  const Linearisation outside = linearise(spring, spring.at(0.7, 0), 1e-3);
  CHECK(!outside.solved());
  CHECK(outside.message == "gap closed");
}

TEST_CASE("Modes_WithoutFreeMotionsOrInertia_AreReported") {
  test::OneCoordinate constrained;
  constrained.copies_of_constraint = 1;
  const Modes none = find_modes(linearise(constrained, constrained.at(0, 0), 1e-3));
  CHECK(!none.solved());
  CHECK(none.message.find("nothing that could vibrate") != std::string::npos);
  const Modes massless = find_modes(of(0, 1, 1));
  CHECK(!massless.solved());
  CHECK(massless.message == "a free motion without inertia");
}

TEST_CASE("Modes_OfTwoMassesAreThoseOfTheTextbook") {
  const Eigen::Matrix2d K = (Eigen::Matrix2d() << 2, -1, -1, 2).finished();
  const Modes found = find_modes(of(4 * Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero(), 100 * K));
  REQUIRE(found.solved());
  CHECK(found.stable);
  REQUIRE(found.modes.size() == 2);  // of each conjugate pair one
  CHECK(found.modes[0].frequency == relative(5 / two_pi).epsilon(of_eigenvalues));
  CHECK(found.modes[1].frequency == relative(5 * std::sqrt(3.0) / two_pi).epsilon(of_eigenvalues));
  CHECK(std::abs(found.modes[0].damping_ratio) < of_eigenvalues);
  // The coordinates move in phase, and in opposite phase; the largest entry is 1.
  CHECK(std::abs(found.modes[0].shape[0] / found.modes[0].shape[1] - 1.0) < of_eigenvalues);
  CHECK(std::abs(found.modes[1].shape[0] / found.modes[1].shape[1] + 1.0) < of_eigenvalues);
  CHECK(found.modes[1].shape.cwiseAbs().maxCoeff() == relative(1).epsilon(of_eigenvalues));
}

TEST_CASE("DampedModes_HaveTheirRatioAndFrequencies") {
  const double zeta = 0.3, omega = 40;
  const Modes found = find_modes(of(2, 2 * 2 * zeta * omega, 2 * omega * omega));
  REQUIRE(found.modes.size() == 1);
  CHECK(found.modes[0].damping_ratio == relative(zeta).epsilon(of_eigenvalues));
  CHECK(found.modes[0].frequency == relative(omega / two_pi).epsilon(of_eigenvalues));
  CHECK(found.modes[0].damped_frequency ==
        relative(omega * std::sqrt(1 - zeta * zeta) / two_pi).epsilon(of_eigenvalues));
  // The overdamped case has two real roots, s = -1 and -4 1/s.
  const Modes creeping = find_modes(of(1, 5, 4));
  REQUIRE(creeping.modes.size() == 2);
  CHECK(creeping.modes[0].s.real() == relative(-1).epsilon(of_eigenvalues));
  CHECK(creeping.modes[1].s.real() == relative(-4).epsilon(of_eigenvalues));
  CHECK(creeping.modes[0].damped_frequency == 0);
  CHECK(creeping.stable);
}

TEST_CASE("OnlyGrowingMotions_AreUnstable") {
  CHECK(!find_modes(of(1, -0.1, 4)).stable);
  CHECK(find_modes(of(1, -0.1, 4)).modes[0].damping_ratio == relative(-0.025).epsilon(of_eigenvalues));
  CHECK(!find_modes(of(1, 0, -4)).stable);
  const Modes free = find_modes(of(1, 0, 0));  // moves on as it is
  CHECK(free.stable);
  REQUIRE(!free.modes.empty());
  CHECK(free.modes[0].frequency == 0);
  CHECK(free.modes[0].damping_ratio == 0);
}

// Motions a million times slower than the fastest keep their accuracy, and an unconstrained one has frequency zero.
TEST_CASE("SlowModes_KeepTheirFigures") {
  const Eigen::Vector3d k(1e14, 4, 0);
  const Modes found = find_modes(of(Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero(), k.asDiagonal()));
  REQUIRE(found.solved());
  CHECK(found.stable);
  REQUIRE(found.modes.size() >= 3);
  CHECK(found.modes.front().frequency == 0);
  CHECK(found.modes.back().frequency == relative(1e7 / two_pi).epsilon(of_eigenvalues));
  const Mode& slow = found.modes[found.modes.size() - 2];
  // The inverse resolves the slow motion to about 1e-5 of the fastest: (100/2)^2 times its round-off.
  CHECK(slow.frequency == relative(2 / two_pi).epsilon(2500 * of_eigenvalues));
}

}  // namespace linearise_test
}  // namespace hersey::solver
