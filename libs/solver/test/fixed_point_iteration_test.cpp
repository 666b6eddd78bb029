#include "hersey/solver/fixed_point_iteration.h"

#include <doctest/doctest.h>

#include "hersey/core/contract.h"

namespace hersey::solver {
namespace fixed_point_iteration_test {

// F(x) = A x + b with eigenvalues of A like those of a loaded film under light bodies: -30, -8, -2, 0.5.
struct StiffExchange {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  StiffExchange() : A(4, 4), b(4) {
    Eigen::MatrixXd T(4, 4);
    T << 1, 0.3, 0, 0.2, 0.1, 1, 0.4, 0, 0, 0.2, 1, 0.1, 0.3, 0, 0.1, 1;
    A = T * Eigen::Vector4d(-30, -8, -2, 0.5).asDiagonal() * T.inverse();
    b << 100, -40, 7, 3;
  }
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& x) const { return A * x + b; }
  [[nodiscard]] Eigen::VectorXd solution() const {
    return (Eigen::MatrixXd::Identity(4, 4) - A).partialPivLu().solve(b);
  }
};

int iterations_to(double tolerance, Acceleration acceleration, double relaxation, int most) {
  const StiffExchange F;
  FixedPointIteration iteration(acceleration, relaxation);
  iteration.begin_step();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  for (int k = 0; k < most; ++k) {
    if ((x - F.solution()).norm() <= tolerance * F.solution().norm()) return k;
    x = iteration.next(x, F(x));
  }
  return most;
}

TEST_CASE("QuasiNewton_SolvesALinearExchangeInItsDimensionPlusTwo") {
  CHECK(iterations_to(1e-9, Acceleration::quasi_newton, 0.05, 20) <= 6);
}

TEST_CASE("ConstantRelaxation_ConvergesOnlyBelowItsBound") {
  // |1 - omega (1 - a)| < 1 for a = -30 requires omega < 2/31.
  CHECK(iterations_to(1e-6, Acceleration::constant, 0.05, 2000) < 2000);
  CHECK(iterations_to(1e-6, Acceleration::constant, 0.07, 2000) == 2000);
}

TEST_CASE("Aitken_ConvergesWhereTheFullStepDiverges") {
  CHECK(iterations_to(1e-6, Acceleration::constant, 1.0, 500) == 500);
  CHECK(iterations_to(1e-6, Acceleration::aitken, 1.0, 500) < 500);
}

TEST_CASE("JacobianOfASimilarExchange_IsUsedFromTheStart") {
  const StiffExchange F;
  FixedPointIteration other(Acceleration::quasi_newton, 0.05), iteration(Acceleration::quasi_newton, 0.05);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  for (int k = 0; k < 8; ++k) x = other.next(x, F(x));
  // The exchange is the same in other units.
  const double unit = 7;
  iteration.learn_from(other, [&](const Eigen::VectorXd& change) { return Eigen::VectorXd(unit * change); });
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(4);
  const Eigen::VectorXd next = iteration.next(start, unit * F(start / unit));
  CHECK((next - unit * F.solution()).norm() < 1e-6 * unit * F.solution().norm());  // its Jacobian is known to 1e-7
}

TEST_CASE("Memory_CarriesOverToTheNextStep") {
  const StiffExchange F;
  FixedPointIteration iteration(Acceleration::quasi_newton, 0.05);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  iteration.begin_step();
  for (int k = 0; k < 8; ++k) x = iteration.next(x, F(x));
  // The next step has another solution of the same exchange: its Jacobian is known, and one correction is enough.
  iteration.begin_step();
  const Eigen::VectorXd away = x + Eigen::VectorXd::LinSpaced(4, -5, 9);
  const Eigen::VectorXd back = iteration.next(away, F(away));
  // Least squares: round-off times the spread of eigenvalues and directions.
  CHECK((back - F.solution()).norm() <= 1e-6 * F.solution().norm());
}

// The oldest changes are dropped: those of a former exchange do not impede the next.
TEST_CASE("OldChanges_AreReplacedByNewOnes") {
  const StiffExchange F;
  StiffExchange earlier;
  earlier.A *= 1.5;
  const auto left_after = [&](std::size_t most) {
    FixedPointIteration iteration(Acceleration::quasi_newton, 0.05, {.most = most});
    Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
    iteration.begin_step();
    for (int k = 0; k < 8; ++k) x = iteration.next(x, earlier(x));
    iteration.begin_step();
    for (int k = 0; k < 3; ++k) x = iteration.next(x, F(x));
    return (x - F.solution()).norm();
  };
  CHECK(left_after(2) != left_after(24));
  FixedPointIteration none(Acceleration::quasi_newton, 0.05, {.most = 0});
  none.begin_step();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4);
  for (int k = 0; k < 3; ++k) {  // without any it is a constant relaxation
    const Eigen::VectorXd image = F(x), expected = x + 0.05 * (image - x);
    x = none.next(x, image);
    CHECK((x - expected).norm() == 0);
  }
}

// Along known directions the image is taken to its fixed point; the given share of the rest is taken.
TEST_CASE("RelaxationOfTheUnknown_AppliesToUnknownDirectionsOnly") {
  const Eigen::Vector3d b(1, 2, 3), slope(0.5, 0, 0);
  const auto image = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(slope.cwiseProduct(x) + b); };
  for (const double share : {1.0, 0.25}) {
    FixedPointIteration iteration(Acceleration::quasi_newton, 1);
    iteration.set_relaxation_of_unknown(share);
    iteration.begin_step();
    Eigen::VectorXd x = Eigen::Vector3d::Zero();
    (void)iteration.next(x, image(x));
    x[0] = 1;  // its residual changes along the first component, and that alone is known
    const Eigen::VectorXd next = iteration.next(x, image(x));
    CHECK(next[0] == doctest::Approx(2));
    CHECK(next[1] == doctest::Approx(share * 2));
    CHECK(next[2] == doctest::Approx(share * 3));
  }
}

TEST_CASE("RelaxationOutsideItsRange_IsRejected") {
  CHECK_THROWS_AS(FixedPointIteration(Acceleration::constant, 0), ContractError);
  CHECK_THROWS_AS(FixedPointIteration(Acceleration::constant, 1.5), ContractError);
}

}  // namespace fixed_point_iteration_test
}  // namespace hersey::solver
