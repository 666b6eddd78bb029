#include "hersey/fem/solid_element.h"

#include <doctest/doctest.h>

#include <limits>

#include "small_bodies.h"

namespace hersey::fem {
namespace solid_element_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST_CASE("ElementStiffness_HasSixRigidMotionsAndNoOther") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElementMatrix K = element_stiffness(type, distorted_element(type), steel);
    CHECK((K - K.transpose()).norm() < 100 * eps * K.norm());
    const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
    const double largest = lambda[lambda.size() - 1];
    CHECK(lambda.head(6).cwiseAbs().maxCoeff() < 1000 * eps * largest);
    CHECK(lambda[6] > 1e-4 * largest);  // many orders above round-off
  }
}

TEST_CASE("ReducedIntegration_OfHex20_LeavesSixMoreModesWithoutEnergy") {
  const ElementMatrix K =
      element_stiffness(ElementType::hex20, distorted_element(ElementType::hex20), steel, Integration::reduced);
  const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
  CHECK(std::abs(lambda[11]) < 1000 * eps * lambda[59]);
  CHECK(lambda[12] > 1e-4 * lambda[59]);
}

TEST_CASE("ElementMass_IsPositiveDefiniteAndAddsUpToTheVolume") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElementMatrix m = element_mass(type, distorted_element(type));
    const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues();
    CHECK(lambda[0] > 1e-3 * lambda[lambda.size() - 1]);
    double volume = 0;
    for (const auto& [xi, w] : mass_points(type))
      volume += w * element_point(shape_functions(type, xi), distorted_element(type)).jacobian;
    CHECK(m.sum() == doctest::Approx(volume).epsilon(100 * eps));
  }
}

TEST_CASE("ElementStrain_OfALinearField_IsThatFieldsEverywhere") {
  const Matrix3 gradient = (Matrix3() << 1, 2, 3, -4, 5, 6, 7, -8, 9).finished();
  const Vector6 expected = (Vector6() << 1, 5, 9, -2, -2, 10).finished();
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const NodeColumns x = distorted_element(type);
    const auto strain = element_strain(type, x, steel, gradient * x, {{0.2, 0.1, 0.3}, {0.1, 0.6, -0.2}});
    for (int p = 0; p < 2; ++p) CHECK((strain.col(p) - expected).norm() < 1000 * eps * expected.norm());
  }
}

TEST_CASE("SmallestJacobian_OfAFoldedElementIsNotPositive") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    NodeColumns x = distorted_element(type);
    CHECK(smallest_jacobian(type, x) > 0);
    x.row(2) *= -1;  // a mirror image
    CHECK(smallest_jacobian(type, x) < 0);
  }
  NodeColumns x = distorted_element(ElementType::tet10);
  x.col(4) = x.col(1) + 0.2 * (x.col(1) - x.col(0));  // a midside node beyond the corner
  CHECK(smallest_jacobian(ElementType::tet10, x) < 0);
}

}  // namespace solid_element_test
}  // namespace hersey::fem
