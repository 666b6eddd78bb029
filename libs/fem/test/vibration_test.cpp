#include "hersey/fem/vibration.h"

#include <doctest/doctest.h>

#include <limits>

#include "small_bodies.h"

namespace hersey::fem {
namespace vibration_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST_CASE("NaturalModes_AreThoseOfTheDenseEigenproblem") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(box_mesh(type, {1, 0.2, 0.2}, {3, 1, 1}), {steel});  // square: double frequencies
    for (const bool is_free : {true, false}) {
      const std::vector<int> fixed = is_free ? std::vector<int>{} : dofs_of(body.mesh.node_sets.at("x0"));
      const Vibration modes = natural_modes(body, fixed, {.count = 12});
      REQUIRE(modes.solved());
      REQUIRE(modes.omega.size() == 12);
      std::vector<int> kept;
      for (int i = 0; i < body.size(); ++i)
        if (std::find(fixed.begin(), fixed.end(), i) == fixed.end()) kept.push_back(i);
      const Eigen::MatrixXd K = Eigen::MatrixXd(body.K)(kept, kept),
                            M = Eigen::MatrixXd(mass_matrix(body.m))(kept, kept);
      const Eigen::VectorXd lambda =
          Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
      const int rigid = is_free ? 6 : 0;
      CHECK(modes.rigid == rigid);
      // rtol of the modes; squared frequencies are good to its square.
      for (int k = 0; k < 12; ++k)
        CHECK(modes.omega[k] == doctest::Approx(k < rigid ? 0 : std::sqrt(lambda[k])).epsilon(1e-7));
      const Eigen::MatrixXd gram = modes.shapes.transpose() * mass_times(body.m, modes.shapes);
      CHECK((gram - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff() < 1000 * eps);
      const Eigen::MatrixXd stiffness = modes.shapes.transpose() * body.K * modes.shapes;
      const Eigen::MatrixXd squares = modes.omega.cwiseAbs2().asDiagonal();
      CHECK((stiffness - squares).cwiseAbs().maxCoeff() < 1e-7 * squares.maxCoeff());  // rtol of the modes
    }
  }
}

TEST_CASE("NaturalModes_UpToAFrequency_AreAllOfThem") {
  const ElasticBody body = assemble(box_mesh(ElementType::hex8, {1, 0.2, 0.2}, {8, 2, 2}), {steel});
  const std::vector<int> fixed = dofs_of(body.mesh.node_sets.at("x0"));
  const Vibration many = natural_modes(body, fixed, {.count = 30});
  REQUIRE(many.solved());
  const double limit = (many.omega[16] + many.omega[17]) / 2;
  const Vibration some = natural_modes(body, fixed, {.count = 30, .highest = limit});
  REQUIRE(some.solved());
  REQUIRE(some.omega.size() == 17);
  CHECK((some.omega - many.omega.head(17)).norm() < 1e-9 * many.omega.norm());  // both are good to about rtol^2
}

TEST_CASE("NaturalModes_MoreThanTheBodyHas_AreAllItHas") {
  const ElasticBody body = assemble(box_mesh(ElementType::tet4, {1, 1, 1}, {1, 1, 1}), {steel});
  const Vibration modes = natural_modes(body, {}, {.count = 100});
  REQUIRE(modes.solved());
  CHECK(modes.omega.size() == 24);
  CHECK(modes.rigid == 6);
}

TEST_CASE("NaturalModes_DoNotDependOnUnits") {
  const Vibration metres = natural_modes(assemble(box_mesh(ElementType::hex8, {1, 0.1, 0.1}, {5, 1, 1}), {steel}), {});
  const Vibration microns =
      natural_modes(assemble(box_mesh(ElementType::hex8, {1e-6, 1e-7, 1e-7}, {5, 1, 1}), {steel}), {});
  REQUIRE(metres.solved());
  REQUIRE(microns.solved());
  CHECK(microns.rigid == 6);
  CHECK((1e-6 * microns.omega - metres.omega).norm() < 1e-6 * metres.omega.norm());  // rtol of the modes
}

TEST_CASE("NaturalModes_OfAMasslessBody_AreRefused") {
  const SolidMaterial massless = isotropic({.youngs_modulus = 1, .poisson_ratio = 0.3});
  const Vibration modes = natural_modes(assemble(box_mesh(ElementType::tet4, {1, 1, 1}, {1, 1, 1}), {massless}), {});
  CHECK_FALSE(modes.solved());
  CHECK(modes.message.find("density") != std::string::npos);
}

}  // namespace vibration_test
}  // namespace hersey::fem
