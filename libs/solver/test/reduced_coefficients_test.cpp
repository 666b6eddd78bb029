#include "hersey/solver/reduced_coefficients.h"

#include <doctest/doctest.h>

#include <complex>
#include <random>

namespace hersey::solver {
namespace reduced_coefficients_test {

constexpr int all = 6;
const std::vector<Equations::Index> chosen{4, 1};

/// Small motions of six coordinates, seen along directions of their own.
struct Motions {
  Eigen::MatrixXd M, C, K;
  Linearisation linear;
};

Motions some_motions() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto matrix = [&] {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(all, all, [&] { return number(random); }));
  };
  Motions motions;
  motions.K = 4 * Eigen::MatrixXd::Identity(all, all) + matrix();
  motions.C = 2 * Eigen::MatrixXd::Identity(all, all) + matrix();
  const Eigen::MatrixXd root = matrix();
  motions.M = root * root.transpose();
  const Eigen::MatrixXd Z = matrix().householderQr().householderQ();
  motions.linear.Z = Z;
  motions.linear.M = Z.transpose() * motions.M * Z;
  motions.linear.C = Z.transpose() * motions.C * Z;
  motions.linear.K = Z.transpose() * motions.K * Z;
  motions.linear.set_solved(true);
  return motions;
}

TEST_CASE("ReducedCoefficients_AreTheForcesOfAHarmonicMotion") {
  const Motions motions = some_motions();
  constexpr double omega = 1.3;
  const std::complex<double> i(0, 1);
  const ReducedCoefficients reduced = reduce(motions.linear, chosen, omega);
  // The inverse of D has the motions of the chosen coordinates under forces on them alone.
  const Eigen::MatrixXcd D = motions.K + i * omega * motions.C - omega * omega * motions.M;
  const Eigen::MatrixXcd compliance = D.inverse();
  Eigen::Matrix2cd of_chosen;
  Eigen::Matrix2d own_mass;
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c) {
      of_chosen(r, c) = compliance(chosen[r], chosen[c]);
      own_mass(r, c) = motions.M(chosen[r], chosen[c]);
    }
  const Eigen::Matrix2cd stiffness = of_chosen.inverse() + omega * omega * own_mass.cast<std::complex<double>>();
  constexpr double round_off_of_inverses = 1e-11;  // of matrices with a condition below 100
  CHECK((reduced.K - stiffness.real()).cwiseAbs().maxCoeff() < round_off_of_inverses);
  CHECK((omega * reduced.C - stiffness.imag()).cwiseAbs().maxCoeff() < round_off_of_inverses);
}

TEST_CASE("SlowMotions_AreTheLimitOfReducedCoefficients") {
  const Motions motions = some_motions();
  const ReducedCoefficients slow = reduce(motions.linear, chosen, 0);
  const auto distance = [&](double omega) {
    const ReducedCoefficients reduced = reduce(motions.linear, chosen, omega);
    return (reduced.K - slow.K).norm() + (reduced.C - slow.C).norm();
  };
  CHECK(distance(0.02) < 0.02);
  CHECK(distance(0.02) / distance(0.01) == doctest::Approx(4).epsilon(0.02));  // second order in the frequency
}

TEST_CASE("CoefficientsWithoutFollowers_AreThoseThatWereThere") {
  Motions motions = some_motions();
  std::vector<Equations::Index> every{0, 1, 2, 3, 4, 5};
  const ReducedCoefficients reduced = reduce(motions.linear, every, 2);
  constexpr double round_off_of_products = 1e-13;
  CHECK((reduced.K - motions.K).cwiseAbs().maxCoeff() < round_off_of_products);
  CHECK((reduced.C - motions.C).cwiseAbs().maxCoeff() < round_off_of_products);
}

}  // namespace reduced_coefficients_test
}  // namespace hersey::solver
